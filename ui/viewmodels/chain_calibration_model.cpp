#include "ui/viewmodels/chain_calibration_model.h"

#include <QDateTime>
#include <QDir>
#include <algorithm>
#include <cmath>

#include "core/calibration/perpendicular_mount.h"
#include "core/geometry/angles.h"
#include "core/io/image_file.h"
#include "ui/viewmodels/camera_calibration_model.h"

namespace foresight {
namespace {

const QString kUndoTopic = QStringLiteral("head calibration");
constexpr double kHinge_m = 0.065;
/// Below this number of places the motor's axis is hardly told.
constexpr int kMinPlaces = 3;
/// A stop whose corners fit this many times worse than the median stands out.
constexpr double kStandsOut = 3.0;

/// Boards that can be told apart.
BoardMount UsualMount() {
  CalibrationBoard a{.columns = 9, .rows = 6, .square_m = 0.050};
  CalibrationBoard b = a;
  b.columns = 7;
  return PerpendicularMount(a, b, kHinge_m);
}

QString DegreesText(double angle_rad) {
  return QString::number(DegreesFromRadians(angle_rad), 'g', 4);
}

QString Sentence(const std::string& text) {
  QString sentence = QString::fromStdString(text);
  if (!sentence.isEmpty()) sentence[0] = sentence[0].toUpper();
  return sentence + QLatin1Char('.');
}

const MountView* ViewOf(const std::map<std::string, MountView>& views, const std::string& file) {
  const auto at = views.find(file);
  return at == views.end() ? nullptr : &at->second;
}

bool SameStop(double a_rad, double b_rad) {
  return std::abs(a_rad - b_rad) < kSameStop_rad;
}

}  // namespace

std::vector<double> StandPlan::StopAngles() const {
  std::vector<double> angles;
  constexpr int kMost = 100;
  for (int i = 0; i < kMost; ++i) {
    const double angle_deg = first_deg + i * step_deg;
    if (!(step_deg > 0.0) || angle_deg > last_deg + 1e-6) break;
    angles.push_back(RadiansFromDegrees(angle_deg));
  }
  return angles;
}

ChainCalibrationModel::ChainCalibrationModel(HeadViewModel* head, SessionModel* session,
                                             const QString& folder, QObject* parent)
    : QObject(parent),
      head_(head),
      documents_(session),
      root_(folder),
      mount_(UsualMount()),
      single_board_(mount_.a),
      rig_(head, session),
      captures_(head),
      live_(head, session->Tasks()) {
  for (TaskRunner* runner : {&opener_, &reader_, &solver_, &viewer_, &writer_})
    connect(runner, &TaskRunner::changed, this, &ChainCalibrationModel::changed);
  connect(&rig_, &RigVersionModel::changed, this, &ChainCalibrationModel::changed);
  connect(&captures_, &HeadCaptures::changed, this, &ChainCalibrationModel::changed);
  connect(&captures_, &HeadCaptures::captured, this, &ChainCalibrationModel::TakeCapture);
  connect(&captures_, &HeadCaptures::stopsEnded, this, &ChainCalibrationModel::TakeStopsEnd);
  connect(&captures_, &HeadCaptures::sweepEnded, this, &ChainCalibrationModel::TakeSweep);
  Clear();
  MakeRows();
}

ChainCalibrationModel::~ChainCalibrationModel() {
  documents_->Undo()->Forget(kUndoTopic);
}

QString ChainCalibrationModel::Root() const {
  return root_.isEmpty() ? CameraCalibrationModel::DefaultFolder() : root_;
}

QString ChainCalibrationModel::LastSession() const {
  // Names begin with the date and the time.
  const QStringList names =
      QDir(Root()).entryList({QStringLiteral("head-*")}, QDir::Dirs, QDir::Name | QDir::Reversed);
  for (const QString& name : names) {
    const QString path = QDir(Root()).filePath(name);
    if (path != folder_ && IsCalibrationSession(path.toStdString())) return path;
  }
  return {};
}

void ChainCalibrationModel::Clear() {
  captures_.end();
  reader_.cancel();
  solver_.cancel();
  ++session_version_;  // answers that are on their way are of another session
  ++solve_version_;
  folder_.clear();
  holder_ = std::make_shared<std::optional<SessionFolder>>();
  index_ = {};
  present_place_ = -1;
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
  documents_->Undo()->Forget(kUndoTopic);
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
        folder_ = folder;
        rig_.SetFolder(folder);
        const SessionIndex index = opened->Index();
        *holder_ = std::move(*opened);
        mount_ = index.mount;
        if (index.intrinsic_board) single_board_ = *index.intrinsic_board;
        present_place_ = static_cast<int>(index.poses.size()) - 1;
        TakeIndex(index);
      });
}

/// The first task of the writer makes the folder.
void ChainCalibrationModel::MakeSession() {
  if (!folder_.isEmpty()) return;
  const QString now = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd-HHmmss"));
  folder_ = QDir(Root()).filePath(QStringLiteral("head-") + now);
  for (int i = 2; QDir(folder_).exists(); ++i)
    folder_ = QDir(Root()).filePath(QStringLiteral("head-%1-%2").arg(now).arg(i));
  rig_.SetFolder(folder_);
  SessionSetup setup;
  setup.prior = head_->Rig();
  setup.name = setup.prior.name;
  setup.mount = mount_;
  setup.intrinsic_board = single_board_;
  writer_.Run<bool>(
      tr("Beginning the calibration"),
      [holder = holder_, setup, folder = folder_.toStdString()](const RunContext&) -> Result<bool> {
        FORESIGHT_TRY(SessionFolder made, SessionFolder::Create(folder, setup));
        *holder = std::move(made);
        return true;
      },
      [this](const Result<bool>& made) {
        if (!made) documents_->Report(NoticeOf(tr("Beginning the calibration"), made.error()));
      });
}

void ChainCalibrationModel::Write(const QString& title, Change change,
                                  std::function<void(SessionCapture)> done) {
  MakeSession();
  struct Written {
    SessionCapture capture;
    SessionIndex index;
  };
  writer_.Run<Written>(
      title,
      [holder = holder_, change = std::move(change)](const RunContext&) -> Result<Written> {
        if (!holder->has_value())
          return Fail(ErrorCode::kIo, "the session's folder could not be made");
        FORESIGHT_TRY(const SessionCapture capture, change(**holder));
        return Written{capture, (*holder)->Index()};
      },
      [this, title, done = std::move(done),
       session = session_version_](const Result<Written>& written) {
        if (session != session_version_) return;
        if (!written) {
          documents_->Report(NoticeOf(title, written.error()));
          Announce();
          return;
        }
        if (done) done(written->capture);
        TakeIndex(written->index);
      });
}

void ChainCalibrationModel::TakeIndex(const SessionIndex& index) {
  index_ = index;
  read_wanted_ = true;
  solve_wanted_ = solve_again_;
  Advance();
  Announce();
}

Status ChainCalibrationModel::SetBoards(const BoardMount& mount,
                                        const CalibrationBoard& single_board) {
  FORESIGHT_CHECK(mount.Check());
  FORESIGHT_CHECK(single_board.Check());
  if (mount == mount_ && single_board == single_board_) return {};
  mount_ = mount;
  single_board_ = single_board;
  DropSolution();
  if (folder_.isEmpty()) {
    Announce();
    return {};
  }
  // What was found is of other boards.
  found_cache_ = std::make_shared<FoundViews>();
  found_ = {};
  Write(tr("Keeping the boards"),
        [mount, single_board](SessionFolder& folder) -> Result<SessionCapture> {
          FORESIGHT_CHECK(folder.SetBoards(mount, single_board));
          return SessionCapture{};
        });
  Announce();
  return {};
}

void ChainCalibrationModel::SetPlan(const StandPlan& plan) {
  plan_ = plan;
  Announce();
}

QString ChainCalibrationModel::WhyNotCapture() const {
  if (const QString why = captures_.WhyNot(); !why.isEmpty()) return why;
  return plan_.StopAngles().empty() ? tr("The plan has no stops.") : QString();
}

QString ChainCalibrationModel::WhyNotSweep() const {
  if (present_place_ < 0) return tr("Capture the stops of a place first.");
  return captures_.WhyNot();
}

QString ChainCalibrationModel::WhyNotNewPlace() const {
  if (captures_.Running()) return captures_.WhyNot();
  if (present_place_ < 0 || present_place_ >= static_cast<int>(index_.poses.size()))
    return tr("Capture the stops; the first place begins by itself.");
  return index_.poses[static_cast<std::size_t>(present_place_)].stops.empty()
             ? tr("Nothing is captured at the present place yet.")
             : QString();
}

void ChainCalibrationModel::newPlace() {
  Write(
      tr("Beginning a place"), [](SessionFolder& folder) { return folder.AddPose(); },
      [this](const SessionCapture& place) { present_place_ = place.pose; });
}

void ChainCalibrationModel::captureBoardImage() {
  if (const Status started = captures_.StartImage(); !started) {
    documents_->Report(NoticeOf(tr("Capturing an image"), started.error()));
    return;
  }
  capturing_board_image_ = true;
}

void ChainCalibrationModel::captureStops() {
  if (const QString why = WhyNotCapture(); !why.isEmpty()) {
    documents_->Report({Notice::Level::kInfo, tr("The stops cannot be captured now."), why});
    return;
  }
  if (present_place_ < 0) newPlace();
  std::vector<double> angles;
  for (const double angle : plan_.StopAngles()) {
    bool there = false;
    if (present_place_ >= 0 && present_place_ < static_cast<int>(index_.poses.size()))
      for (const SessionStopFiles& stop :
           index_.poses[static_cast<std::size_t>(present_place_)].stops)
        there = there || (!stop.excluded && SameStop(stop.motor_rad, angle));
    if (!there) angles.push_back(angle);
  }
  if (angles.empty()) {
    documents_->Report({Notice::Level::kInfo, tr("All stops of this place are captured."),
                        tr("Move the stand and choose New place.")});
    return;
  }
  StartCapture(angles);
}

void ChainCalibrationModel::CaptureStopAgain(int place, int stop) {
  if (place < 0 || place >= static_cast<int>(places_.size()) || place != present_place_) {
    documents_->Report({Notice::Level::kInfo, tr("This stop cannot be captured again."),
                        tr("The stand has been moved since.")});
    return;
  }
  const auto& stops = places_[static_cast<std::size_t>(place)].stops;
  if (stop < 0 || stop >= static_cast<int>(stops.size())) return;
  StartCapture({stops[static_cast<std::size_t>(stop)].motor_rad});
}

void ChainCalibrationModel::StartCapture(const std::vector<double>& angles_rad) {
  StopPlan plan;
  plan.angles_rad = angles_rad;
  plan.lines = plan_.lines;
  plan.exposure_s = 1e-3 * head_->Plan().exposure_ms;
  capturing_board_image_ = false;
  if (const Status started = captures_.StartStops(plan); !started)
    documents_->Report(NoticeOf(tr("Capturing the stops"), started.error()));
}

void ChainCalibrationModel::captureSweep() {
  const std::vector<double> angles = plan_.StopAngles();
  if (angles.empty() || present_place_ < 0) return;
  ScanPlan plan;
  plan.from_rad = angles.front();
  plan.to_rad = angles.back();
  plan.speed_rad_s = RadiansFromDegrees(plan_.sweep_speed_deg_s);
  plan.image_angles_rad = {0.5 * (angles.front() + angles.back())};
  plan.passes = 2;  // one way an offset in time is a turn of the lidar
  if (const Status started = captures_.StartSweep(plan); !started)
    documents_->Report(NoticeOf(tr("Starting the sweep"), started.error()));
}

void ChainCalibrationModel::TakeCapture(const std::shared_ptr<const StopCapture>& capture) {
  if (capturing_board_image_) {
    if (!capture->image) return;
    Write(tr("Keeping the image"), [capture](SessionFolder& folder) {
      return folder.AddIntrinsicImage(capture->image->image, "the head's image");
    });
    return;
  }
  // The place's number is known when this is written: it may be on its way to the disk.
  Write(tr("Keeping the stop"),
        [capture, place = present_place_](SessionFolder& folder) -> Result<SessionCapture> {
          const int last = static_cast<int>(folder.Index().poses.size()) - 1;
          RecordedStop stop;
          stop.commanded_rad = capture->target_rad;
          stop.measured_rad = capture->position.angle_rad;
          if (capture->image) stop.image = capture->image->image;
          stop.lines = capture->lines;
          return folder.AddStop(place >= 0 ? place : last, stop);
        });
}

void ChainCalibrationModel::TakeStopsEnd(bool complete, const QString& reason) {
  capturing_board_image_ = false;
  if (!complete || !reason.isEmpty())
    documents_->Report({Notice::Level::kWarning, tr("The captures ended early: %1.").arg(reason),
                        tr("What was captured is kept. Capture goes on with what is missing.")});
  Advance();
  Announce();
}

void ChainCalibrationModel::TakeSweep(const std::shared_ptr<const Scan>& scan) {
  if (scan && scan->state == ScanState::kComplete) {
    Write(tr("Keeping the sweep"), [scan, place = present_place_](SessionFolder& folder) {
      MountSweep sweep;
      for (const LidarLine& line : scan->lines) sweep.lines.push_back(line);
      sweep.track = scan->track;
      return folder.AddSweep(place, sweep);
    });
    return;
  }
  documents_->Report(
      {Notice::Level::kWarning, tr("The sweep ended early and is not kept."), tr("Sweep again.")});
  Announce();
}

QString ChainCalibrationModel::NameOf(const SessionCapture& capture) const {
  using Kind = SessionCapture::Kind;
  if (capture.kind == Kind::kIntrinsicImage)
    return QString::fromStdString(
        index_.intrinsic_views[static_cast<std::size_t>(capture.number)].File());
  const SessionPoseFiles& pose = index_.poses[static_cast<std::size_t>(capture.pose)];
  const QString name = QString::fromStdString(pose.name);
  if (capture.kind == Kind::kPose) return name;
  if (capture.kind == Kind::kSweep) return tr("%1, sweep").arg(name);
  const double angle = pose.stops[static_cast<std::size_t>(capture.number)].motor_rad;
  return tr("%1, %2°").arg(name, DegreesText(angle));
}

void ChainCalibrationModel::SetExcluded(const SessionCapture& capture, bool excluded) {
  const QString text = excluded ? tr("Exclude %1") : tr("Include %1");
  documents_->Undo()->Push(
      text.arg(NameOf(capture)), kUndoTopic,
      [this, capture, excluded] { ShowExcluded(capture, !excluded); },
      [this, capture, excluded] { ShowExcluded(capture, excluded); });
  ShowExcluded(capture, excluded);
}

void ChainCalibrationModel::ShowExcluded(const SessionCapture& capture, bool excluded) {
  Write(tr("Keeping the calibration"),
        [capture, excluded](SessionFolder& folder) -> Result<SessionCapture> {
          FORESIGHT_CHECK(folder.SetExcluded(capture, excluded));
          return capture;
        });
}

bool ChainCalibrationModel::Busy() const {
  return opener_.Busy() || reader_.Busy() || solver_.Busy() || viewer_.Busy() || writer_.Busy() ||
         captures_.Running() || rig_.Busy();
}

/// Writes first, then reads, then solves.
void ChainCalibrationModel::Advance() {
  if (writer_.Busy() && !read_wanted_) return;
  if (read_wanted_) {
    if (!reader_.Busy()) StartRead();
    return;
  }
  if (!solve_wanted_ || reader_.Busy() || captures_.Running()) return;
  solve_wanted_ = false;
  StartSolve();
}

void ChainCalibrationModel::StartRead() {
  read_wanted_ = false;
  const auto work = [folder = folder_.toStdString(),
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
  if (folder_.isEmpty()) return tr("There is no session yet.");
  if (captures_.Running()) return tr("The head is capturing.");
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
  if (!session_) read_wanted_ = !folder_.isEmpty();
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
  if (captures_.Running())
    return capturing_board_image_ ? tr("Capturing an image.") : tr("The head is capturing.");
  if (opener_.Busy()) return tr("Opening the calibration.");
  if (Reading()) return tr("Looking for the boards.");
  if (Solving()) {
    const QString stage = SolveStage();
    return stage.isEmpty() ? tr("Calibrating.") : tr("Calibrating: %1.").arg(stage);
  }
  if (!failure_.isEmpty()) return failure_;
  if (solution_)
    return tr("Calibrated from %1 images and %2 lidar lines.")
        .arg(solution_->found.images.size())
        .arg(solution_->found.lines.size());
  const QString why = WhyNotSolve();
  return why.isEmpty() ? tr("Not calibrated yet.") : why;
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
                                      : index_.poses[static_cast<std::size_t>(place)]
                                            .stops[static_cast<std::size_t>(number)]
                                            .view.image;
  if (!file.empty()) {
    using Image = std::shared_ptr<const GrayImage>;
    viewer_.Run<Image>(
        tr("Reading an image"),
        [path = folder_.toStdString() + "/" + file](const RunContext&) -> Result<Image> {
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
  return ViewOf(found_.stops, index_.poses[static_cast<std::size_t>(selected_place_)]
                                  .stops[static_cast<std::size_t>(number)]
                                  .view.File());
}

std::vector<LidarImagePoint> ChainCalibrationModel::SelectedPoints() const {
  std::vector<LidarImagePoint> points;
  if (!solution_ || selected_place_ < 0) return points;
  // The solution counts places that are not excluded.
  int pose = -1;
  for (int place = 0; place <= selected_place_; ++place)
    pose += index_.poses[static_cast<std::size_t>(place)].excluded ? 0 : 1;
  if (index_.poses[static_cast<std::size_t>(selected_place_)].excluded) return points;
  const double angle = places_[static_cast<std::size_t>(selected_place_)]
                           .stops[static_cast<std::size_t>(selected_stop_)]
                           .motor_rad;
  const std::vector<double>& stops = solution_->found.state.motor_rad;
  for (const LidarImagePoint& point : solution_->points)
    if (point.pose == pose && SameStop(stops[static_cast<std::size_t>(point.stop)], angle))
      points.push_back(point);
  return points;
}

StopLamp ChainCalibrationModel::LampOf(const SessionStopFiles& stop, int number) const {
  using State = StopLamp::State;
  StopLamp lamp;
  lamp.motor_rad = stop.motor_rad;
  lamp.number = number;
  lamp.has_lines = !stop.lines.empty() && !stop.lines_excluded;
  if (stop.excluded || stop.view.excluded) {
    lamp.state = State::kExcluded;
    return lamp;
  }
  if (stop.view.empty()) {
    lamp.state = State::kNoImage;
    return lamp;
  }
  const MountView* view = ViewOf(found_.stops, stop.view.File());
  if (view == nullptr) {
    lamp.state = State::kLooking;
    return lamp;
  }
  const bool whole = view->a && (view->b || !index_.mount.b);
  lamp.state = view->empty() ? State::kNoBoard : whole ? State::kBothBoards : State::kOneBoard;
  if (solution_)
    if (const auto rms = solution_->rms_px.find(view->source); rms != solution_->rms_px.end())
      lamp.rms_px = rms->second;
  return lamp;
}

void ChainCalibrationModel::MakeRows() {
  places_.clear();
  std::vector<double> all_rms;
  for (std::size_t i = 0; i < index_.poses.size(); ++i) {
    const SessionPoseFiles& pose = index_.poses[i];
    StandPlaceRow row{.name = QString::fromStdString(pose.name), .excluded = pose.excluded};
    for (std::size_t k = 0; k < pose.stops.size(); ++k) {
      const bool replaced =
          pose.stops[k].excluded &&
          std::any_of(pose.stops.begin(), pose.stops.end(), [&](const SessionStopFiles& other) {
            return !other.excluded && SameStop(other.motor_rad, pose.stops[k].motor_rad);
          });
      if (!replaced) row.stops.push_back(LampOf(pose.stops[k], static_cast<int>(k)));
    }
    for (std::size_t k = 0; k < pose.sweeps.size(); ++k) {
      row.sweep_number = static_cast<int>(k);
      row.sweep =
          pose.sweeps[k].excluded ? StandPlaceRow::Sweep::kExcluded : StandPlaceRow::Sweep::kThere;
      if (!pose.sweeps[k].excluded) break;
    }
    // What is planned and not there yet, where captures go on.
    if (static_cast<int>(i) == present_place_ && !solution_)
      for (const double angle : plan_.StopAngles()) {
        const auto same = [&](const StopLamp& lamp) { return SameStop(lamp.motor_rad, angle); };
        if (std::none_of(row.stops.begin(), row.stops.end(), same))
          row.stops.push_back({.motor_rad = angle});
      }
    std::stable_sort(row.stops.begin(), row.stops.end(),
                     [](const auto& a, const auto& b) { return a.motor_rad < b.motor_rad; });
    for (const StopLamp& lamp : row.stops)
      if (std::isfinite(lamp.rms_px)) all_rms.push_back(lamp.rms_px);
    places_.push_back(std::move(row));
  }
  if (!all_rms.empty()) {
    const auto middle = all_rms.begin() + static_cast<std::ptrdiff_t>(all_rms.size() / 2);
    std::nth_element(all_rms.begin(), middle, all_rms.end());
    for (StandPlaceRow& row : places_)
      for (StopLamp& lamp : row.stops) lamp.stands_out = lamp.rms_px > kStandsOut * *middle;
  }
  board_images_.clear();
  for (const SessionViewFiles& view : index_.intrinsic_views) {
    using State = BoardImageRow::State;
    BoardImageRow row{.file = QString::fromStdString(view.File()),
                      .origin = QString::fromStdString(view.origin)};
    const MountView* found = ViewOf(found_.intrinsic, view.File());
    if (view.excluded)
      row.state = State::kExcluded;
    else if (found != nullptr)
      row.state = found->a ? State::kUsed : State::kNoBoard;
    if (solution_ && row.state == State::kUsed) {
      const auto rms = solution_->rms_px.find(found->source);
      if (rms != solution_->rms_px.end())
        row.rms_px = rms->second;
      else if (stage_ == CalibrationStage::kAll)
        row.state = State::kLeftOut;
    }
    board_images_.push_back(row);
  }
}

void ChainCalibrationModel::Announce() {
  MakeRows();
  std::vector<CalibrationBoard> boards = {mount_.a};
  if (mount_.b) boards.push_back(*mount_.b);
  live_.SetBoards(boards);
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
