#include "core/calibration/session_folder.h"

#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/contract.h"
#include "core/calibration/mount_detector.h"
#include "core/calibration/session_tables.h"
#include "core/geometry/angles.h"
#include "core/io/image_file.h"
#include "core/io/png.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;
using Kind = SessionCapture::Kind;

template <class T>
auto& At(T& list, int number) {
  FORESIGHT_EXPECTS(number >= 0 && number < static_cast<int>(list.size()),
                    "the capture is in the session");
  return list[static_cast<std::size_t>(number)];
}

template <class T>
int LastOf(const std::vector<T>& list) {
  return static_cast<int>(list.size()) - 1;
}

/// The first of `prefix`1, `prefix`2, ... that no file begins with but for one of `endings`: what a
/// program wrote before it was ended is not written over.
template <class NameOf>
std::string FreeName(const fs::path& folder, std::size_t from,
                     const std::vector<std::string>& endings, const NameOf& name_of) {
  for (std::size_t number = from;; ++number) {
    const std::string name = name_of(number);
    bool taken = false;
    for (const std::string& ending : endings) {
      std::error_code error;
      taken = taken || fs::exists(folder / (name + ending), error);
    }
    if (!taken) return name;
  }
}

std::string ExtensionOf(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return ".png";
  return bytes.starts_with("P5") ? ".pgm" : ".jpg";
}

std::string PoseFolder(int pose) {
  return fmt::format("pose_{:02}", pose + 1);
}

/// A rig file may be there: a program was ended before it could write session.yaml.
Status MakeEmptyFolder(const fs::path& folder, const std::string& rig) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (!at->path().filename().string().starts_with(rig))
      return Fail(ErrorCode::kIo, "{}: the folder is not empty; name a new one", folder.string());
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  return {};
}

/// Which flag says that a capture is excluded.
bool& Flag(SessionIndex& index, const SessionCapture& capture) {
  if (capture.kind == Kind::kIntrinsicImage)
    return At(index.intrinsic_views, capture.number).excluded;
  SessionPoseFiles& pose = At(index.poses, capture.pose);
  switch (capture.kind) {
    case Kind::kStop:
      return At(pose.stops, capture.number).excluded;
    case Kind::kStopImage:
      return At(pose.stops, capture.number).view.excluded;
    case Kind::kStopLines:
      return At(pose.stops, capture.number).lines_excluded;
    case Kind::kSweep:
      return At(pose.sweeps, capture.number).excluded;
    default:
      return pose.excluded;
  }
}

/// The capture, and those of which one takes the place of the other: the stops of one angle, the
/// sweeps of one place.
std::vector<SessionCapture> OneOf(const SessionCapture& capture, const SessionIndex& index) {
  if (capture.kind != Kind::kStop && capture.kind != Kind::kSweep) return {capture};
  std::vector<SessionCapture> same;
  const SessionPoseFiles& pose = At(index.poses, capture.pose);
  const bool stop = capture.kind == Kind::kStop;
  const double angle_rad = stop ? At(pose.stops, capture.number).motor_rad : 0.0;
  const int last = stop ? LastOf(pose.stops) : LastOf(pose.sweeps);
  for (int i = 0; i <= last; ++i)
    if (!stop || std::abs(At(pose.stops, i).motor_rad - angle_rad) < kSameStop_rad)
      same.push_back({capture.kind, capture.pose, i});
  return same;
}

/// Excludes what the capture, which is used now, takes the place of.
void ExcludeReplaced(const SessionCapture& capture, SessionIndex* index) {
  for (const SessionCapture& other : OneOf(capture, *index))
    if (other != capture) Flag(*index, other) = true;
}

}  // namespace

SessionFolder::SessionFolder(fs::path folder, SessionIndex index, SensorRig prior)
    : folder_(std::move(folder)), index_(std::move(index)), prior_(std::move(prior)) {}

Result<SessionFolder> SessionFolder::Create(const fs::path& folder, const SessionSetup& setup) {
  FORESIGHT_CHECK(setup.prior.Check());
  FORESIGHT_CHECK(CheckInImages(setup.mount));
  SessionIndex index;
  index.name = setup.name;
  index.mount = setup.mount;
  index.intrinsic_board = setup.intrinsic_board;
  FORESIGHT_CHECK(index.Check());
  FORESIGHT_CHECK(MakeEmptyFolder(folder, index.rig));
  FORESIGHT_CHECK(SaveSensorRig(setup.prior, folder / index.rig));
  FORESIGHT_CHECK(WriteSessionIndex(index, folder));
  return SessionFolder(folder, std::move(index), setup.prior);
}

Result<SessionFolder> SessionFolder::Open(const fs::path& folder) {
  FORESIGHT_TRY(SessionIndex index, ReadSessionIndex(folder));
  FORESIGHT_TRY(SensorRig prior, LoadSensorRig(folder / index.rig));
  return SessionFolder(folder, std::move(index), std::move(prior));
}

Status SessionFolder::SetBoards(const BoardMount& mount, const CalibrationBoard& intrinsic_board) {
  FORESIGHT_CHECK(CheckInImages(mount));
  SessionIndex index = index_;
  index.mount = mount;
  index.intrinsic_board = intrinsic_board;
  return Keep(std::move(index));
}

Result<SessionCapture> SessionFolder::AddIntrinsicImage(const ColorImage& image,
                                                        const std::string& origin) {
  FORESIGHT_CHECK(CheckImageSize(image.width(), image.height(), origin));
  FORESIGHT_TRY(const std::string bytes, EncodePng(image, PngContent::kCapture));
  return AddIntrinsicBytes(bytes, ".png", origin);
}

Result<SessionCapture> SessionFolder::AddIntrinsicFile(std::string_view bytes,
                                                       const std::string& origin) {
  FORESIGHT_TRY(const GrayImage image, DecodeImageGray(bytes, origin));
  FORESIGHT_CHECK(CheckImageSize(image.width(), image.height(), origin));
  return AddIntrinsicBytes(bytes, ExtensionOf(bytes), origin);
}

Result<SessionCapture> SessionFolder::AddIntrinsicBytes(std::string_view bytes,
                                                        const std::string& extension,
                                                        const std::string& origin) {
  FORESIGHT_CHECK(MakeFolder("intrinsic"));
  SessionIndex index = index_;
  const std::string name =
      FreeName(folder_, index.intrinsic_views.size() + 1, {".png", ".pgm", ".jpg"},
               [](std::size_t number) { return fmt::format("intrinsic/{:03}", number); });
  SessionViewFiles& view = index.intrinsic_views.emplace_back();
  view.image = name + extension;
  view.origin = origin;
  FORESIGHT_CHECK(WriteFileAtomically(folder_ / view.image, bytes));
  FORESIGHT_CHECK(Keep(std::move(index)));
  return SessionCapture{Kind::kIntrinsicImage, -1, LastOf(index_.intrinsic_views)};
}

Result<SessionCapture> SessionFolder::AddPose(const std::string& name) {
  SessionIndex index = index_;
  const std::size_t number = index.poses.size() + 1;
  index.poses.emplace_back().name = name.empty() ? fmt::format("pose {}", number) : name;
  FORESIGHT_CHECK(Keep(std::move(index)));
  return SessionCapture{Kind::kPose, LastOf(index_.poses), -1};
}

Result<SessionCapture> SessionFolder::AddStop(int pose, const RecordedStop& stop) {
  SessionIndex index = index_;
  SessionPoseFiles& files = At(index.poses, pose);
  const std::string what =
      fmt::format("{}, stop {:.2f} deg", files.name, DegreesFromRadians(stop.commanded_rad));
  if (!(std::abs(stop.commanded_rad) <= 2.0 * M_PI))
    return Fail(ErrorCode::kInvalidInput, "{}: it is no angle of the motor", what);
  FORESIGHT_CHECK(CheckLines(stop.lines, what));
  FORESIGHT_CHECK(MakeFolder(PoseFolder(pose)));
  const std::string name = FreeName(
      folder_, files.stops.size() + 1, {".png", "_lines.csv"},
      [&](std::size_t number) { return fmt::format("{}/stop_{:02}", PoseFolder(pose), number); });
  SessionStopFiles& entry = files.stops.emplace_back();
  entry.motor_rad = stop.commanded_rad;
  entry.measured_rad = stop.measured_rad;
  if (stop.image) {
    FORESIGHT_CHECK(CheckImageSize(stop.image->width(), stop.image->height(), what));
    entry.view.image = name + ".png";
    FORESIGHT_CHECK(WritePng(folder_ / entry.view.image, *stop.image, PngContent::kCapture));
  }
  if (!stop.lines.empty()) {
    entry.lines = name + "_lines.csv";
    FORESIGHT_CHECK(WriteFileAtomically(folder_ / entry.lines, LinesText(stop.lines)));
  }
  const SessionCapture capture{Kind::kStop, pose, LastOf(files.stops)};
  ExcludeReplaced(capture, &index);
  FORESIGHT_CHECK(Keep(std::move(index)));
  return capture;
}

Result<SessionCapture> SessionFolder::AddSweep(int pose, const MountSweep& sweep) {
  SessionIndex index = index_;
  SessionPoseFiles& files = At(index.poses, pose);
  if (sweep.lines.empty() || sweep.track.empty())
    return Fail(ErrorCode::kInvalidInput, "{}, sweep: it has {} lines and {} motor samples",
                files.name, sweep.lines.size(), sweep.track.samples().size());
  FORESIGHT_CHECK(CheckLines(sweep.lines, files.name + ", sweep"));
  FORESIGHT_CHECK(MakeFolder(PoseFolder(pose)));
  const std::string name = FreeName(
      folder_, files.sweeps.size() + 1, {"_lines.csv", "_motor.csv"}, [&](std::size_t number) {
        const std::string first = PoseFolder(pose) + "/sweep";
        return number == 1 ? first : fmt::format("{}_{}", first, number);
      });
  SessionSweepFiles& entry = files.sweeps.emplace_back();
  entry.lines = name + "_lines.csv";
  entry.motor = name + "_motor.csv";
  FORESIGHT_CHECK(WriteFileAtomically(folder_ / entry.lines, LinesText(sweep.lines)));
  FORESIGHT_CHECK(WriteFileAtomically(folder_ / entry.motor, MotorText(sweep.track)));
  const SessionCapture capture{Kind::kSweep, pose, LastOf(files.sweeps)};
  ExcludeReplaced(capture, &index);
  FORESIGHT_CHECK(Keep(std::move(index)));
  return capture;
}

Result<SessionFolder::LeftOut> SessionFolder::SetExcluded(const SessionCapture& capture,
                                                          bool excluded) {
  return Restore({{capture, excluded}});
}

Result<SessionFolder::LeftOut> SessionFolder::Restore(const LeftOut& before) {
  SessionIndex index = index_;
  LeftOut now;
  for (const auto& [capture, excluded] : before) {
    for (const SessionCapture& other : OneOf(capture, index)) {
      const auto known = std::any_of(now.begin(), now.end(),
                                     [&](const auto& entry) { return entry.first == other; });
      if (!known) now.emplace_back(other, Flag(index, other));
    }
    Flag(index, capture) = excluded;
    if (!excluded) ExcludeReplaced(capture, &index);
  }
  FORESIGHT_CHECK(Keep(std::move(index)));
  return now;
}

bool SessionFolder::Used(const SessionCapture& capture) const {
  SessionIndex index = index_;
  if (Flag(index, capture)) return false;
  if (capture.kind == Kind::kStopImage || capture.kind == Kind::kStopLines)
    return Used({Kind::kStop, capture.pose, capture.number});
  if (capture.kind == Kind::kStop || capture.kind == Kind::kSweep)
    return Used({Kind::kPose, capture.pose, -1});
  return true;
}

Status SessionFolder::CheckImageSize(int width, int height, const std::string& what) const {
  const CameraModel& camera = prior_.camera;
  if (width == camera.width && height == camera.height) return {};
  return Fail(ErrorCode::kInvalidInput, "{}: {} x {} pixels, the rig's camera has {} x {}", what,
              width, height, camera.width, camera.height);
}

Status SessionFolder::CheckLines(const std::vector<LidarLine>& lines,
                                 const std::string& what) const {
  for (const LidarLine& line : lines)
    if (line.range_mm.size() != static_cast<std::size_t>(prior_.lidar.beams))
      return Fail(ErrorCode::kInvalidInput, "{}: line {} has {} ranges, the rig's lidar {} beams",
                  what, line.seq, line.range_mm.size(), prior_.lidar.beams);
  return {};
}

Status SessionFolder::MakeFolder(const std::string& name) const {
  std::error_code error;
  // In the session's own folder: where that is gone, what was captured before is gone with it.
  fs::create_directory(folder_ / name, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", (folder_ / name).string(), error.message());
  return {};
}

Status SessionFolder::Keep(SessionIndex index) {
  FORESIGHT_CHECK(WriteSessionIndex(index, folder_));
  index_ = std::move(index);
  return {};
}

}  // namespace foresight
