#include "core/io/read_point_cloud.h"

#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/io/cloud_columns.h"

namespace foresight {
namespace {

Result<std::vector<Eigen::Vector3d>> DecodeWithHeader(std::string_view bytes,
                                                      const std::string& source) {
  if (bytes.starts_with("ply")) return DecodePly(bytes, source);
  if (LooksLikePcd(bytes)) return DecodePcd(bytes, source);
  return Fail(ErrorCode::kBadData, "{}: is neither a PLY nor a PCD file", source);
}

}  // namespace

bool LooksLikePcd(std::string_view bytes) {
  return bytes.starts_with("# .PCD") || bytes.starts_with("VERSION") || bytes.starts_with("FIELDS");
}

Status CheckCloudPoints(std::span<const Eigen::Vector3d> points, const std::string& source) {
  constexpr double kFarthest_m = 100'000.0;
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    any = true;
    if (points[i].cwiseAbs().maxCoeff() > kFarthest_m)
      return Fail(
          ErrorCode::kBadData,
          "{}: point {} at ({}, {}, {}) is beyond 100 km; are its coordinates in another unit?",
          source, i, points[i].x(), points[i].y(), points[i].z());
  }
  if (!any)
    return Fail(ErrorCode::kBadData, "{}: none of its {} points is a number", source,
                points.size());
  return {};
}

Result<std::vector<Eigen::Vector3d>> DecodeFloatRecords(std::string_view bytes,
                                                        const std::string& source) {
  constexpr std::size_t kFloat = 4, kRecord = 4 * kFloat;
  if (bytes.empty() || bytes.size() % kRecord != 0)
    return Fail(ErrorCode::kBadData,
                "{}: {} bytes are no points of four floats each: it is truncated or something else",
                source, bytes.size());
  if (bytes.size() / kRecord > kMostCloudPoints)
    return Fail(ErrorCode::kBadData, "{}: {} points are more than {}", source,
                bytes.size() / kRecord, kMostCloudPoints);
  std::array<CloudColumn, 3> columns;
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns[axis] = {CloudScalar::kFloat32, axis * kFloat, kRecord};
  return PointsFromColumns(bytes, columns, bytes.size() / kRecord, false);
}

Result<std::vector<Eigen::Vector3d>> ReadPointCloud(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  const std::string source = path.string();
  FORESIGHT_TRY(std::vector<Eigen::Vector3d> points, path.extension() == ".bin"
                                                         ? DecodeFloatRecords(bytes, source)
                                                         : DecodeWithHeader(bytes, source));
  FORESIGHT_CHECK(CheckCloudPoints(points, source));
  return points;
}

}  // namespace foresight
