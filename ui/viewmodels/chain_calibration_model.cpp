#include "ui/viewmodels/chain_calibration_model.h"

#include <QDir>

#include "core/calibration/mount_detector.h"
#include "core/io/image_file.h"
#include "ui/viewmodels/camera_calibration_model.h"
#include "ui/viewmodels/sentence.h"
#include "ui/viewmodels/stand_rows.h"

namespace foresight {
namespace {

const QString kChainUndoTopic = QStringLiteral("head calibration");
/// Below this number of places the motor's axis is hardly told.
constexpr int kMinPlaces = 3;

/// "checkerboard with 9 x 6 inner corners"
QString InWords(const CalibrationBoard& board) {
  const QString words = board.kind == CalibrationBoard::Kind::kCharuco
                            ? ChainCalibrationModel::tr("ChArUco board with %1 x %2 inner corners")
                            : ChainCalibrationModel::tr("checkerboard with %1 x %2 inner corners");
  return words.arg(board.columns).arg(board.rows);
}

}  // namespace

ChainCalibrationModel::ChainCalibrationModel(HeadViewModel* head, SessionModel* session,
                                             const QString& folder,
                                             std::shared_ptr<MovingStand> stand, QObject* parent)
    : QObject(parent),
      head_(head),
      documents_(session),
      root_(folder.isEmpty() ? CameraCalibrationModel::DefaultFolder() : folder),
      rig_(head, session),
      recorder_(head, session, root_, std::move(stand)),
      live_(head, session->Tasks()) {
  for (TaskRunner* runner : {&opener_, &reader_, &solver_, &viewer_})
    connect(runner, &TaskRunner::changed, this, &ChainCalibrationModel::changed);
  connect(&rig_, &RigVersionModel::changed, this, &ChainCalibrationModel::changed);
  connect(&tour_, &StandTour::changed, this, &ChainCalibrationModel::changed);
  connect(&recorder_, &CalibrationRecorder::kept, this, &ChainCalibrationModel::TakeKept);
  connect(&recorder_, &CalibrationRecorder::changed, this, [this] {
    Advance();
    Announce();
  });
  Clear();
  MakeRows();
}

ChainCalibrationModel::~ChainCalibrationModel() {
  documents_->Undo()->Forget(kChainUndoTopic);
}

QString ChainCalibrationModel::LastSession() const {
  // Names begin with the date and the time.
  const QStringList names =
      QDir(root_).entryList({QStringLiteral("head-*")}, QDir::Dirs, QDir::Name | QDir::Reversed);
  for (const QString& name : names) {
    const QString path = QDir(root_).filePath(name);
    if (path != Folder() && IsCalibrationSession(path.toStdString())) return path;
  }
  return {};
}

void ChainCalibrationModel::Clear() {
  tour_.end();
  recorder_.Forget();
  reader_.cancel();
  solver_.cancel();
  ++session_version_;  // answers that are on their way are of another session
  ++solve_version_;
  found_cache_ = std::make_shared<FoundViews>();
  found_ = {};
  session_.reset();
  read_fault_.clear();
  coverage_ = {};
  read_wanted_ = solve_wanted_ = solve_again_ = false;
  failure_.clear();
  solution_.reset();
  selected_place_ = selected_stop_ = -1;
  selected_image_ = std::make_shared<const GrayImage>();
  rig_.SetFolder({});
  rig_.Forget();
  documents_->Undo()->Forget(kChainUndoTopic);
}

void ChainCalibrationModel::startNew() {
  Clear();
  Announce();
}

void ChainCalibrationModel::OpenSession(const QString& folder) {
  opener_.Run<SessionFolder>(
      tr("Opening the calibration"),
      [path = folder.toStdString()](const RunContext&) { return SessionFolder::Open(path); },
      [this, folder](Result<SessionFolder> opened) {
        if (!opened) {
          documents_->Report(NoticeOf(tr("Opening the calibration"), opened.error()));
          return;
        }
        Clear();
        recorder_.Take(folder, std::move(*opened));
        TakeKept();
      });
}

void ChainCalibrationModel::TakeKept() {
  read_wanted_ = true;
  solve_wanted_ = solve_again_;
  Advance();
  Announce();
}

Status ChainCalibrationModel::SetBoards(const BoardMount& mount,
                                        const CalibrationBoard& single_board) {
  FORESIGHT_CHECK(CheckInImages(mount));
  FORESIGHT_CHECK(single_board.Check());
  if (mount == Mount() && single_board == SingleBoard()) return {};
  DropSolution();
  // What was found is of other boards.
  found_cache_ = std::make_shared<FoundViews>();
  found_ = {};
  recorder_.SetBoards(mount, single_board);
  Announce();
  return {};
}

void ChainCalibrationModel::CaptureStopAgain(int place, int stop) {
  if (place < 0 || place >= static_cast<int>(places_.size()) || place != recorder_.PresentPlace()) {
    documents_->Report({Notice::Level::kInfo, tr("This stop cannot be captured again."),
                        recorder_.PlaceInQuestion() >= 0 ? recorder_.WhyNotCapture()
                                                         : tr("The stand has been moved since.")});
    return;
  }
  const auto& stops = places_[static_cast<std::size_t>(place)].stops;
  if (stop < 0 || stop >= static_cast<int>(stops.size())) return;
  recorder_.CaptureStopAgain(stops[static_cast<std::size_t>(stop)].motor_rad);
}

void ChainCalibrationModel::SetExcluded(const SessionCapture& capture, bool excluded) {
  const QString text = excluded ? tr("Exclude %1") : tr("Include %1");
  // It may have been captured again before this is undone.
  const auto before = recorder_.SetExcluded(capture, excluded);
  documents_->Undo()->Push(
      text.arg(recorder_.NameOf(capture)), kChainUndoTopic,
      [this, before] { recorder_.Swap(before); }, [this, before] { recorder_.Swap(before); });
}

bool ChainCalibrationModel::Busy() const {
  return opener_.Busy() || reader_.Busy() || solver_.Busy() || viewer_.Busy() ||
         recorder_.Writing() || recorder_.Capturing() || tour_.Running() || rig_.Busy();
}

/// Writes first, then reads, then solves.
void ChainCalibrationModel::Advance() {
  if (recorder_.Writing() && !read_wanted_) return;
  if (read_wanted_) {
    if (!reader_.Busy()) StartRead();
    return;
  }
  if (!solve_wanted_ || reader_.Busy() || recorder_.Capturing()) return;
  solve_wanted_ = false;
  StartSolve();
}

void ChainCalibrationModel::StartRead() {
  read_wanted_ = false;
  const auto work = [folder = Folder().toStdString(),
                     cache = found_cache_](const RunContext& context) -> Result<Read> {
    Read read;
    auto session = ReadCalibrationSession(folder, context, cache.get());
    read.found = *cache;
    if (session) {
      read.coverage = MeasureStand(*session, session->prior);
      read.session = std::make_shared<const CalibrationSession>(std::move(*session));
    } else if (session.error().code == ErrorCode::kCancelled) {
      return tl::unexpected(session.error());
    } else {
      read.fault = QString::fromStdString(session.error().message);
    }
    return read;
  };
  reader_.Run<Read>(tr("Reading the calibration"), work,
                    [this, session = session_version_, cache = found_cache_](Result<Read> read) {
                      if (session != session_version_ || cache != found_cache_) {
                        Advance();
                        return;
                      }
                      if (!read) {
                        read_fault_ = tr("Reading was cancelled; Solve reads on.");
                        solve_wanted_ = false;
                        Announce();
                        return;
                      }
                      // A session of many lines is given back off the GUI thread.
                      documents_->Tasks()->Discard(std::exchange(session_, read->session));
                      found_ = std::move(read->found);
                      read_fault_ = read->fault;
                      if (session_) coverage_ = read->coverage;
                      Advance();
                      Announce();
                    });
}

QString ChainCalibrationModel::WhyNotSolve() const {
  if (Folder().isEmpty()) return tr("There is no session yet: the first capture begins one.");
  if (recorder_.Capturing()) return tr("The head is capturing.");
  if (!read_fault_.isEmpty() && !session_) return read_fault_;
  if (session_ && coverage_.poses < kMinPlaces)
    return tr("At least %1 places of the stand are needed; there are %2.")
        .arg(kMinPlaces)
        .arg(coverage_.poses);
  return {};
}

void ChainCalibrationModel::SetStage(CalibrationStage stage) {
  if (stage == stage_) return;
  stage_ = stage;
  solve_wanted_ = solve_again_;
  Advance();
  Announce();
}

void ChainCalibrationModel::solve() {
  solve_wanted_ = solve_again_ = true;
  if (!session_) read_wanted_ = !Folder().isEmpty();
  Advance();
  Announce();
}

void ChainCalibrationModel::cancel() {
  reader_.cancel();
  solver_.cancel();
}

void ChainCalibrationModel::StartSolve() {
  const int version = ++solve_version_;
  if (const QString why = WhyNotSolve(); !why.isEmpty() || !session_) {
    solver_.cancel();
    DropSolution();
    failure_ = why;
    return;
  }
  solver_.Run<ChainSolution>(
      tr("Calibrating the head"),
      [session = session_, stage = stage_](const RunContext& context) {
        return SolveSession(*session, stage, context);
      },
      [this, version](Result<ChainSolution> solution) {
        if (version == solve_version_) TakeSolution(std::move(solution));
      });
}

void ChainCalibrationModel::TakeSolution(Result<ChainSolution> solution) {
  DropSolution();
  if (!solution) {
    failure_ = solution.error().code == ErrorCode::kCancelled
                   ? tr("The solve was cancelled; Solve starts it again.")
                   : Sentence(solution.error().message);
  } else {
    coverage_ = solution->coverage;
    solution_ = std::make_shared<const ChainSolution>(std::move(*solution));
  }
  Announce();
}

void ChainCalibrationModel::DropSolution() {
  failure_.clear();
  if (solution_) documents_->Tasks()->Discard(std::exchange(solution_, nullptr));
  rig_.Forget();
}

QString ChainCalibrationModel::StateText() const {
  if (recorder_.Capturing())
    return recorder_.CapturingBoardImage() ? tr("Capturing an image.")
                                           : tr("The head is capturing.");
  if (opener_.Busy()) return tr("Opening the calibration.");
  if (Reading()) return tr("Looking for the boards.");
  if (Solving()) {
    const QString stage = SolveStage();
    return stage.isEmpty() ? tr("Calibrating.") : tr("Calibrating: %1.").arg(stage);
  }
  if (!failure_.isEmpty()) return failure_;
  if (solution_)
    return tr("Calibrated from %1 views of boards and %2 lidar lines.")
        .arg(solution_->found.images.size())
        .arg(solution_->found.lines.size());
  if (const QString none = NoBoardFound(); !none.isEmpty()) return none;
  const QString why = WhyNotSolve();
  return why.isEmpty() ? tr("Not calibrated yet.") : why;
}

/// Where the boards that were typed are in none of some images that can be used, they are the wrong
/// ones.
QString ChainCalibrationModel::NoBoardFound() const {
  constexpr int kSome = 3;
  int without = 0, unusable = 0;
  QString fault;
  for (const StandPlaceRow& row : places_)
    for (const StopLamp& lamp : row.stops) {
      if (lamp.state == StopLamp::State::kOneBoard || lamp.state == StopLamp::State::kBothBoards)
        return {};
      if (lamp.state != StopLamp::State::kNoBoard) continue;
      ++(lamp.fault.isEmpty() ? without : unusable);
      if (fault.isEmpty()) fault = lamp.fault;
    }
  if (without < kSome)
    return unusable < kSome ? QString()
                            : tr("None of %1 images shows a board, and %2 of them cannot be used, "
                                 "such as: %3. Check the exposure and the focus.")
                                  .arg(without + unusable)
                                  .arg(unusable)
                                  .arg(fault);
  return tr("None of %1 images shows %2: check the boards in step 1, and what the camera sees.")
      .arg(without)
      .arg(Mount().b ? tr("a %1 or a %2").arg(InWords(Mount().a), InWords(*Mount().b))
                     : tr("a %1").arg(InWords(Mount().a)));
}

std::vector<CalibrationCheck> ChainCalibrationModel::Verdict() const {
  if (!solution_ || !session_) return {};
  return JudgeSolution(*solution_, *session_);
}

QString ChainCalibrationModel::GraphInWords() const {
  if (!session_ || coverage_.poses == 0) return {};
  const std::string words = coverage_.graph.InWords(*session_);
  return words.empty() ? QString() : Sentence(words);
}

QString ChainCalibrationModel::Weakest() const {
  return solution_ && !solution_->found.weakest.empty()
             ? tr("Known worst: %1.").arg(QString::fromStdString(solution_->found.weakest))
             : QString();
}

QString ChainCalibrationModel::Next() const {
  const QString next = QString::fromStdString(NextPlace(coverage_));
  return next.isEmpty() ? tr("next: nothing, no further place is needed")
                        : tr("next: %1").arg(next);
}

void ChainCalibrationModel::Select(int place, int stop) {
  if (place < 0 || place >= static_cast<int>(places_.size())) return;
  const auto& stops = places_[static_cast<std::size_t>(place)].stops;
  if (stop < 0 || stop >= static_cast<int>(stops.size())) return;
  selected_place_ = place;
  selected_stop_ = stop;
  selected_image_ = std::make_shared<const GrayImage>();
  const int number = stops[static_cast<std::size_t>(stop)].number;
  const std::string file = number < 0 ? ""
                                      : recorder_.Index()
                                            .poses[static_cast<std::size_t>(place)]
                                            .stops[static_cast<std::size_t>(number)]
                                            .view.image;
  if (!file.empty()) {
    using Image = std::shared_ptr<const GrayImage>;
    viewer_.Run<Image>(
        tr("Reading an image"),
        [path = Folder().toStdString() + "/" + file](const RunContext&) -> Result<Image> {
          FORESIGHT_TRY(GrayImage image, ReadImageGray(path));
          return std::make_shared<const GrayImage>(std::move(image));
        },
        [this, place, stop](const Result<Image>& image) {
          if (place != selected_place_ || stop != selected_stop_ || !image) return;
          selected_image_ = *image;
          Announce();
        });
  }
  Announce();
}

const MountView* ChainCalibrationModel::SelectedView() const {
  if (selected_place_ < 0 || selected_place_ >= static_cast<int>(places_.size())) return nullptr;
  const auto& stops = places_[static_cast<std::size_t>(selected_place_)].stops;
  if (selected_stop_ >= static_cast<int>(stops.size())) return nullptr;
  const int number = stops[static_cast<std::size_t>(selected_stop_)].number;
  if (number < 0) return nullptr;
  return FoundIn(found_.stops, recorder_.Index()
                                   .poses[static_cast<std::size_t>(selected_place_)]
                                   .stops[static_cast<std::size_t>(number)]
                                   .view.File());
}

std::vector<LidarImagePoint> ChainCalibrationModel::SelectedPoints() const {
  std::vector<LidarImagePoint> points;
  if (!solution_ || selected_place_ < 0) return points;
  // The solution counts places that are not excluded.
  int pose = -1;
  for (int place = 0; place <= selected_place_; ++place)
    pose += recorder_.Index().poses[static_cast<std::size_t>(place)].excluded ? 0 : 1;
  if (recorder_.Index().poses[static_cast<std::size_t>(selected_place_)].excluded) return points;
  const double angle = places_[static_cast<std::size_t>(selected_place_)]
                           .stops[static_cast<std::size_t>(selected_stop_)]
                           .motor_rad;
  const std::vector<double>& stops = solution_->found.state.motor_rad;
  for (const LidarImagePoint& point : solution_->points)
    if (point.pose == pose && SameStop(stops[static_cast<std::size_t>(point.stop)], angle))
      points.push_back(point);
  return points;
}

void ChainCalibrationModel::MakeRows() {
  const StandRowsSource source{.index = &recorder_.Index(),
                               .found = &found_,
                               .solution = solution_.get(),
                               .stage = stage_,
                               .present_place = recorder_.PresentPlace(),
                               .planned_rad = recorder_.Plan().StopAngles()};
  places_ = StandPlaceRows(source);
  board_images_ = BoardImageRows(source);
}

void ChainCalibrationModel::Announce() {
  MakeRows();
  rig_.SetFolder(Folder());
  live_.SetMount(Mount(), head_->Rig().camera);
  Q_EMIT changed();
}

QString ChainCalibrationModel::WhyNotSaveRig() const {
  if (!solution_ || !session_) return tr("There is no result yet.");
  if (!SolutionIsCurrent()) return tr("The result is being made again.");
  const SensorRig rig = head_->Rig();
  const SensorRig& found = solution_->found.rig;
  if (rig.camera.width != found.camera.width || rig.camera.height != found.camera.height ||
      rig.lidar.beams != found.lidar.beams)
    return tr("The session is of a camera with %1 x %2 px and a lidar with %3 beams: it is of "
              "another head.")
        .arg(found.camera.width)
        .arg(found.camera.height)
        .arg(found.lidar.beams);
  return {};
}

QString ChainCalibrationModel::SuggestedRigFile() const {
  return RigVersionModel::FreeFile(QString::fromStdString(head_->Rig().name));
}

void ChainCalibrationModel::SaveRig(const QString& path) {
  if (const QString why = WhyNotSaveRig(); !why.isEmpty()) {
    documents_->Report({Notice::Level::kInfo, tr("The rig cannot be saved now."), why});
    return;
  }
  rig_.Save(rig_.WithChain(solution_->found.rig), path);
}

}  // namespace foresight
