#include "core/calibration/session_file.h"

#include <algorithm>
#include <atomic>

#include "core/base/atomic_file.h"
#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/calibration/mount_detector.h"
#include "core/calibration/session_index.h"
#include "core/calibration/session_tables.h"
#include "core/calibration/view_files.h"
#include "core/geometry/angles.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

Status MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  return {};
}

Status WriteText(const fs::path& folder, const std::string& name, const std::string& text) {
  FORESIGHT_CHECK(MakeFolder((folder / name).parent_path()));
  return WriteFileAtomically(folder / name, text);
}

class Writer {
 public:
  Writer(const CalibrationSession& session, const fs::path& folder, SessionViews views)
      : session_(session), folder_(folder), views_(views) {}

  Status Write() {
    FORESIGHT_CHECK(session_.Check());
    index_.name = session_.name;
    index_.mount = session_.mount;
    FORESIGHT_CHECK(WriteText(folder_, index_.rig, SensorRigToYaml(session_.prior)));
    FORESIGHT_CHECK(WriteViews());
    for (std::size_t pose = 0; pose < session_.poses.size(); ++pose)
      FORESIGHT_CHECK(WritePose(session_.poses[pose], fmt::format("pose_{:02}", pose + 1)));
    // Last: a folder without it is no session.
    return WriteSessionIndex(index_, folder_);
  }

 private:
  Status WriteViews() {
    if (session_.intrinsic_views.empty()) return {};
    index_.intrinsic_board = session_.intrinsic_board;
    if (views_ == SessionViews::kImages) FORESIGHT_CHECK(MakeFolder(folder_ / "intrinsic"));
    for (std::size_t i = 0; i < session_.intrinsic_views.size(); ++i) {
      SessionViewFiles view;
      if (views_ == SessionViews::kImages) {
        view.image = ImageNameOfView(i);
      } else {
        view.corners = fmt::format("intrinsic/{:03}.csv", i + 1);
        const MountView corners{"", session_.intrinsic_views[i].view, {}};
        FORESIGHT_CHECK(WriteText(folder_, view.corners, CornersText(corners)));
      }
      index_.intrinsic_views.push_back(view);
    }
    return {};
  }

  Status WritePose(const PatternPose& pose, const std::string& folder) {
    SessionPoseFiles files;
    files.name = pose.name;
    for (std::size_t i = 0; i < pose.stops.size(); ++i) {
      const MotorStop& stop = pose.stops[i];
      const std::string name = fmt::format("{}/stop_{:02}", folder, i + 1);
      SessionStopFiles& entry = files.stops.emplace_back();
      entry.motor_rad = stop.motor_rad;
      if (!stop.view.empty()) {
        entry.view.corners = name + "_corners.csv";
        FORESIGHT_CHECK(WriteText(folder_, entry.view.corners, CornersText(stop.view)));
      }
      if (!stop.lines.empty()) {
        entry.lines = name + "_lines.csv";
        FORESIGHT_CHECK(WriteText(folder_, entry.lines, LinesText(stop.lines)));
      }
    }
    if (!pose.sweep.lines.empty()) {
      files.sweeps.push_back(
          {.lines = folder + "/sweep_lines.csv", .motor = folder + "/sweep_motor.csv"});
      FORESIGHT_CHECK(WriteText(folder_, files.sweeps[0].lines, LinesText(pose.sweep.lines)));
      FORESIGHT_CHECK(WriteText(folder_, files.sweeps[0].motor, MotorText(pose.sweep.track)));
    }
    index_.poses.push_back(std::move(files));
    return {};
  }

  const CalibrationSession& session_;
  fs::path folder_;
  SessionViews views_;
  SessionIndex index_;
};

/// One image, or file of corners, and what is in it.
struct ViewJob {
  SessionViewFiles files;
  const BoardMount* mount = nullptr;
  SearchEffort effort = SearchEffort::kThorough;
  std::map<std::string, MountView>* found = nullptr;
  MountView view = {};
  bool done = false;
  Status status = {};
};

class Loader {
 public:
  Loader(const fs::path& folder, const RunContext& context, FoundViews* found)
      : folder_(folder), context_(context), found_(found) {}

  Result<CalibrationSession> Load() {
    FORESIGHT_TRY(index_, ReadSessionIndex(folder_));
    session_.name = index_.name;
    session_.mount = index_.mount;
    if (index_.intrinsic_board) session_.intrinsic_board = *index_.intrinsic_board;
    FORESIGHT_TRY(session_.prior, LoadSensorRig(folder_ / index_.rig));
    FORESIGHT_CHECK(LoadViews());
    for (const SessionPoseFiles& pose : index_.poses)
      if (!pose.excluded) FORESIGHT_CHECK(LoadPose(pose));
    if (const Status status = session_.Check(); !status)
      return Fail(ErrorCode::kBadData, "{}: {}", (folder_ / "session.yaml").string(),
                  status.error().message);
    return std::move(session_);
  }

 private:
  /// Images are looked at on all threads.
  Status LoadViews() {
    intrinsic_mount_.a = session_.intrinsic_board;
    for (const SessionViewFiles& view : index_.intrinsic_views)
      if (!view.excluded)
        jobs_.push_back({view, &intrinsic_mount_, SearchEffort::kThorough, &found_->intrinsic});
    const std::size_t views = jobs_.size();
    for (const SessionPoseFiles& pose : index_.poses)
      for (const SessionStopFiles& stop : pose.stops)
        // At many stops no board is in sight, and nobody wants to know what is there instead.
        if (!pose.excluded && HasView(stop))
          jobs_.push_back({stop.view, &session_.mount, SearchEffort::kQuick, &found_->stops});
    if (std::any_of(jobs_.begin() + static_cast<std::ptrdiff_t>(views), jobs_.end(),
                    [](const ViewJob& job) { return !job.files.image.empty(); }))
      if (const Status told = CheckInImages(session_.mount); !told)
        return Fail(ErrorCode::kBadData, "{}: {}", (folder_ / "session.yaml").string(),
                    told.error().message);
    FORESIGHT_CHECK(RunJobs());
    for (next_job_ = 0; next_job_ < views; ++next_job_) {
      const MountView& view = jobs_[next_job_].view;
      if (view.a) session_.intrinsic_views.push_back({view.source, *view.a});
    }
    for (const ViewJob& job : jobs_)
      if (!job.view.fault.empty())
        session_.unusable_images.push_back(
            job.view.empty() ? fmt::format("{}: {}", job.view.source, job.view.fault)
                             : fmt::format("board {} of {}: {}", job.view.a ? "B" : "A",
                                           job.view.source, job.view.fault));
    return {};
  }

  Status RunJobs() {
    std::vector<ViewJob*> open;
    for (ViewJob& job : jobs_) {
      const auto known = job.found->find(job.files.File());
      if (known == job.found->end())
        open.push_back(&job);
      else
        job.view = known->second;
    }
    std::atomic<int> done = 0;
    const int count = static_cast<int>(open.size());
    const bool finished = ParallelFor(count, context_, [&](int i) {
      ViewJob& job = *open[static_cast<std::size_t>(i)];
      auto view = ReadView(folder_, job.files, session_.prior.camera, *job.mount, job.effort);
      if (view)
        job.view = std::move(*view);
      else
        job.status = tl::unexpected(view.error());
      job.done = true;
      context_.Report(static_cast<double>(++done) / count, "looking for boards");
    });
    for (const ViewJob* job : open)
      if (job->done && job->status) (*job->found)[job->files.File()] = job->view;
    if (!finished) return Fail(ErrorCode::kCancelled, "reading the session: cancelled");
    for (const ViewJob* job : open) FORESIGHT_CHECK(job->status);
    return {};
  }

  static bool HasView(const SessionStopFiles& stop) {
    return !stop.excluded && !stop.view.excluded && !stop.view.empty();
  }

  /// In the order of the jobs.
  Status LoadPose(const SessionPoseFiles& files) {
    if (context_.Cancelled()) return Fail(ErrorCode::kCancelled, "reading the session: cancelled");
    PatternPose pose;
    pose.name = files.name;
    for (const SessionStopFiles& entry : files.stops) {
      if (entry.excluded) continue;
      MotorStop& stop = pose.stops.emplace_back();
      stop.motor_rad = entry.motor_rad;
      if (HasView(entry)) stop.view = std::move(jobs_[next_job_++].view);
      if (entry.lines.empty() || entry.lines_excluded) continue;
      FORESIGHT_TRY(stop.lines, ReadLines(folder_ / entry.lines, session_.prior.lidar));
    }
    for (const SessionSweepFiles& sweep : files.sweeps) {
      if (sweep.excluded) continue;
      FORESIGHT_TRY(pose.sweep.lines, ReadLines(folder_ / sweep.lines, session_.prior.lidar));
      FORESIGHT_TRY(pose.sweep.track, ReadTrack(folder_ / sweep.motor));
    }
    session_.poses.push_back(std::move(pose));
    return {};
  }

  fs::path folder_;
  const RunContext& context_;
  FoundViews* found_;
  SessionIndex index_;
  BoardMount intrinsic_mount_;  ///< one board
  std::vector<ViewJob> jobs_;
  std::size_t next_job_ = 0;
  CalibrationSession session_;
};

}  // namespace

Result<CalibrationSession> ReadCalibrationSession(const fs::path& folder, const RunContext& context,
                                                  FoundViews* found) {
  FoundViews none;
  return Loader(folder, context, found != nullptr ? found : &none).Load();
}

Status WriteCalibrationSession(const CalibrationSession& session, const fs::path& folder,
                               SessionViews views) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  if (!fs::is_empty(folder, error) || error)
    return Fail(ErrorCode::kIo, "{}: the folder is not empty; name a new one", folder.string());
  return Writer(session, folder, views).Write();
}

std::string SessionHash(const CalibrationSession& session) {
  Sha256 hash;
  hash.Add(RigId(session.prior) + "\nboards\n" + ToText(session.mount.a) + "\n");
  if (session.mount.b) {
    const Eigen::Quaterniond& q = session.mount.a_from_b.rotation();
    const Eigen::Vector3d& t = session.mount.a_from_b.translation();
    hash.Add(fmt::format("{} {} {} {} {} {} {} {}\n", ToText(*session.mount.b), q.w(), q.x(), q.y(),
                         q.z(), t.x(), t.y(), t.z()));
  }
  if (!session.intrinsic_views.empty()) hash.Add(ToText(session.intrinsic_board) + "\n");
  for (const IntrinsicView& view : session.intrinsic_views)
    hash.Add(CornersText({"", view.view, {}}));
  for (const PatternPose& pose : session.poses) {
    hash.Add("pose\n");
    for (const MotorStop& stop : pose.stops) {
      hash.Add(fmt::format("stop {:.9f}\n", DegreesFromRadians(stop.motor_rad)));
      hash.Add(CornersText(stop.view)).Add(LinesText(stop.lines));
    }
    hash.Add("sweep\n").Add(LinesText(pose.sweep.lines)).Add(MotorText(pose.sweep.track));
  }
  return hash.Hex();
}

std::string ImageNameOfView(std::size_t view) {
  return fmt::format("intrinsic/{:03}.png", view + 1);
}

}  // namespace foresight
