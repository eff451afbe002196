#include "core/io/read_point_cloud.h"

#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"

namespace foresight {
namespace {

Status CheckPoints(const std::vector<Eigen::Vector3d>& points, const std::string& source) {
  constexpr double kFarthest_m = 100'000.0;
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    any = true;
    if (points[i].cwiseAbs().maxCoeff() > kFarthest_m)
      return Fail(ErrorCode::kBadData,
                  "{}: point {} at ({}, {}, {}) is beyond 100 km; coordinates are metres", source,
                  i, points[i].x(), points[i].y(), points[i].z());
  }
  if (!any)
    return Fail(ErrorCode::kBadData, "{}: none of its {} points is a number", source,
                points.size());
  return {};
}

bool LooksLikePcd(std::string_view bytes) {
  return bytes.starts_with("# .PCD") || bytes.starts_with("VERSION") || bytes.starts_with("FIELDS");
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> ReadPointCloud(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  const std::string source = path.string();
  if (!bytes.starts_with("ply") && !LooksLikePcd(bytes))
    return Fail(ErrorCode::kBadData, "{}: is neither a PLY nor a PCD file", source);
  FORESIGHT_TRY(std::vector<Eigen::Vector3d> points,
                bytes.starts_with("ply") ? DecodePly(bytes, source) : DecodePcd(bytes, source));
  FORESIGHT_CHECK(CheckPoints(points, source));
  return points;
}

}  // namespace foresight
