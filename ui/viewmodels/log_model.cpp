#include "ui/viewmodels/log_model.h"

#include <algorithm>

namespace foresight {
namespace {

constexpr int kInformationShown_ms = 10'000;
constexpr std::size_t kMostEntries = 1000;

int WeightOf(const Notice& notice) {
  return static_cast<int>(notice.level) + (notice.topic == kStopTopic ? 10 : 0);
}

}  // namespace

LogModel::LogModel(QObject* parent) : QObject(parent) {
  expiry_.setSingleShot(true);
  connect(&expiry_, &QTimer::timeout, this, &LogModel::ExpireInformation);
}

const LogEntry* LogModel::Top() const {
  const LogEntry* top = nullptr;
  for (const LogEntry& entry : entries_)
    if (!entry.acknowledged && (top == nullptr || WeightOf(entry.notice) >= WeightOf(top->notice)))
      top = &entry;
  return top;
}

int LogModel::Open() const {
  return static_cast<int>(
      std::count_if(entries_.begin(), entries_.end(), [](const LogEntry& entry) {
        return !entry.acknowledged && entry.notice.level != Notice::Level::kInfo;
      }));
}

void LogModel::add(const Notice& notice) {
  const bool again =
      !entries_.empty() && !entries_.back().acknowledged && entries_.back().notice == notice;
  if (again) {
    ++entries_.back().count;
    entries_.back().time = QDateTime::currentDateTime();
  } else {
    entries_.push_back({++last_id_, QDateTime::currentDateTime(), notice});
    if (entries_.size() > kMostEntries) entries_.pop_front();
  }
  if (notice.level == Notice::Level::kInfo) expiry_.start(kInformationShown_ms);
  Q_EMIT added(notice);
  Q_EMIT changed();
}

void LogModel::acknowledge(quint64 id) {
  for (LogEntry& entry : entries_)
    if (entry.id == id) entry.acknowledged = true;
  Q_EMIT changed();
}

void LogModel::acknowledgeAll() {
  for (LogEntry& entry : entries_) entry.acknowledged = true;
  Q_EMIT changed();
}

void LogModel::close(const QString& topic) {
  bool any = false;
  for (LogEntry& entry : entries_) {
    if (entry.acknowledged || entry.notice.topic != topic) continue;
    any = entry.acknowledged = true;
  }
  if (any) Q_EMIT changed();
}

void LogModel::ExpireInformation() {
  bool any = false;
  for (LogEntry& entry : entries_) {
    if (entry.acknowledged || entry.notice.level != Notice::Level::kInfo) continue;
    any = entry.acknowledged = true;
  }
  if (any) Q_EMIT changed();
}

}  // namespace foresight
