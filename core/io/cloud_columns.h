#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// A number as point cloud files store it.
enum class CloudScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };
std::size_t SizeOf(CloudScalar type);

/// One coordinate of all points in a block of bytes.
struct CloudColumn {
  CloudScalar type = CloudScalar::kFloat32;
  std::size_t first = 0;   ///< bytes before the first value
  std::size_t stride = 0;  ///< bytes from one value to the next
};

/// Points from columns x, y, z. The caller has checked that the block is long enough.
std::vector<Eigen::Vector3d> PointsFromColumns(std::string_view block,
                                               const std::array<CloudColumn, 3>& columns,
                                               std::size_t count, bool big_endian);

/// One number of each point, from such a column.
std::vector<double> ValuesFromColumn(std::string_view block, const CloudColumn& column,
                                     std::size_t count, bool big_endian);

/// Numbers written out: `count` rows of `fields` words each; the columns `wanted`, in their order.
/// A word that is no number is an error in the columns that are `needed` (empty: in all), NaN
/// elsewhere.
Result<std::vector<std::vector<double>>> ColumnsFromText(std::string_view text,
                                                         std::span<const std::size_t> wanted,
                                                         std::size_t fields, std::size_t count,
                                                         const std::string& source,
                                                         const std::vector<bool>& needed = {});

/// Points from numbers written out: `count` rows of `fields` words each, of which `xyz` are wanted.
Result<std::vector<Eigen::Vector3d>> PointsFromText(std::string_view text,
                                                    const std::array<std::size_t, 3>& xyz,
                                                    std::size_t fields, std::size_t count,
                                                    const std::string& source);

/// A number as programs print it, "nan", "-nan" and "inf" included, whatever the locale; nullopt
/// for anything else.
std::optional<double> ParseNumber(std::string_view word);

/// Takes the next line off `rest`, without its end; nullopt where there is none.
std::optional<std::string_view> TakeLine(std::string_view& rest);
std::vector<std::string_view> Words(std::string_view line);
/// A whole number in [0, limit]; nullopt for anything else.
std::optional<std::size_t> ParseCount(std::string_view word, std::size_t limit);

inline constexpr std::size_t kMostCloudPoints = 100'000'000;

}  // namespace foresight
