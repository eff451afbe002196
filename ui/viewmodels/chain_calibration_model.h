#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/calibration/session_file.h"
#include "core/calibration/session_folder.h"
#include "ui/viewmodels/chain_solution.h"
#include "ui/viewmodels/head_captures.h"
#include "ui/viewmodels/live_board_model.h"
#include "ui/viewmodels/rig_version_model.h"
#include "ui/viewmodels/stand_place_row.h"

namespace foresight {

/// What the head does at each place of the stand.
struct StandPlan {
  double first_deg = -30.0;
  double last_deg = 80.0;
  double step_deg = 10.0;
  int lines = 40;  ///< at each stop
  double sweep_speed_deg_s = 50.0;

  std::vector<double> StopAngles() const;
};

/// Calibrates camera, motor, lidar and time of a head from a stand of boards at several places: a
/// wizard whose steps can be taken in any order. Everything that the head captures is in the
/// session's folder before anything is computed from it (docs/formats.md), so that a session goes
/// on after a crash, and `foresightctl calibrate` computes the same from it.
class ChainCalibrationModel : public QObject {
  Q_OBJECT

 public:
  /// Sessions are folders in `folder`; empty = CameraCalibrationModel::DefaultFolder().
  ChainCalibrationModel(HeadViewModel* head, SessionModel* session, const QString& folder = {},
                        QObject* parent = nullptr);
  ~ChainCalibrationModel() override;

  /// The folder of the session; empty until the first capture.
  const QString& Folder() const { return folder_; }
  /// The newest session there is but the one that is open; empty = none.
  QString LastSession() const;
  /// One that was made here, on a robot, or by `foresightctl simulate calibration`.
  void OpenSession(const QString& folder);

  const BoardMount& Mount() const { return mount_; }
  const CalibrationBoard& SingleBoard() const { return single_board_; }
  /// Looks for them in all images again. Fails with kInvalidOptions; nothing changes then.
  Status SetBoards(const BoardMount& mount, const CalibrationBoard& single_board);
  const StandPlan& Plan() const { return plan_; }
  void SetPlan(const StandPlan& plan);

  HeadCaptures* Captures() { return &captures_; }
  LiveBoardModel* Live() { return &live_; }
  /// Why the head cannot capture now, as a sentence; empty when it can.
  QString WhyNotCapture() const;
  QString WhyNotSweep() const;
  QString WhyNotNewPlace() const;
  /// Captures a stop of the present place once more; the earlier capture stays on the disk.
  void CaptureStopAgain(int place, int stop);

  const std::vector<StandPlaceRow>& Places() const { return places_; }
  const std::vector<BoardImageRow>& BoardImages() const { return board_images_; }
  /// Leaves a capture out, or takes it in again; can be undone. The solve follows where one was
  /// made before.
  void SetExcluded(const SessionCapture& capture, bool excluded);
  /// "next: the stand higher, so that the stops 70, 80 deg see it".
  QString Next() const;

  CalibrationStage Stage() const { return stage_; }
  void SetStage(CalibrationStage stage);
  QString WhyNotSolve() const;

  bool Reading() const { return reader_.Busy() || opener_.Busy(); }
  bool Solving() const { return solver_.Busy(); }
  int ReadPermille() const { return reader_.Permille(); }
  int SolvePermille() const { return solver_.Permille(); }
  QString SolveStage() const { return solver_.Stage(); }
  bool Busy() const;
  /// What goes on, or what is missing for a result, as a sentence.
  QString StateText() const;

  /// nullptr = none yet.
  const std::shared_ptr<const ChainSolution>& Solution() const { return solution_; }
  /// Of the captures, boards and stage as they are now.
  bool SolutionIsCurrent() const { return solution_ && !solve_wanted_ && !read_wanted_ && !Busy(); }
  std::vector<CalibrationCheck> Verdict() const;
  /// Stops that no image shows, or that nothing ties to 0 deg; empty where there is none.
  QString GraphInWords() const;
  /// What is known worst, and what to record for it.
  QString Weakest() const;
  int ImageWidth() const { return session_ ? session_->prior.camera.width : 0; }
  int ImageHeight() const { return session_ ? session_->prior.camera.height : 0; }
  const std::shared_ptr<const CalibrationSession>& Session() const { return session_; }

  /// The operator looks at a stop: its image is read where it has one.
  void Select(int place, int stop);
  int SelectedPlace() const { return selected_place_; }
  int SelectedStop() const { return selected_stop_; }
  /// Empty where there is none.
  const GrayImage& SelectedImage() const { return *selected_image_; }
  const MountView* SelectedView() const;
  /// The solution's returns at the selected stop.
  std::vector<LidarImagePoint> SelectedPoints() const;

  RigVersionModel* Rig() { return &rig_; }
  QString WhyNotSaveRig() const;
  QString SuggestedRigFile() const;
  void SaveRig(const QString& path);

 public Q_SLOTS:
  void startNew();
  /// One image of the single board, for the camera alone.
  void captureBoardImage();
  /// The stand was put to another place.
  void newPlace();
  /// The stops of the present place that are not captured yet; begins the first place.
  void captureStops();
  void captureSweep();
  void solve();
  void cancel();

 Q_SIGNALS:
  void changed();

 private:
  using Holder = std::shared_ptr<std::optional<SessionFolder>>;
  using Change = std::function<Result<SessionCapture>(SessionFolder&)>;
  struct Read {
    std::shared_ptr<const CalibrationSession> session;  ///< nullptr: see fault
    QString fault;
    StandCoverage coverage;
    FoundViews found;
  };

  QString Root() const;
  void Clear();
  void MakeSession();
  /// Writes something into the session's folder; what was written is read and shown then.
  void Write(const QString& title, Change change, std::function<void(SessionCapture)> done = {});
  void TakeIndex(const SessionIndex& index);
  void TakeCapture(const std::shared_ptr<const StopCapture>& capture);
  void TakeStopsEnd(bool complete, const QString& reason);
  void TakeSweep(const std::shared_ptr<const Scan>& scan);
  void ShowExcluded(const SessionCapture& capture, bool excluded);
  void StartCapture(const std::vector<double>& angles_rad);
  QString NameOf(const SessionCapture& capture) const;
  void Advance();
  void StartRead();
  void StartSolve();
  void TakeSolution(Result<ChainSolution> solution);
  void DropSolution();
  void MakeRows();
  StopLamp LampOf(const SessionStopFiles& stop, int number) const;
  void Announce();

  HeadViewModel* head_;
  SessionModel* documents_;
  QString root_;
  QString folder_;
  BoardMount mount_ = DefaultBoardMount();
  CalibrationBoard single_board_{.columns = 8, .rows = 6, .square_m = 0.050};
  StandPlan plan_;
  CalibrationStage stage_ = CalibrationStage::kAll;
  /// Touched by the writer's tasks only, one after the other.
  Holder holder_;
  SessionIndex index_;
  int present_place_ = -1;  ///< that captures go to
  bool capturing_board_image_ = false;
  int session_version_ = 0;

  /// Touched by the reader's tasks only; with the boards as they are.
  std::shared_ptr<FoundViews> found_cache_;
  FoundViews found_;  ///< a copy of what the last read knew
  std::shared_ptr<const CalibrationSession> session_;
  QString read_fault_;
  StandCoverage coverage_;
  bool read_wanted_ = false;

  bool solve_wanted_ = false;
  bool solve_again_ = false;  ///< the operator asked for a solve before: it follows each change
  int solve_version_ = 0;
  QString failure_;
  std::shared_ptr<const ChainSolution> solution_;

  std::vector<StandPlaceRow> places_;
  std::vector<BoardImageRow> board_images_;
  int selected_place_ = -1;
  int selected_stop_ = -1;
  std::shared_ptr<const GrayImage> selected_image_ = std::make_shared<const GrayImage>();

  RigVersionModel rig_;
  HeadCaptures captures_;
  LiveBoardModel live_;
  TaskRunner opener_{documents_->Tasks(), TaskPolicy::kReplace};
  TaskRunner reader_{documents_->Tasks(), TaskPolicy::kQueue};
  TaskRunner solver_{documents_->Tasks(), TaskPolicy::kReplace};
  TaskRunner viewer_{documents_->Tasks(), TaskPolicy::kReplace};
  TaskRunner writer_{documents_->Tasks(), TaskPolicy::kNeverCancel};
};

}  // namespace foresight
