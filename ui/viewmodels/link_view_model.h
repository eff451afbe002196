#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <QVector>
#include <memory>

#include "hardware/api/head_link.h"
#include "hardware/api/sensor_head.h"
#include "ui/viewmodels/notice.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// How the link does, in words.
struct LinkText {
  QString state;       ///< "well", "lost", "looking on"
  QString last_word;   ///< "under 10 s ago"
  QString round_trip;  ///< "12 ms"
  QString rate;        ///< "180 kB/s, 3.1 MB by bursts"
  QString left;        ///< "3.1 MB, about 4 s"
  QString control;     ///< "You have control." or who has it
  QString trouble;     ///< what is wrong and what to do; empty when all is well

  bool operator==(const LinkText&) const = default;
};

/// A scan of the head, in words.
struct LinkedScanRow {
  QString scan_id;
  LinkedScan::Place place = LinkedScan::Place::kAtHead;
  QString title;   ///< "14:03:21, coming"
  QString detail;  ///< "62 of 89 lines, 1 of 3 images, 3.1 MB to come"
  QString trouble;

  bool operator==(const LinkedScanRow&) const = default;
};

/// The link to a head that is elsewhere: how it does, which scans are there and which of them come
/// first, and who has control. Read twice a second; `changed` only for what can be seen.
class LinkViewModel : public QObject {
  Q_OBJECT

 public:
  /// `head` has a link. Without a queue the tasks have one of their own.
  LinkViewModel(std::shared_ptr<SensorHead> head, TaskQueue* tasks, QObject* parent = nullptr);

  const LinkText& Text() const { return text_; }
  const QVector<LinkedScanRow>& Scans() const { return scans_; }
  bool HasControl() const { return has_control_; }
  bool Connected() const { return connected_; }
  /// Why control cannot be taken now, as a sentence; empty when it can.
  QString WhyNotTake() const;
  QString WhyNotGive() const;

  /// Brings a scan before all others, also one that nobody asked for yet.
  void BringFirst(const QString& scan_id);
  /// Behind those that wait, or on from where it was paused.
  void Bring(const QString& scan_id);
  void Pause(const QString& scan_id);
  /// `successor` alone may take it then; empty = anybody.
  void GiveControl(const QString& successor);

 public Q_SLOTS:
  void takeControl();
  void Poll();

 Q_SIGNALS:
  void changed();
  void connectedChanged(bool connected);
  /// All of a scan has come, and is in the mission.
  void scanArrived();
  void noticed(const foresight::Notice& notice);

 private:
  void Ask(const QString& title, std::function<Status()> ask);

  std::shared_ptr<SensorHead> head_;
  HeadLink* link_;  ///< of head_
  LinkText text_;
  QVector<LinkedScanRow> scans_;
  bool connected_ = false;
  bool has_control_ = false;
  TaskRunner runner_;
  QTimer timer_;
};

}  // namespace foresight
