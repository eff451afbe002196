#include "ui/viewmodels/link_view_model.h"

#include <QDateTime>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/viewmodels/age_text.h"
#include "ui/viewmodels/bytes_text.h"

namespace foresight {
namespace {

constexpr int kLinkPollInterval_ms = 500;

QString ControlText(const LinkHealth& link, bool may_operate) {
  if (link.has_control) return LinkViewModel::tr("You have control.");
  const QString name = QString::fromStdString(link.holder);
  if (!may_operate)
    return name.isEmpty() ? LinkViewModel::tr("You look on; nobody has control.")
                          : LinkViewModel::tr("You look on; %1 has control.").arg(name);
  return name.isEmpty() ? LinkViewModel::tr("Nobody has control.")
                        : LinkViewModel::tr("%1 has control.").arg(name);
}

QString LeftText(const LinkHealth& link) {
  if (link.left_bytes == 0) return LinkViewModel::tr("nothing");
  const QString bytes = BytesText(link.left_bytes);
  if (!link.connected || !std::isfinite(link.left_s))
    return LinkViewModel::tr("%1, no end in sight").arg(bytes);
  return LinkViewModel::tr("%1, about %2")
      .arg(bytes, AgeText(std::chrono::seconds(std::llround(link.left_s))));
}

QString RateText(const LinkHealth& link) {
  const QString rate =
      LinkViewModel::tr("%1/s").arg(BytesText(std::llround(link.down_bytes_per_s)));
  if (!link.burst.wanted) return rate;
  if (!link.burst.trouble.empty()) return LinkViewModel::tr("%1, no bursts").arg(rate);
  if (link.burst.refused == 0)
    return LinkViewModel::tr("%1, %2 by bursts").arg(rate, BytesText(link.burst.bytes));
  return LinkViewModel::tr("%1, %2 by bursts (%3 datagrams refused)")
      .arg(rate, BytesText(link.burst.bytes))
      .arg(link.burst.refused);
}

LinkText TextOf(const LinkHealth& link, bool may_operate) {
  LinkText text;
  text.state = !link.connected    ? LinkViewModel::tr("lost")
               : link.has_control ? LinkViewModel::tr("well")
                                  : LinkViewModel::tr("looking on");
  text.last_word =
      LinkViewModel::tr("%1 ago").arg(AgeText(std::chrono::seconds(std::llround(link.age_s))));
  text.round_trip = link.round_trip_s > 0.0
                        ? LinkViewModel::tr("%1 ms").arg(1e3 * link.round_trip_s, 0, 'f', 0)
                        : LinkViewModel::tr("not known yet");
  text.rate = RateText(link);
  text.left = LeftText(link);
  text.control = ControlText(link, may_operate);
  text.trouble = QString::fromStdString(link.trouble.empty() ? link.burst.trouble : link.trouble);
  return text;
}

QString PlaceText(LinkedScan::Place place) {
  switch (place) {
    case LinkedScan::Place::kWaiting:
      return LinkViewModel::tr("waiting");
    case LinkedScan::Place::kComing:
      return LinkViewModel::tr("coming");
    case LinkedScan::Place::kPaused:
      return LinkViewModel::tr("paused");
    case LinkedScan::Place::kHere:
      return LinkViewModel::tr("here");
    case LinkedScan::Place::kAtHead:
      break;
  }
  return LinkViewModel::tr("at the head");
}

LinkedScanRow RowOf(const LinkedScan& scan) {
  LinkedScanRow row;
  row.scan_id = QString::fromStdString(scan.scan_id);
  row.place = scan.place;
  const auto begin = QDateTime::fromMSecsSinceEpoch(scan.begin_utc_ns / 1'000'000);
  const QString time = scan.begin_utc_ns == 0
                           ? LinkViewModel::tr("A scan of an earlier run")
                           : begin.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss"));
  row.title = LinkViewModel::tr("%1, %2").arg(time, PlaceText(scan.place));
  const bool all = scan.place == LinkedScan::Place::kHere;
  if (all || scan.place == LinkedScan::Place::kAtHead)
    row.detail =
        scan.of_images == 1
            ? LinkViewModel::tr("%1 lines, 1 image").arg(scan.of_lines)
            : LinkViewModel::tr("%1 lines, %2 images").arg(scan.of_lines).arg(scan.of_images);
  else
    row.detail = LinkViewModel::tr("%1 of %2 lines, %3 of %4 images")
                     .arg(scan.lines)
                     .arg(scan.of_lines)
                     .arg(scan.images)
                     .arg(scan.of_images);
  if (!all && scan.left_bytes > 0)
    row.detail += LinkViewModel::tr(", %1 to come").arg(BytesText(scan.left_bytes));
  row.trouble = QString::fromStdString(scan.trouble);
  return row;
}

int CountHere(const QVector<LinkedScanRow>& rows) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), [](const LinkedScanRow& row) {
    return row.place == LinkedScan::Place::kHere;
  }));
}

}  // namespace

LinkViewModel::LinkViewModel(std::shared_ptr<SensorHead> head, TaskQueue* tasks, QObject* parent)
    : QObject(parent), head_(std::move(head)), link_(head_->Link()), runner_(tasks) {
  Poll();
  connect(&timer_, &QTimer::timeout, this, &LinkViewModel::Poll);
  timer_.start(kLinkPollInterval_ms);
}

void LinkViewModel::Poll() {
  const LinkHealth health = link_->Health();
  if (std::exchange(connected_, health.connected) != health.connected)
    Q_EMIT connectedChanged(connected_);
  has_control_ = health.has_control;
  const LinkText text = TextOf(health, link_->MayOperate());
  QVector<LinkedScanRow> scans;
  for (const LinkedScan& scan : link_->Scans()) scans << RowOf(scan);
  if (text == text_ && scans == scans_) return;
  const bool arrived = CountHere(scans) > CountHere(scans_);
  text_ = text;
  scans_ = std::move(scans);
  Q_EMIT changed();
  if (arrived) Q_EMIT scanArrived();
}

QString LinkViewModel::WhyNotTake() const {
  if (has_control_) return tr("You have control already.");
  if (!link_->MayOperate())
    return tr("Your certificate is an observer's. Start the program with an operator's keys.");
  if (!connected_) return tr("The link is lost.");
  return runner_.Busy() ? tr("The head was asked and has not answered yet.") : QString();
}

QString LinkViewModel::WhyNotGive() const {
  if (!has_control_) return tr("You do not have control.");
  if (!connected_) return tr("The link is lost.");
  return runner_.Busy() ? tr("The head was asked and has not answered yet.") : QString();
}

void LinkViewModel::BringFirst(const QString& scan_id) {
  link_->FetchFirst(scan_id.toStdString());
  Poll();
}

void LinkViewModel::Bring(const QString& scan_id) {
  link_->Fetch(scan_id.toStdString());
  Poll();
}

void LinkViewModel::Pause(const QString& scan_id) {
  link_->Pause(scan_id.toStdString());
  Poll();
}

void LinkViewModel::takeControl() {
  if (!WhyNotTake().isEmpty()) return;
  Ask(tr("Taking control"), [link = link_] { return link->TakeControl(); });
}

void LinkViewModel::GiveControl(const QString& successor) {
  if (!WhyNotGive().isEmpty()) return;
  Ask(tr("Giving control away"),
      [link = link_, name = successor.trimmed().toStdString()] { return link->GiveControl(name); });
}

/// The head answers over the link, so the window does not wait for it.
void LinkViewModel::Ask(const QString& title, std::function<Status()> ask) {
  struct Answered {};
  runner_.Run<Answered>(
      title,
      [head = head_, ask = std::move(ask)](const RunContext&) -> Result<Answered> {
        FORESIGHT_CHECK(ask());
        return Answered{};
      },
      [this, title](const Result<Answered>& answered) {
        if (!answered) Q_EMIT noticed(NoticeOf(title, answered.error()));
        Poll();
        Q_EMIT changed();
      });
  Q_EMIT changed();
}

}  // namespace foresight
