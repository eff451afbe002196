#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/geometry/rigid.h"
#include "core/mapping/map_frame.h"
#include "core/registration/register_scan.h"

namespace foresight {

/// A scan where a map has it. Nothing is owned.
struct PlacedScan {
  const RegisteredScan& cloud;
  Rigid<frame::Map, frame::Base> map_from_base;
};

struct ScanChangeOptions {
  /// A point is compared with the other scan's within this distance: more than noise, alignment and
  /// the spacing of beams make together.
  double distance_m = 0.06;
  /// How far behind the point a beam of the other scan must have ended to have gone through it.
  double behind_m = 0.10;
  /// How near a beam must have passed: half its footprint at the point, at least this.
  double beside_m = 0.010;
  int min_beams_through = 3;  ///< that say a place was empty
  double gap_m = 0.06;        ///< between neighbours of one change
  int min_points = 40;        ///< of a change; edges that were hit otherwise make up to 21

  Status Check() const;  ///< Fails with kInvalidOptions.
};

/// Something that stands in one of two scans of a place, and not in the other, whose beams went
/// through where it is.
struct ScanChange {
  enum class Kind { kAppeared, kGone };
  Kind kind = Kind::kAppeared;
  std::vector<Eigen::Vector3f> points;               ///< in map, metres
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of its box, in map
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< of its box, along the map's axes
};
/// "appeared", "gone".
const char* ToString(ScanChange::Kind kind);

struct ScanChanges {
  std::vector<ScanChange> changes;  ///< the largest first
  /// Points of the later scan that are not in the earlier one and where no beam of it went: places
  /// that it could not see. No change.
  std::size_t not_seen_before = 0;
};

/// What changed from `before` to `after`: an octree's new cells (PCL), then the distance to the
/// other scan, then the beams that went through. Fails with kTooFewPoints where a scan has no
/// return, kInvalidOptions and kCancelled. O(points log points).
Result<ScanChanges> FindChanges(const PlacedScan& before, const PlacedScan& after,
                                const ScanChangeOptions& options, const RunContext& context);

}  // namespace foresight
