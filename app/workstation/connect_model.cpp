#include "app/workstation/connect_model.h"

namespace foresight {
namespace {

constexpr int kLookInterval_ms = 300;

}  // namespace

ConnectModel::ConnectModel(Search search, Open open, TaskQueue* tasks, QObject* parent)
    : QObject(parent), search_(std::move(search)), open_(std::move(open)), runner_(tasks) {
  connect(&timer_, &QTimer::timeout, this, &ConnectModel::Look);
  connect(&runner_, &TaskRunner::changed, this, &ConnectModel::changed);
  timer_.start(kLookInterval_ms);
  Look();
}

void ConnectModel::Look() {
  Network network = search_();
  if (network == network_) return;
  network_ = std::move(network);
  Q_EMIT changed();
}

QString ConnectModel::SearchText() const {
  if (!network_.trouble.empty())
    return tr("The local network is not searched: %1. Type the head's address.")
        .arg(QString::fromStdString(network_.trouble));
  if (network_.heads.empty())
    return tr(
        "No head tells of itself on the local network yet. A head elsewhere is reached by "
        "its address.");
  return tr("Heads that tell of themselves on the local network:");
}

void ConnectModel::Connect(const LinkArguments& link) {
  if (Connecting()) return;
  const auto address = LinkAddress(link.head);
  failed_ = !address;
  state_ = address ? tr("%1 is asked; this takes up to 15 s.").arg(QString::fromStdString(*address))
                   : tr("Type an address as HOST or HOST:PORT, such as 10.0.0.7 or robot:47130.");
  Q_EMIT changed();
  if (!address) return;
  address_ = *address;
  // A shared pointer, because answers are copied on their way.
  using Answer = std::shared_ptr<OpenedHead>;
  runner_.Run<Answer>(
      tr("Connecting to a head"),
      [open = open_, link](const RunContext& context) -> Result<Answer> {
        FORESIGHT_TRY(OpenedHead head, open(link));
        if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "cancelled");
        return std::make_shared<OpenedHead>(std::move(head));
      },
      [this](const Result<Answer>& answer) {
        failed_ = !answer && answer.error().code != ErrorCode::kCancelled;
        state_ = failed_ ? QString::fromStdString(answer.error().message) : QString();
        if (answer) opened_ = std::move(**answer);
        Q_EMIT changed();
        if (answer) Q_EMIT opened();
      });
}

void ConnectModel::cancel() {
  runner_.cancel();
  state_ = tr("Cancelled; the head before stays.");
  failed_ = false;
  Q_EMIT changed();
}

}  // namespace foresight
