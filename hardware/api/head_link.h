#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/run_context.h"
#include "core/sensor/scan.h"
#include "hardware/api/head_fit.h"
#include "hardware/api/head_image.h"
#include "hardware/api/link_health.h"
#include "hardware/api/robot_answer.h"

namespace foresight {

class MovingStand;
struct RegisteredScan;

/// A scan of the head at the far end of a link, and how much of it is on this computer.
struct LinkedScan {
  enum class Place {
    kAtHead,   ///< there alone, and not asked for
    kWaiting,  ///< it comes when those before it are here
    kComing,
    kPaused,  ///< by the operator
    kHere,    ///< all of it
  };
  std::string scan_id;
  std::int64_t begin_utc_ns = 0;  ///< by the head's clock; 0 = the head has not said yet
  Place place = Place::kAtHead;
  int lines = 0;                ///< that are here
  int of_lines = 0;             ///< at the head, or planned while it sweeps
  int images = 0;               ///< lossless ones that are here
  int of_images = 0;            ///< at the head
  std::int64_t left_bytes = 0;  ///< to come; before the first byte, all that the head says
  std::string trouble;  ///< e.g. a full disk, or what the head said of it; empty when all is well

  bool operator==(const LinkedScan&) const = default;
};
/// "at the head", "waiting", "coming", "paused", "here".
const char* ToString(LinkedScan::Place place);

/// What has come of a scan before all of it is here.
struct EarlyScan {
  /// Lines in order with gaps (jumps of seq), some without intensities; images that are smaller or
  /// have lost detail where the lossless ones have not come. kRunning until its end is here.
  std::shared_ptr<const Scan> scan;
  /// In base: thinned lines that came ahead of the lines themselves; nullptr where the scan's own
  /// lines are more.
  std::shared_ptr<const RegisteredScan> cloud;
  std::vector<std::int64_t> cloud_seqs;  ///< LidarLine::seq of the cloud's lines
  int lines = 0;                         ///< of the scan, or of the cloud
  int of_lines = 0;                      ///< planned, or as the head measured; 0 = not known
};

/// What a head at the far end of a link has beside what every head has. Safe from any thread.
/// Calls that ask the head wait for its answer, so a window makes them from a task.
class HeadLink {
 public:
  virtual ~HeadLink() = default;

  virtual LinkHealth Health() const = 0;

  /// In the order in which they come, then those that are not asked for, the newest first.
  virtual std::vector<LinkedScan> Scans() const = 0;
  /// The newest scan while not all of it could be told to its sink; nullptr = nothing more is here.
  virtual std::shared_ptr<const EarlyScan> Early() const = 0;
  /// Asks for a scan that is at the head alone, or goes on with a paused one, behind those that
  /// wait.
  virtual void Fetch(const std::string& scan_id) = 0;
  /// The same, before all others.
  virtual void FetchFirst(const std::string& scan_id) = 0;
  /// Lines of the newest scan that come before its others, first and last seq; nullopt = none.
  virtual void LinesFirst(std::optional<std::pair<std::int64_t, std::int64_t>> seqs) = 0;
  /// What has come stays here; the scan stays at the head.
  virtual void Pause(const std::string& scan_id) = 0;

  /// Whether our certificate may operate the head at all.
  virtual bool MayOperate() const = 0;
  /// That of a simulated head; nullptr where the stand is carried.
  virtual std::shared_ptr<MovingStand> Stand() const { return nullptr; }
  /// Fails with kDevice where the head does not answer, kState where somebody else has control.
  virtual Status TakeControl() = 0;
  /// Lets `successor` alone have control next; empty = whoever takes it.
  virtual Status GiveControl(const std::string& successor) = 0;

  /// A pose to the robot: a line as PoseMessageToJson makes it. The same line may be sent again,
  /// the robot hears it once. Fails with kDevice where the head did not answer: the robot may have
  /// it.
  virtual Result<RobotAnswer> SendPose(const std::string& pose_json) = 0;

  /// A fit by the head's own program in a scan that it has: region and pose alone cross the link.
  /// Fails as the fit did, with kCancelled, kDevice where the head does not answer, kState where it
  /// fits for somebody else.
  virtual Result<HeadFit> Fit(const HeadFitOrder& order, const RunContext& context) = 0;
  /// Fails with kDevice where the head does not answer, kState where it has no such image.
  virtual Result<HeadImage> FetchImage(const HeadImageOrder& order) = 0;
};

}  // namespace foresight
