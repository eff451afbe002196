#include "core/mapping/map_odometry.h"

#include <cmath>

#include "core/calibration/number_table.h"

namespace foresight {

Result<MapOdometry> LoadMapOdometry(const std::filesystem::path& path) {
  MapOdometry poses;
  const NumberTable table{{"scan", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}, false, ""};
  const auto add = [&](int line, std::span<const double> row) -> Status {
    const Eigen::Quaterniond rotation(row[4], row[5], row[6], row[7]);
    if (std::abs(rotation.norm() - 1.0) > 1e-3)
      return Fail(ErrorCode::kBadData, "{}:{}: the quaternion has the length {}, not 1",
                  path.string(), line, rotation.norm());
    const auto id = static_cast<std::int64_t>(row[0]);
    if (!poses.try_emplace(id, rotation.normalized(), Eigen::Vector3d(row[1], row[2], row[3]))
             .second)
      return Fail(ErrorCode::kBadData, "{}:{}: scan {} stands there twice", path.string(), line,
                  id);
    return {};
  };
  FORESIGHT_CHECK(ReadNumberTable(path, table, add));
  return poses;
}

}  // namespace foresight
