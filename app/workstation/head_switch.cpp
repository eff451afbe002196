#include "app/workstation/head_switch.h"

#include <QSettings>

#include "app/workstation/connect_dialog.h"
#include "hardware/link/discovery/head_browser.h"

namespace foresight {
namespace {

const QString kRecentHeads = QStringLiteral("link/recent");
constexpr int kMostRecentHeads = 8;

QStringList RecentHeads() {
  return QSettings().value(kRecentHeads).toStringList();
}

void Remember(const QString& address) {
  QStringList recent = RecentHeads();
  recent.removeAll(address);
  recent.prepend(address);
  QSettings().setValue(kRecentHeads, QStringList(recent.mid(0, kMostRecentHeads)));
}

ConnectModel::Search SearchLocalNetwork() {
  return [browser = std::make_shared<HeadBrowser>()]() -> ConnectModel::Network {
    return {browser->Heads(), browser->Trouble()};
  };
}

}  // namespace

HeadSwitch::HeadSwitch(Workbench* bench, std::string keys) : bench_(bench), keys_(std::move(keys)) {
  bench->commands.Add(
      {.id = "head.connect",
       .menu = "head",
       .text = tr("Connect to another head"),
       .tip = tr("Choose a head of the local network, or one by its address"),
       .keys = QStringLiteral("Ctrl+Shift+K"),
       .run = [this] { Open(); },
       .why_not =
           [bench] {
             const QString scans = bench->head.WhyNotDuringScan();
             // The window closes for it. Another file can be chosen when the scan has ended.
             return scans.isEmpty() && bench->recording.NeedsOperator()
                        ? tr("Not all that was recorded is in a file; record into another one "
                             "first (Ctrl+Shift+S).")
                        : scans;
           }});
}

HeadSwitch::~HeadSwitch() = default;

void HeadSwitch::Open() {
  if (!model_) {
    model_ = std::make_unique<ConnectModel>(SearchLocalNetwork(), OpenRemoteHead, &bench_->tasks);
    connect(model_.get(), &ConnectModel::opened, this, [this] {
      Remember(QString::fromStdString(model_->Address()));
      Q_EMIT opened();
    });
  }
  if (!dialog_) {
    dialog_ = new ConnectDialog(model_.get(), RecentHeads(), keys_, window_);
    dialog_->setAttribute(Qt::WA_DeleteOnClose);
  }
  dialog_->show();
  dialog_->raise();
}

}  // namespace foresight
