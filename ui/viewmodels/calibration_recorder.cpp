#include "ui/viewmodels/calibration_recorder.h"

#include <QDateTime>
#include <QDir>
#include <algorithm>
#include <chrono>
#include <utility>

#include "core/calibration/mount_detector.h"
#include "core/geometry/angles.h"
#include "ui/viewmodels/sentence.h"
#include "ui/viewmodels/stand_rows.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kStandLook{50};

/// A folder of `root` that is not there yet.
QString NewFolder(const QString& root) {
  const QString now = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd-HHmmss"));
  QString folder = QDir(root).filePath(QStringLiteral("head-") + now);
  for (int i = 2; QDir(folder).exists(); ++i)
    folder = QDir(root).filePath(QStringLiteral("head-%1-%2").arg(now).arg(i));
  return folder;
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

CalibrationRecorder::CalibrationRecorder(HeadViewModel* head, SessionModel* documents,
                                         const QString& root, std::shared_ptr<MovingStand> stand,
                                         QObject* parent)
    : QObject(parent),
      head_(head),
      documents_(documents),
      root_(root),
      stand_(std::move(stand)),
      mount_(stand_ ? stand_->Mount() : UsualBoardMount()),
      single_board_(stand_ ? stand_->SingleBoard() : mount_.a),
      captures_(head) {
  connect(&writer_, &TaskRunner::changed, this, &CalibrationRecorder::changed);
  connect(&captures_, &HeadCaptures::changed, this, &CalibrationRecorder::changed);
  connect(&captures_, &HeadCaptures::captured, this, &CalibrationRecorder::TakeCapture);
  connect(&captures_, &HeadCaptures::stopsEnded, this, &CalibrationRecorder::TakeStopsEnd);
  connect(&captures_, &HeadCaptures::sweepEnded, this, &CalibrationRecorder::TakeSweep);
  stand_look_.setInterval(kStandLook);
  connect(&stand_look_, &QTimer::timeout, this, &CalibrationRecorder::LookAtStand);
}

void CalibrationRecorder::Forget() {
  captures_.Drop();
  capturing_board_image_ = false;
  ++version_;
  folder_.clear();
  holder_ = std::make_shared<std::optional<SessionFolder>>();
  index_ = {};
  present_place_ = place_in_question_ = -1;
  begun_place_.reset();
}

void CalibrationRecorder::Take(const QString& folder, SessionFolder session) {
  Forget();
  folder_ = folder;
  index_ = session.Index();
  *holder_ = std::move(session);
  mount_ = index_.mount;
  if (index_.intrinsic_board) single_board_ = *index_.intrinsic_board;
  if (stand_)
    present_place_ = PlaceOfStand();
  else
    place_in_question_ = static_cast<int>(index_.poses.size()) - 1;
  Q_EMIT changed();
}

std::string CalibrationRecorder::NameOfStandsPlace() const {
  return stand_ && stand_->At() >= 0 ? stand_->Places()[static_cast<std::size_t>(stand_->At())].name
                                     : std::string();
}

/// The last place of the session, if the stand is there.
int CalibrationRecorder::PlaceOfStand() const {
  const bool there = !index_.poses.empty() && !NameOfStandsPlace().empty() &&
                     index_.poses.back().name == NameOfStandsPlace();
  return there ? static_cast<int>(index_.poses.size()) - 1 : -1;
}

/// The first task of the writer makes the folder.
void CalibrationRecorder::MakeSession() {
  if (!folder_.isEmpty()) return;
  folder_ = NewFolder(root_);
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
      [this, version = version_](const Result<bool>& made) {
        if (made) return;
        documents_->Report(NoticeOf(tr("Beginning the calibration"), made.error()));
        if (version == version_) folder_.clear();  // the next capture begins another one
      });
}

void CalibrationRecorder::Write(const QString& title, Change change,
                                std::function<void(SessionCapture)> done,
                                std::function<void()> failed) {
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
      [this, title, done = std::move(done), failed = std::move(failed),
       version = version_](const Result<Written>& written) {
        if (!written) documents_->Report(NoticeOf(title, written.error()));
        if (version != version_) return;
        if (!written) {
          if (failed) failed();
          Q_EMIT writeFailed();
          Q_EMIT changed();
          return;
        }
        if (done) done(written->capture);
        index_ = written->index;
        Q_EMIT kept();
      });
}

void CalibrationRecorder::SetBoards(const BoardMount& mount, const CalibrationBoard& single_board) {
  mount_ = mount;
  single_board_ = single_board;
  if (folder_.isEmpty()) return;
  Write(tr("Keeping the boards"),
        [mount, single_board](SessionFolder& folder) -> Result<SessionCapture> {
          FORESIGHT_CHECK(folder.SetBoards(mount, single_board));
          return SessionCapture{};
        });
}

void CalibrationRecorder::SetPlan(const StandPlan& plan) {
  plan_ = plan;
  Q_EMIT changed();
}

QString CalibrationRecorder::WhyNotMoveStand() const {
  if (!stand_) return tr("The stand is moved by hand.");
  if (stand_->Moving()) return tr("The stand is on its way.");
  if (captures_.Running()) return tr("The head is capturing.");
  // Captures that are on their way belong to where the stand was.
  return writer_.Busy() ? tr("A capture is being kept.") : QString();
}

void CalibrationRecorder::MoveStand(int place) {
  if (const QString why = WhyNotMoveStand(); !why.isEmpty()) {
    documents_->Report({Notice::Level::kInfo, tr("The stand cannot be moved now."), why});
    return;
  }
  if (place == stand_->At()) return;
  stand_->MoveTo(place);
  present_place_ = -1;
  begun_place_.reset();
  if (stand_->Moving())
    stand_look_.start();
  else
    return LookAtStand();
  Q_EMIT changed();
}

/// A stand at the far end of a link takes its time, and may not go at all.
void CalibrationRecorder::LookAtStand() {
  if (stand_->Moving()) return;
  stand_look_.stop();
  if (const std::string trouble = stand_->Trouble(); !trouble.empty()) {
    present_place_ = PlaceOfStand();
    documents_->Report(
        {Notice::Level::kWarning, tr("The stand was not moved."), Sentence(trouble)});
  }
  Q_EMIT changed();
}

QString CalibrationRecorder::WhyNotBoardImage() const {
  if (StandMoves()) return tr("The stand is on its way.");
  if (const QString why = captures_.WhyNot(); !why.isEmpty()) return why;
  const Status told = CheckInImages(mount_);
  return told ? QString() : Sentence(told.error().message);
}

QString CalibrationRecorder::WhyNotCapture() const {
  if (const QString why = WhyNotBoardImage(); !why.isEmpty()) return why;
  if (stand_ && stand_->At() >= 0 &&
      !stand_->Places()[static_cast<std::size_t>(stand_->At())].mount)
    return tr(
        "The stand shows the board for the camera alone: take an image for the camera, or "
        "move the stand on.");
  if (place_in_question_ >= 0)
    return tr("Is the stand still at '%1'? Choose Same place or New place.")
        .arg(NameOf({SessionCapture::Kind::kPose, place_in_question_, -1}));
  return plan_.StopAngles().empty() ? tr("The plan has no stops.") : QString();
}

const SessionPoseFiles* CalibrationRecorder::PresentPose() const {
  return present_place_ >= 0 && present_place_ < static_cast<int>(index_.poses.size())
             ? &index_.poses[static_cast<std::size_t>(present_place_)]
             : nullptr;
}

std::vector<double> CalibrationRecorder::MissingStops() const {
  std::vector<double> angles = plan_.StopAngles();
  if (const SessionPoseFiles* pose = PresentPose())
    for (const SessionStopFiles& stop : pose->stops)
      if (!stop.excluded)
        std::erase_if(angles, [&](double angle) { return SameStop(stop.motor_rad, angle); });
  return angles;
}

bool CalibrationRecorder::HasSweep() const {
  const SessionPoseFiles* pose = PresentPose();
  return pose != nullptr && std::any_of(pose->sweeps.begin(), pose->sweeps.end(),
                                        [](const auto& sweep) { return !sweep.excluded; });
}

bool CalibrationRecorder::HasBoardImage() const {
  const std::string name = NameOfStandsPlace();
  return std::any_of(
      index_.intrinsic_views.begin(), index_.intrinsic_views.end(),
      [&](const SessionViewFiles& view) { return !view.excluded && view.origin == name; });
}

QString CalibrationRecorder::WhyNotSweep() const {
  if (const QString why = WhyNotCapture(); !why.isEmpty()) return why;
  return present_place_ < 0 ? tr("Capture the stops of a place first.") : QString();
}

QString CalibrationRecorder::WhyNotNewPlace() const {
  if (captures_.Running()) return captures_.WhyNot();
  if (place_in_question_ >= 0) return {};
  const SessionPoseFiles* pose = PresentPose();
  if (pose == nullptr) return tr("Capture the stops; a place begins by itself.");
  return pose->stops.empty() ? tr("Nothing is captured at the present place yet.") : QString();
}

void CalibrationRecorder::newPlace() {
  if (WhyNotNewPlace().isEmpty()) BeginPlace();
}

void CalibrationRecorder::samePlace() {
  if (place_in_question_ < 0) return;
  present_place_ = std::exchange(place_in_question_, -1);
  Q_EMIT changed();
}

void CalibrationRecorder::BeginPlace() {
  present_place_ = place_in_question_ = -1;
  begun_place_ = std::make_shared<std::optional<int>>();
  Write(
      tr("Beginning a place"),
      [name = NameOfStandsPlace(),
       begun = begun_place_](SessionFolder& folder) -> Result<SessionCapture> {
        FORESIGHT_TRY(const SessionCapture place, folder.AddPose(name));
        *begun = place.pose;
        return place;
      },
      [this, begun = begun_place_](const SessionCapture& place) {
        if (begun == begun_place_) present_place_ = place.pose;
      },
      [this, begun = begun_place_] {
        if (begun == begun_place_) begun_place_.reset();
      });
}

void CalibrationRecorder::captureBoardImage() {
  CaptureBoardImageAt(head_->LastStatus().angle_rad);
}

void CalibrationRecorder::CaptureBoardImageAt(double motor_rad) {
  if (const QString why = WhyNotBoardImage(); !why.isEmpty()) {
    documents_->Report({Notice::Level::kInfo, tr("No image can be captured now."), why});
    return;
  }
  StopPlan plan;
  plan.angles_rad = {motor_rad};
  plan.lines = 0;
  plan.exposure_s = 1e-3 * plan_.exposure_ms;
  if (const Status started = captures_.StartStops(plan); !started) {
    documents_->Report(NoticeOf(tr("Capturing an image"), started.error()));
    return;
  }
  capturing_board_image_ = true;
}

void CalibrationRecorder::captureStops() {
  if (const QString why = WhyNotCapture(); !why.isEmpty()) {
    documents_->Report({Notice::Level::kInfo, tr("The stops cannot be captured now."), why});
    return;
  }
  const std::vector<double> angles = MissingStops();
  if (angles.empty()) {
    documents_->Report({Notice::Level::kInfo, tr("All stops of this place are captured."),
                        tr("Move the stand and choose New place.")});
    return;
  }
  if (StartCapture(angles) && present_place_ < 0 && !begun_place_) BeginPlace();
}

void CalibrationRecorder::CaptureStopAgain(double motor_rad) {
  StartCapture({motor_rad});
}

bool CalibrationRecorder::StartCapture(const std::vector<double>& angles_rad) {
  StopPlan plan;
  plan.angles_rad = angles_rad;
  plan.lines = plan_.lines;
  plan.exposure_s = 1e-3 * plan_.exposure_ms;
  capturing_board_image_ = false;
  const Status started = captures_.StartStops(plan);
  if (!started) documents_->Report(NoticeOf(tr("Capturing the stops"), started.error()));
  return started.has_value();
}

void CalibrationRecorder::captureSweep() {
  if (const QString why = WhyNotSweep(); !why.isEmpty()) {
    documents_->Report({Notice::Level::kInfo, tr("The head cannot sweep now."), why});
    return;
  }
  const std::vector<double> angles = plan_.StopAngles();
  ScanPlan plan;
  plan.from_rad = angles.front();
  plan.to_rad = angles.back();
  plan.speed_rad_s = RadiansFromDegrees(plan_.sweep_speed_deg_s);
  plan.image_angles_rad = {0.5 * (angles.front() + angles.back())};
  plan.exposure_s = 1e-3 * plan_.exposure_ms;
  plan.passes = 2;  // one way an offset in time is a turn of the lidar
  if (const Status started = captures_.StartSweep(plan); !started)
    documents_->Report(NoticeOf(tr("Starting the sweep"), started.error()));
}

void CalibrationRecorder::TakeCapture(const std::shared_ptr<const StopCapture>& capture) {
  if (capturing_board_image_) {
    if (!capture->image) return;
    const std::string place = NameOfStandsPlace();
    Write(tr("Keeping the image"),
          [capture, origin = place.empty() ? "the head's image" : place](SessionFolder& folder) {
            return folder.AddIntrinsicImage(capture->image->image, origin);
          });
    return;
  }
  // The place's number is known when this is written: it may be on its way to the disk.
  Write(tr("Keeping the stop"),
        [capture, place = present_place_,
         begun = begun_place_](SessionFolder& folder) -> Result<SessionCapture> {
          if (place < 0 && !(begun && *begun))
            return Fail(ErrorCode::kIo, "the place of the stop could not be kept; capture again");
          RecordedStop stop;
          stop.commanded_rad = capture->target_rad;
          stop.measured_rad = capture->position.angle_rad;
          if (capture->image) stop.image = capture->image->image;
          stop.lines = capture->lines;
          return folder.AddStop(place >= 0 ? place : **begun, stop);
        });
}

void CalibrationRecorder::TakeStopsEnd(bool complete, const QString& reason) {
  capturing_board_image_ = false;
  if (!complete || !reason.isEmpty())
    documents_->Report({Notice::Level::kWarning, tr("The captures ended early: %1.").arg(reason),
                        tr("What was captured is kept. Capture goes on with what is missing.")});
  Q_EMIT captureEnded(complete && reason.isEmpty());
  Q_EMIT changed();
}

void CalibrationRecorder::TakeSweep(const std::shared_ptr<const Scan>& scan) {
  const bool complete = scan && scan->state == ScanState::kComplete;
  if (complete)
    Write(tr("Keeping the sweep"), [scan, place = present_place_](SessionFolder& folder) {
      MountSweep sweep;
      for (const LidarLine& line : scan->lines) sweep.lines.push_back(line);
      sweep.track = scan->track;
      return folder.AddSweep(place, sweep);
    });
  else
    documents_->Report({Notice::Level::kWarning, tr("The sweep ended early and is not kept."),
                        tr("Sweep again.")});
  Q_EMIT captureEnded(complete);
  Q_EMIT changed();
}

CalibrationRecorder::LeftOut CalibrationRecorder::SetExcluded(const SessionCapture& capture,
                                                              bool excluded) {
  const auto before = std::make_shared<SessionFolder::LeftOut>();
  Write(tr("Keeping the calibration"),
        [capture, excluded, before](SessionFolder& folder) -> Result<SessionCapture> {
          FORESIGHT_TRY(*before, folder.SetExcluded(capture, excluded));
          return capture;
        });
  return before;
}

void CalibrationRecorder::Swap(const LeftOut& before) {
  Write(tr("Keeping the calibration"), [before](SessionFolder& folder) -> Result<SessionCapture> {
    FORESIGHT_TRY(*before, folder.Restore(*before));
    return SessionCapture{};
  });
}

QString CalibrationRecorder::NameOf(const SessionCapture& capture) const {
  using Kind = SessionCapture::Kind;
  if (capture.kind == Kind::kIntrinsicImage)
    return QString::fromStdString(
        index_.intrinsic_views[static_cast<std::size_t>(capture.number)].File());
  const SessionPoseFiles& pose = index_.poses[static_cast<std::size_t>(capture.pose)];
  const QString name = QString::fromStdString(pose.name);
  if (capture.kind == Kind::kPose) return name;
  if (capture.kind == Kind::kSweep) return tr("%1, sweep").arg(name);
  const double angle = pose.stops[static_cast<std::size_t>(capture.number)].motor_rad;
  return tr("%1, %2°").arg(name, QString::number(DegreesFromRadians(angle), 'g', 4));
}

}  // namespace foresight
