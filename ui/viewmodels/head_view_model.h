#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <QVector>
#include <functional>
#include <memory>
#include <optional>

#include "core/sensor/scan_plan.h"
#include "hardware/api/head_link.h"
#include "hardware/api/health_watch.h"
#include "hardware/api/sensor_head.h"
#include "hardware/head/scan_assembler.h"
#include "ui/viewmodels/head_answers.h"
#include "ui/viewmodels/notice.h"

namespace foresight {

/// The plan as the operator types it.
struct PlanFields {
  double from_deg = -30.0;
  double to_deg = 30.0;
  double speed_deg_s = 10.0;
  QVector<double> image_angles_deg = {0.0};
  double exposure_ms = 4.0;
  bool standing_still = false;  ///< images after the sweep, not in passing
  bool there_and_back = false;  ///< two passes in one scan

  ScanPlan ToPlan() const;
};

/// What the plan will cost and give, in words.
struct PredictionText {
  QString time;      ///< "6.0 s"
  QString lines;     ///< "240"
  QString coverage;  ///< "2.5 %"
  QString sigma;     ///< "11.2 px", of the method that a new scan is computed with
  QString method;    ///< its name: "Foresight"
  QString exposure;  ///< "4.0 ms", or what the head will shorten it to and why
  /// Of the fastest speed that keeps the floor of coverage, rounded down to 0.1; 0 = not known.
  double fastest_deg_s = 0.0;
  QString warning;  ///< what is wrong with the plan and what to do; empty when all is well
  bool usable = true;
};

/// How a device of the head does, in words.
struct DeviceRow {
  enum class Lamp { kIdle, kWell, kDegraded, kMissing };

  QString name;  ///< "Lidar"
  Lamp lamp = Lamp::kIdle;
  QString state;   ///< "well", "not connected"
  QString detail;  ///< numbers, then what is wrong; empty before the head is connected

  bool operator==(const DeviceRow&) const = default;
};

/// The head and the next scan: status at 10 Hz, plan, prediction, commands. After a stop nothing
/// turns again until the operator has released it.
class HeadViewModel : public QObject {
  Q_OBJECT

 public:
  explicit HeadViewModel(std::shared_ptr<SensorHead> head, QObject* parent = nullptr);
  ~HeadViewModel() override;  ///< ends a running scan

  const HeadStatus& LastStatus() const { return status_; }
  const PlanFields& Plan() const { return plan_; }
  void SetPlan(const PlanFields& plan);
  PredictionText Prediction() const;
  /// In [0, 1], of the running scan.
  double ScanProgress() const;

  /// Lidar, camera and motor, and the link where the head is at the far end of one; trouble of the
  /// last ten seconds still shows.
  const QVector<DeviceRow>& Devices() const { return devices_; }

  /// The calibration in force on the head.
  SensorRig Rig() const { return head_->Rig(); }
  /// Puts another one in force from the next scan on, reads it back and compares. Waits for the
  /// head's answer, which takes seconds over a link: for a task. Fails with kState while the head
  /// is busy, with kInvalidInput for one of another head and where the head keeps another one.
  std::function<Status()> RigChange(const SensorRig& rig) const;
  /// The head has another rig: shows what depends on it.
  void ShowRig();
  /// The rig in force: its name, short id and camera model.
  QString RigText() const;

  /// Not while the head moves: what is typed then would look as if it steered the scan.
  bool CanEditPlan() const;
  bool CanScan() const;
  bool CanAbort() const;
  bool CanHome() const;
  /// Whether the operator pressed STOP and has not released that.
  bool StopLatched() const { return answers_.StopLatched(); }
  /// Whether LastStatus() is current, whether the head confirmed STOP, its state in words.
  const HeadAnswers& Answers() const { return answers_; }
  /// Why Scan cannot be pressed now, as a sentence; empty when it can.
  QString WhyNoScan() const;
  QString WhyNoHome() const;
  /// Whether a scan was started and has not been handed over yet.
  bool Scanning() const { return live_ != nullptr; }
  /// Why what needs the head or the mission file for itself has to wait; empty when it can be done.
  QString WhyNotDuringScan() const;
  /// Whether the sweep is over and the scan still comes over the link. The next one may start.
  bool Receiving() const;
  /// Whether the head sweeps for this station: what was started here, or anything while this
  /// station has control. Another operator's sweep is none of it.
  bool MovesForUs() const;

  /// Captures and sweeps that are no scans: shown nowhere and not recorded. Fail with kState after
  /// a stop that was not released, and as the head's own.
  Status StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink);
  Status StartUnrecordedScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink);
  /// Why neither can start now, as a sentence; empty when they can.
  QString WhyNoCapture() const;
  /// One view at a time: who looked before hears liveViewTaken.
  Status StartLiveView(const LiveViewOptions& options, std::shared_ptr<LiveViewSink> sink);
  void StopLiveView();

  /// Asked at the start of each scan for a sink that shall also get it; nullptr = none.
  void SetRecorderSource(std::function<std::shared_ptr<ScanSink>()> source) {
    recorder_source_ = std::move(source);
  }

  /// Reads the head's status now; otherwise it is read ten times a second. Tells the head that the
  /// operator is there.
  void Poll();

  /// Before the program ends: ends the running scan and stops the motor, unless another operator
  /// has the head.
  void StopForGood();

 public Q_SLOTS:
  /// Takes over the fastest speed that keeps the floor of coverage.
  void useFastestSpeed();
  void scan();
  void abort();
  void home();
  /// Stops the motor at once, whatever it does, and keeps it stopped.
  void stop();
  /// The head may move again when it is told to. Moves nothing by itself.
  void releaseStop();

 Q_SIGNALS:
  void statusChanged();  ///< something that can be seen changed
  void planChanged();
  void scanStarted();
  /// What has arrived so far, about four times a second.
  void scanGrew(const std::shared_ptr<const foresight::Scan>& scan);
  /// Over a link: what is here beyond what scanGrew showed, with gaps.
  void scanCame(const std::shared_ptr<const foresight::EarlyScan>& early);
  void scanEnded(const std::shared_ptr<const foresight::Scan>& scan);
  /// A scan that was started will not come: the head never began it.
  void scanLost();
  void stopReleased();
  void liveViewTaken();
  void noticed(const foresight::Notice& notice);
  /// What earlier notices of this topic said no longer holds.
  void settled(const QString& topic);

 private:
  void PollScan();
  void PollLateLines();
  void PollHealth();
  void PollAnswers();
  void ShowDevices();
  QVector<DeviceRow> DescribeDevices() const;
  bool Sweeps() const;
  bool OwnSweep() const;
  bool HasControl() const;
  QString WhyNoWord() const;

  std::shared_ptr<SensorHead> head_;
  HeadStatus status_;
  std::optional<LinkHealth> link_health_;  ///< empty where the head is in this process
  HeadAnswers answers_;
  HealthWatch health_watch_;
  HeadDiagnosis diagnosis_;
  QVector<DeviceRow> devices_;
  QElapsedTimer details_shown_;  ///< since the numbers of devices_ were taken
  QElapsedTimer since_start_;
  PlanFields plan_;
  std::function<std::shared_ptr<ScanSink>()> recorder_source_;
  std::shared_ptr<ScanAssembler> live_;
  bool own_sweep_over_ = false;             ///< of live_, which may still come over the link
  std::shared_ptr<const EarlyScan> early_;  ///< that scanCame told last
  int polls_ = 0;
  int polls_without_scan_ = 0;
  int lines_shown_ = 0;
  int frames_shown_ = 0;
  /// The scan that ended last: a line that was still on its way is shown too.
  std::shared_ptr<ScanAssembler> ended_;
  std::size_t lines_of_ended_ = 0;
  int polls_since_end_ = 0;
  QTimer timer_;
};

}  // namespace foresight
