#include "app/common/record_calibration.h"

#include <mutex>
#include <utility>
#include <vector>

#include "app/common/output.h"
#include "app/common/wait_for_head.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Holds the head's captures until they are fetched.
class StopQueue final : public StopSink {
 public:
  void OnStop(const StopCapture& capture) override {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(capture);
  }
  void OnStopsEnded(ScanState state, const std::string& reason) override {
    const std::lock_guard lock(mutex_);
    complete_ = state == ScanState::kComplete;
    reason_ = reason;
    ended_ = true;
  }

  bool Ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
  }
  std::vector<StopCapture> TakeAll() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }
  bool Complete() const {
    const std::lock_guard lock(mutex_);
    return complete_;
  }
  std::string Reason() const {
    const std::lock_guard lock(mutex_);
    return reason_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<StopCapture> waiting_;
  bool ended_ = false;
  bool complete_ = false;
  std::string reason_ = "the captures did not end";
};

/// A sweep's lines and track, in memory until it has ended.
class SweepCollector final : public ScanSink {
 public:
  void OnScanStarted(const Scan& /*header*/) override {}
  void OnLine(const LidarLine& line) override {
    const std::lock_guard lock(mutex_);
    sweep_.lines.push_back(line);
  }
  void OnMotorSamples(std::span<const MotorSample> samples) override {
    const std::lock_guard lock(mutex_);
    for (const MotorSample& sample : samples) sweep_.track.Add(sample);
  }
  void OnFrame(const CameraFrame& /*frame*/) override {}
  void OnScanEnded(ScanState state, const std::string& reason) override {
    const std::lock_guard lock(mutex_);
    complete_ = state == ScanState::kComplete;
    reason_ = reason;
    ended_ = true;
  }

  bool Ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
  }
  /// Why there is none, in the error.
  Result<MountSweep> Take() {
    const std::lock_guard lock(mutex_);
    if (!complete_) return Fail(ErrorCode::kState, "{}", reason_);
    return std::move(sweep_);
  }

 private:
  mutable std::mutex mutex_;
  MountSweep sweep_;
  bool ended_ = false;
  bool complete_ = false;
  std::string reason_ = "the sweep did not end";
};

Status FaultOf(const HeadStatus& status) {
  if (status.state == HeadState::kReady) return {};
  return Fail(ErrorCode::kDevice, "{}", status.message);
}

class PoseRecorder {
 public:
  PoseRecorder(SensorHead& head, const PoseRecording& recording, SessionFolder& folder,
               const RunContext& context)
      : head_(head), recording_(recording), folder_(folder), context_(context) {}

  Result<RecordedPose> Record() {
    FORESIGHT_CHECK(CaptureStops());
    if (recording_.sweep && recorded_.missing.empty() && !context_.Cancelled())
      FORESIGHT_CHECK(Sweep());
    return recorded_;
  }

 private:
  Status CaptureStops() {
    const auto queue = std::make_shared<StopQueue>();
    FORESIGHT_CHECK(head_.StartStops(recording_.stops, queue));
    Status kept;
    const auto keep_all = [&] {
      for (const StopCapture& capture : queue->TakeAll()) {
        if (!kept) return;
        kept = Keep(capture);
        if (!kept) head_.EndScan(kept.error().message);
      }
    };
    const HeadStatus status =
        WaitWhile(head_, {HeadState::kSweeping, HeadState::kStopping}, context_, keep_all);
    WaitForEnd(
        head_, [&] { return queue->Ended(); }, context_, keep_all);
    keep_all();
    FORESIGHT_CHECK(kept);
    FORESIGHT_CHECK(FaultOf(status));
    recorded_.missing = queue->Reason();
    if (!queue->Complete() && recorded_.missing.empty()) recorded_.missing = "it was ended";
    return {};
  }

  Status Keep(const StopCapture& capture) {
    if (!pose_) {
      FORESIGHT_TRY(const SessionCapture pose, folder_.AddPose(recording_.name));
      pose_ = pose.pose;
    }
    RecordedStop stop{capture.target_rad, capture.position.angle_rad, {}, capture.lines};
    if (capture.image) stop.image = capture.image->image;
    FORESIGHT_CHECK(folder_.AddStop(*pose_, stop));
    ++recorded_.stops;
    if (capture.image) ++recorded_.images;
    const auto count = static_cast<int>(recording_.stops.angles_rad.size());
    PrintProgress(fmt::format("{}: stop {} of {} at {:.1f} deg", Name(), recorded_.stops, count,
                              DegreesFromRadians(capture.target_rad)),
                  recorded_.stops == count ? ProgressEnd::kLast : ProgressEnd::kMore);
    return {};
  }

  Status Sweep() {
    const auto collector = std::make_shared<SweepCollector>();
    FORESIGHT_CHECK(head_.StartScan(*recording_.sweep, collector));
    const HeadStatus status =
        WaitWhile(head_, {HeadState::kSweeping, HeadState::kStopping}, context_);
    WaitForEnd(
        head_, [&] { return collector->Ended(); }, context_);
    FORESIGHT_CHECK(FaultOf(status));
    const Result<MountSweep> sweep = collector->Take();
    if (!sweep) {
      recorded_.missing = "the sweep: " + sweep.error().message;
      return {};
    }
    FORESIGHT_CHECK(folder_.AddSweep(*pose_, *sweep));
    recorded_.sweep = true;
    PrintProgress(fmt::format("{}: swept, {} lines", Name(), sweep->lines.size()),
                  ProgressEnd::kLast);
    return {};
  }

  std::string Name() const { return folder_.Index().poses[static_cast<std::size_t>(*pose_)].name; }

  SensorHead& head_;
  const PoseRecording& recording_;
  SessionFolder& folder_;
  const RunContext& context_;
  std::optional<int> pose_;  ///< made with its first capture
  RecordedPose recorded_;
};

}  // namespace

Result<RecordedPose> RecordPose(SensorHead& head, const PoseRecording& recording,
                                SessionFolder& folder, const RunContext& context) {
  return PoseRecorder(head, recording, folder, context).Record();
}

Status RecordIntrinsicView(SensorHead& head, const StopPlan& stop, const std::string& origin,
                           SessionFolder& folder, const RunContext& context) {
  const auto queue = std::make_shared<StopQueue>();
  FORESIGHT_CHECK(head.StartStops(stop, queue));
  const HeadStatus status = WaitWhile(head, {HeadState::kSweeping, HeadState::kStopping}, context);
  WaitForEnd(
      head, [&] { return queue->Ended(); }, context);
  for (const StopCapture& capture : queue->TakeAll()) {
    if (!capture.image) continue;
    FORESIGHT_CHECK(folder.AddIntrinsicImage(capture.image->image, origin));
    return {};
  }
  FORESIGHT_CHECK(FaultOf(status));
  return Fail(ErrorCode::kDevice, "{}: {}", origin,
              queue->Reason().empty() ? "no image came" : queue->Reason());
}

}  // namespace foresight
