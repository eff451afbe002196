#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/calibration/session_folder.h"
#include "hardware/api/moving_stand.h"
#include "ui/viewmodels/head_captures.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// What the head does at each place of the stand.
struct StandPlan {
  double first_deg = -30.0;
  double last_deg = 80.0;
  double step_deg = 10.0;
  int lines = 40;  ///< at each stop
  double exposure_ms = 4.0;
  double sweep_speed_deg_s = 50.0;

  std::vector<double> StopAngles() const;
};

/// Records a calibration session: what the head captures is in the session's folder
/// (docs/formats.md) as it comes, before anything is computed from it, so that a session goes on
/// after a crash.
class CalibrationRecorder : public QObject {
  Q_OBJECT

 public:
  /// New sessions are folders in `root`; boards are those of the stand, or the usual ones.
  CalibrationRecorder(HeadViewModel* head, SessionModel* documents, const QString& root,
                      std::shared_ptr<MovingStand> stand, QObject* parent = nullptr);

  /// The folder of the session; empty until the first capture.
  const QString& Folder() const { return folder_; }
  const SessionIndex& Index() const { return index_; }
  /// What is captured next belongs to a session that is not there yet.
  void Forget();
  /// Goes on with a session.
  void Take(const QString& folder, SessionFolder session);

  const BoardMount& Mount() const { return mount_; }
  const CalibrationBoard& SingleBoard() const { return single_board_; }
  /// @pre both pass their Check()
  void SetBoards(const BoardMount& mount, const CalibrationBoard& single_board);
  const StandPlan& Plan() const { return plan_; }
  void SetPlan(const StandPlan& plan);

  /// nullptr where the stand is carried.
  const MovingStand* Stand() const { return stand_.get(); }
  bool StandMoves() const { return stand_ && stand_->Moving(); }
  QString WhyNotMoveStand() const;
  /// To one of its places, -1 = away; the next capture begins a place of the session.
  void MoveStand(int place);

  HeadCaptures* Captures() { return &captures_; }
  bool Capturing() const { return captures_.Running(); }
  bool CapturingBoardImage() const { return capturing_board_image_; }
  /// Something is on its way to the disk.
  bool Writing() const { return writer_.Busy(); }
  /// Of the session that captures go to; -1 = none yet.
  int PresentPlace() const { return present_place_; }
  /// The last place of a session that was opened, where a carried stand may still be: nobody but
  /// the operator knows; -1 = there is no question.
  int PlaceInQuestion() const { return place_in_question_; }
  /// Why no image for the camera alone can be captured now, as a sentence; empty when it can.
  QString WhyNotBoardImage() const;
  /// The same of stops.
  QString WhyNotCapture() const;
  QString WhyNotSweep() const;
  QString WhyNotNewPlace() const;
  /// Stops of the plan that the present place does not have yet.
  std::vector<double> MissingStops() const;
  /// Whether the present place has a sweep, or the place of the stand its image for the camera
  /// alone, that is not excluded.
  bool HasSweep() const;
  bool HasBoardImage() const;
  /// Captures a stop of the present place once more; the earlier capture stays on the disk.
  void CaptureStopAgain(double motor_rad);
  /// One image of the single board at an angle, for the camera alone.
  void CaptureBoardImageAt(double motor_rad);

  /// What was left out before a change, for the way back; empty until the change is on the disk.
  using LeftOut = std::shared_ptr<SessionFolder::LeftOut>;
  /// Leaves a capture out, or takes it in again.
  LeftOut SetExcluded(const SessionCapture& capture, bool excluded);
  /// Goes back to what was left out before a change; a second call takes that back.
  void Swap(const LeftOut& before);
  /// "pose 2, 40°"
  QString NameOf(const SessionCapture& capture) const;

 public Q_SLOTS:
  /// The same where the head stands.
  void captureBoardImage();
  /// The stand was put to another place.
  void newPlace();
  /// The stand is still at the place in question.
  void samePlace();
  /// The stops of the present place that are not captured yet; begins the first place.
  void captureStops();
  void captureSweep();

 Q_SIGNALS:
  /// Index() is of something new on the disk.
  void kept();
  /// A capture of the operator's came to its end; what there is of it is being kept.
  void captureEnded(bool complete);
  /// Something of this session could not be kept; why was told.
  void writeFailed();
  void changed();

 private:
  using Holder = std::shared_ptr<std::optional<SessionFolder>>;
  using Change = std::function<Result<SessionCapture>(SessionFolder&)>;

  void MakeSession();
  /// Writes something into the session's folder.
  void Write(const QString& title, Change change, std::function<void(SessionCapture)> done = {},
             std::function<void()> failed = {});
  void LookAtStand();
  void BeginPlace();
  /// Of the place that the stand is known to be at; empty = not known.
  std::string NameOfStandsPlace() const;
  int PlaceOfStand() const;
  void TakeCapture(const std::shared_ptr<const StopCapture>& capture);
  void TakeStopsEnd(bool complete, const QString& reason);
  void TakeSweep(const std::shared_ptr<const Scan>& scan);
  /// Whether it began.
  bool StartCapture(const std::vector<double>& angles_rad);
  const SessionPoseFiles* PresentPose() const;

  HeadViewModel* head_;
  SessionModel* documents_;
  QString root_;
  QString folder_;
  std::shared_ptr<MovingStand> stand_;
  BoardMount mount_;
  CalibrationBoard single_board_;
  StandPlan plan_;
  /// Touched by the writer's tasks only, one after the other.
  Holder holder_ = std::make_shared<std::optional<SessionFolder>>();
  SessionIndex index_;
  int present_place_ = -1;
  int place_in_question_ = -1;
  /// Number of the place that was begun last; empty until it is on the disk. Touched by the
  /// writer's tasks only. nullptr = none was begun since the stand was moved.
  std::shared_ptr<std::optional<int>> begun_place_;
  bool capturing_board_image_ = false;
  int version_ = 0;  ///< of the session: answers that are on their way may be of another one

  QTimer stand_look_;  ///< while it moves

  HeadCaptures captures_;
  TaskRunner writer_{documents_->Tasks(), TaskPolicy::kNeverCancel};
};

}  // namespace foresight
