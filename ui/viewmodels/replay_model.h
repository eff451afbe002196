#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>

#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/replay_scan.h"
#include "ui/viewmodels/review_view_model.h"
#include "ui/viewmodels/timeline_model.h"

namespace foresight {

/// Shows the mission under review as it was at a moment: the lines that had come, the images that
/// had been taken, the depth that had been computed and the objects that had been found. Plays at
/// any speed, forwards. At the end, and whenever the replay is left, the whole scan is shown, the
/// same as before in every bit. Only the review's document changes: neither the mission, nor the
/// recording, nor the head.
class ReplayModel : public QObject {
  Q_OBJECT

 public:
  ReplayModel(ReviewViewModel* review, SessionModel* session, DepthViewModel* depth,
              TimelineModel* timeline, QObject* parent = nullptr);

  /// Whether a moment is shown; else all of a scan is.
  bool Active() const { return active_; }
  bool Playing() const { return playing_; }
  /// Whether a moment within a sweep is shown: not all of the scan's lines.
  bool Sweeping() const { return active_ && session_->ExpectsScan() && session_->ShownScan(); }
  /// Whether a scan is being loaded; the play head waits for it.
  bool Loading() const { return runner_.Busy(); }
  /// Times real time.
  double Speed() const { return speed_; }
  void SetSpeed(double speed);
  /// Whether playing jumps over time in which nothing happened: from kLinger_s after an event to
  /// kLead_s before the next one. A sweep is never jumped over.
  bool SkipsIdle() const { return skips_idle_; }
  /// The moment that is shown or, where all of a scan is, its end. 0 = nothing is open.
  std::int64_t Now() const { return now_utc_ns_; }
  /// Why there is nothing to play, as a sentence; empty when there is.
  QString WhyNot() const;

  /// Shows a moment; within the mission.
  void SeekTo(std::int64_t utc_ns);
  /// What playing for so long does; the model calls it by itself while it plays.
  void Advance(double seconds);

  static constexpr double kSlowest = 0.25;
  static constexpr double kFastest = 64.0;
  static constexpr double kLinger_s = 1.0;
  static constexpr double kLead_s = 0.5;

 public Q_SLOTS:
  /// From the moment that is shown or, where all of a scan is, from its begin.
  void play();
  void pause();
  void togglePlaying() { playing_ ? pause() : play(); }
  void faster() { SetSpeed(2.0 * speed_); }
  void slower() { SetSpeed(0.5 * speed_); }
  void toggleSkipsIdle();
  void nextEvent();
  void previousEvent();
  /// Leaves the replay: all of the scan again.
  void leave();

 Q_SIGNALS:
  void moved();        ///< another moment is shown
  void sweepBroken();  ///< the lines that are shown are not those of before and some more
  void changed();      ///< playing or not, another speed, another scan, idle time skipped or not

 private:
  int ScanAt(std::int64_t utc_ns) const;
  std::int64_t AfterIdle(std::int64_t utc_ns) const;
  void Enter();
  void Forget();
  void FollowReview();
  void ShowMoment();
  void LoadScan(int index);
  void ShowPart();
  void ShowWhole();
  void ShowDepth();
  void ShowObjects(std::vector<FoundObject> objects);
  void KeepDepth();
  void AddObject(const FoundObject& object);

  ReviewViewModel* review_;
  SessionModel* session_;
  DepthViewModel* depth_;
  TimelineModel* timeline_;
  TaskRunner runner_{session_->Tasks()};
  std::optional<ReplayScan> scan_;  ///< that is shown
  int scan_index_ = -1;
  std::vector<int> object_states_;
  int depth_asked_for_ = -1;  ///< image
  std::int64_t now_utc_ns_ = 0;
  bool active_ = false;
  bool playing_ = false;
  bool showing_ = false;  ///< what the session tells now comes from here
  double speed_ = 1.0;
  bool skips_idle_ = true;
  QTimer timer_;
  QElapsedTimer since_;
};

}  // namespace foresight
