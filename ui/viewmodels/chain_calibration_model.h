#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "core/calibration/session_file.h"
#include "ui/viewmodels/calibration_recorder.h"
#include "ui/viewmodels/chain_solution.h"
#include "ui/viewmodels/live_board_model.h"
#include "ui/viewmodels/rig_version_model.h"
#include "ui/viewmodels/stand_place_row.h"
#include "ui/viewmodels/stand_tour.h"

namespace foresight {

/// Calibrates camera, motor, lidar and time of a head from a stand of boards at several places: a
/// wizard whose steps can be taken in any order. Everything that the head captures is in the
/// session's folder before anything is computed from it (docs/formats.md), so that a session goes
/// on after a crash, and `foresightctl calibrate` computes the same from it.
class ChainCalibrationModel : public QObject {
  Q_OBJECT

 public:
  /// Sessions are folders in `folder`; empty = CameraCalibrationModel::DefaultFolder(). `stand` is
  /// one that moves by itself, or nullptr.
  ChainCalibrationModel(HeadViewModel* head, SessionModel* session, const QString& folder = {},
                        std::shared_ptr<MovingStand> stand = nullptr, QObject* parent = nullptr);
  ~ChainCalibrationModel() override;

  /// The folder of the session; empty until the first capture.
  const QString& Folder() const { return recorder_.Folder(); }
  /// The newest session there is but the one that is open; empty = none.
  QString LastSession() const;
  /// One that was made here, on a robot, or by `foresightctl simulate calibration`.
  void OpenSession(const QString& folder);

  CalibrationRecorder* Recorder() { return &recorder_; }
  StandTour* Tour() { return &tour_; }
  LiveBoardModel* Live() { return &live_; }
  const BoardMount& Mount() const { return recorder_.Mount(); }
  const CalibrationBoard& SingleBoard() const { return recorder_.SingleBoard(); }
  /// Looks for them in all images again. Fails with kInvalidOptions; nothing changes then.
  Status SetBoards(const BoardMount& mount, const CalibrationBoard& single_board);
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
  void solve();
  void cancel();

 Q_SIGNALS:
  void changed();

 private:
  struct Read {
    std::shared_ptr<const CalibrationSession> session;  ///< nullptr: see fault
    QString fault;
    StandCoverage coverage;
    FoundViews found;
  };

  QString Root() const;
  void Clear();
  void TakeKept();
  void Advance();
  void StartRead();
  void StartSolve();
  void TakeSolution(Result<ChainSolution> solution);
  void DropSolution();
  void MakeRows();
  QString NoBoardFound() const;
  void Announce();

  HeadViewModel* head_;
  SessionModel* documents_;
  QString root_;
  CalibrationStage stage_ = CalibrationStage::kAll;
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
  CalibrationRecorder recorder_;
  StandTour tour_{&recorder_};
  LiveBoardModel live_;
  TaskRunner opener_{documents_->Tasks(), TaskPolicy::kReplace};
  TaskRunner reader_{documents_->Tasks(), TaskPolicy::kQueue};
  TaskRunner solver_{documents_->Tasks(), TaskPolicy::kReplace};
  TaskRunner viewer_{documents_->Tasks(), TaskPolicy::kReplace};
};

}  // namespace foresight
