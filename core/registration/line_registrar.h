#pragma once

#include <vector>

#include "core/registration/register_scan.h"

namespace foresight {

/// Places the lines of a scan one by one, each by itself: the part that RegisterScan and
/// GrowingRegistration share.
class LineRegistrar {
 public:
  /// The rig has passed its Check().
  explicit LineRegistrar(const SensorRig& rig);

  int beams() const { return static_cast<int>(directions_.size()); }
  /// Fails with kInvalidInput when the line has another number of beams than the rig's lidar.
  Status CheckLine(const LidarLine& line) const;

  /// Room for more lines behind those of a registered scan, all without a return.
  struct Rows {
    std::span<Eigen::Vector3f> points;
    std::span<float> range_m;
    std::span<float> intensity;
    std::span<Eigen::Vector3f> origins;
  };
  static Rows Append(RegisteredScan& scan, int lines);
  /// Writes the line into the row; returns its number of returns.
  int Place(const LidarLine& line, const MotorTrack& track, const Rows& rows,
            std::size_t row) const;

 private:
  SensorRig rig_;
  Rigid<frame::Head, frame::Lidar> head_from_lidar_;
  std::vector<Eigen::Vector3d> directions_;  ///< of the beams, in the lidar's frame
};

}  // namespace foresight
