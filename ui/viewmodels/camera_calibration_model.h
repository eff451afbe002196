#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <atomic>
#include <limits>
#include <memory>
#include <vector>

#include "core/calibration/board_images.h"
#include "core/calibration/camera_session.h"
#include "core/calibration/intrinsics.h"
#include "core/calibration/view_coverage.h"
#include "ui/viewmodels/calibration_check.h"
#include "ui/viewmodels/camera_maps.h"
#include "ui/viewmodels/head_captures.h"
#include "ui/viewmodels/live_board_model.h"
#include "ui/viewmodels/rig_version_model.h"

namespace foresight {

/// One image of a calibration as a panel shows it.
struct CalibrationImageRow {
  enum class State { kReading, kUsed, kRejected, kExcluded };
  QString name;
  QString origin;  ///< the file that it came from, or the head
  State state = State::kReading;
  QString reason = {};  ///< why it is not used, in words
  ImageRating rating = {};
  double rms_px = std::numeric_limits<double>::quiet_NaN();  ///< under the chosen model
  GrayImage thumbnail = {};
};

/// One model of a result as a panel shows it.
struct CalibrationModelRow {
  LensModel model = LensModel::kFisheyeK;
  QString title;
  double mean_error_px = 0.0;
  double rms_px = 0.0;
  double cross_validation_px = 0.0;  ///< NaN: too few images
  QString parameters = {};           ///< one a line, with its standard deviation
  QString failure = {};              ///< why it cannot be used
};

/// Calibrates the head's camera from images of a board: a wizard without an order of steps. Each
/// image is kept in the session's folder and rated as it comes; the solve follows by itself after
/// each change, the newest alone counts. Touches neither the recording nor the head, but for the
/// rig that the operator puts in force.
class CameraCalibrationModel : public QObject {
  Q_OBJECT

 public:
  /// Sessions are folders in `folder`; empty = DefaultFolder().
  CameraCalibrationModel(HeadViewModel* head, SessionModel* session, const QString& folder = {},
                         QObject* parent = nullptr);
  ~CameraCalibrationModel() override;

  /// `~/.local/share/foresight/workstation/calibrations`.
  static QString DefaultFolder();

  /// The folder of the session; empty until the first image.
  const QString& Folder() const { return folder_; }
  /// The newest session there is but the one that is open; empty = none.
  QString LastSession() const;
  void OpenSession(const QString& folder);

  const CalibrationBoard& Board() const { return board_; }
  /// Looks for it in all images again. Fails with kInvalidOptions; nothing changes then.
  Status SetBoard(const CalibrationBoard& board);
  const std::vector<LensModel>& Models() const { return models_; }
  /// At least one stays.
  void SetModels(const std::vector<LensModel>& models);

  /// Image files, and folders of them.
  void AddFiles(const QStringList& places);
  QString WhyNotTakeFromHead() const;
  /// Why the head cannot capture an image now.
  QString WhyNotCapture() const { return captures_.WhyNot(); }
  LiveBoardModel* Live() { return &live_; }

  const std::vector<CalibrationImageRow>& Images() const { return rows_; }
  int UsedCount() const;
  /// The operator leaves an image out, or takes it in again; can be undone.
  void SetExcluded(int index, bool excluded);

  bool Reading() const { return reader_.Busy(); }
  bool Solving() const { return solver_.Busy(); }
  /// Of the images that are being read, and of the solve.
  int ReadPermille() const;
  int SolvePermille() const { return solver_.Permille(); }
  bool Busy() const {
    return Reading() || Solving() || keeper_.Busy() || mapper_.Busy() || captures_.Running() ||
           rig_.Busy();
  }
  /// What goes on, or what is missing for a result, as a sentence.
  QString StateText() const;

  /// nullptr = none yet, or the images no longer give one.
  const std::shared_ptr<const IntrinsicsCalibration>& Calibration() const { return result_; }
  /// Whether the result is of the images, board and models as they are now.
  bool ResultIsCurrent() const { return result_ != nullptr && !solve_wanted_ && !Solving(); }
  std::vector<CalibrationModelRow> ModelRows() const;
  /// Of the models; -1 = none.
  int Chosen() const { return chosen_; }
  /// The operator looks at, and would save, another usable model than the best one.
  void Choose(int index);
  QString WhyChosen() const;
  /// The chosen model; nullptr = none.
  const ModelCalibration* ChosenModel() const;

  std::vector<CalibrationCheck> Verdict() const;
  const ViewCoverage& Coverage() const { return coverage_; }
  int ImageWidth() const { return width_; }
  int ImageHeight() const { return height_; }
  /// "next: the board at the left edge, tilted by over 20 deg".
  QString Next() const;

  /// Maps of the chosen model at this distance, and at infinity, are wanted from now on.
  void WantMaps(double distance_m);
  /// nullptr = not made yet.
  const std::shared_ptr<const CameraMaps>& Maps() const { return maps_; }

  RigVersionModel* Rig() { return &rig_; }
  QString WhyNotSaveRig() const;
  QString SuggestedRigFile() const;
  /// The rig in force with the chosen camera, as a new file.
  void SaveRig(const QString& path);

 public Q_SLOTS:
  void startNew();
  /// The image that the live document shows.
  void takeFromHead();
  /// One image of full size, where the head stands.
  void captureFromHead();
  void solve();
  void cancel();

 Q_SIGNALS:
  void changed();

 private:
  struct Entry {
    CameraSessionImage kept;
    bool on_disk = false;  ///< in the session's folder
    bool read = false;
    BoardImage image = {};
    GrayImage thumbnail = {};
  };
  struct ReadResult {
    bool on_disk = false;
    BoardImage image = {};
    GrayImage thumbnail = {};
  };

  QString Root() const;
  void MakeFolder();
  void Clear();
  std::string NewFileName(const std::string& name);
  /// `bytes` gives the image's file; it runs in a worker thread.
  void Read(const CameraSessionImage& image, bool on_disk,
            std::function<Result<std::string>()> bytes);
  void ReadAgain(const Entry& entry);
  void TakeRead(const std::string& file, int board_version, Result<ReadResult> read);
  void ShowExcluded(const std::string& file, bool excluded);
  void Keep();
  /// Images, board or models changed: sorts the images anew, keeps the session, and solves.
  void Changed();
  void AddFromHead(const ColorImage& image, double motor_rad);
  void SortImages();
  void MakeRows();
  void Advance();
  void StartSolve();
  void TakeResult(Result<IntrinsicsCalibration> result);
  void MakeMaps();
  void Announce();

  HeadViewModel* head_;
  SessionModel* session_;
  QString root_;
  QString folder_;
  CalibrationBoard board_{.columns = 7, .rows = 6, .square_m = 0.030};
  std::vector<LensModel> models_ = IntrinsicsOptions().models;
  std::vector<Entry> entries_;
  int next_number_ = 1;
  /// Counts boards; shared with the reading threads, which look for no board of yesterday.
  std::shared_ptr<std::atomic<int>> board_version_ = std::make_shared<std::atomic<int>>(0);
  int session_version_ = 0;
  int solve_version_ = 0;
  BoardImages sorted_;  ///< of the images that are not excluded
  std::vector<CalibrationImageRow> rows_;
  int width_ = 0;
  int height_ = 0;

  bool keep_wanted_ = false;
  bool solve_wanted_ = false;
  QString failure_;  ///< of the last solve
  std::vector<std::string> solved_files_;
  std::shared_ptr<const IntrinsicsCalibration> result_;
  int chosen_ = -1;
  ViewCoverage coverage_;

  double map_distance_m_ = 0.0;  ///< 0 = nobody looks at the maps
  std::shared_ptr<const CameraMaps> maps_;

  RigVersionModel rig_;
  HeadCaptures captures_;
  LiveBoardModel live_;
  TaskRunner reader_{session_->Tasks(), TaskPolicy::kQueue};
  TaskRunner solver_{session_->Tasks(), TaskPolicy::kReplace};
  TaskRunner mapper_{session_->Tasks(), TaskPolicy::kReplace};
  TaskRunner keeper_{session_->Tasks(), TaskPolicy::kNeverCancel};
};

}  // namespace foresight
