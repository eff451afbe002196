#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// The positions in a point cloud file: PLY (ascii, binary of either byte order) or PCD (ascii,
/// binary, binary_compressed), as the file's first bytes say, or records of four floats where its
/// name ends in .bin. Metres, in the file's frame and order; other fields are skipped. NaN and
/// infinity are kept: a cloud on a grid marks its holes so. Fails with kIo, or with kBadData for a
/// damaged or truncated file, fields that are not x, y, z, more than 100 million points, a finite
/// coordinate beyond 100 km, or a cloud without any finite point.
Result<std::vector<Eigen::Vector3d>> ReadPointCloud(const std::filesystem::path& path);

/// Same, from bytes in memory; `source` names them in an error.
Result<std::vector<Eigen::Vector3d>> DecodePly(std::string_view bytes, const std::string& source);
Result<std::vector<Eigen::Vector3d>> DecodePcd(std::string_view bytes, const std::string& source);
/// x, y, z and reflectance of each point as little-endian float32 without a header, as the KITTI
/// data sets keep their Velodyne sweeps.
Result<std::vector<Eigen::Vector3d>> DecodeFloatRecords(std::string_view bytes,
                                                        const std::string& source);

/// Whether a file begins as PCD files do.
bool LooksLikePcd(std::string_view bytes);
/// Fails with kBadData where a finite coordinate is beyond 100 km, or no point is finite.
Status CheckCloudPoints(std::span<const Eigen::Vector3d> points, const std::string& source);

}  // namespace foresight
