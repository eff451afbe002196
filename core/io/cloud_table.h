#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// A point cloud file with everything of it that an import can use. Columns have a value for each
/// point, or none where the file does not know it.
struct CloudTable {
  std::size_t width = 0;                ///< points in a row of the file's own grid
  std::size_t height = 1;               ///< rows; 1 = the file has no grid
  std::vector<Eigen::Vector3d> points;  ///< in the file's frame and order; NaN = none
  std::vector<float> intensity;         ///< intensity, i, reflectance, reflectivity
  std::vector<std::int32_t> line;       ///< line
  std::vector<std::int32_t> beam;       ///< beam
  std::vector<std::int32_t> ring;       ///< ring: the laser of a spinning lidar
  /// time (seconds), t (nanoseconds where they are whole numbers) or timestamp; NaN = not known.
  std::vector<double> time_s;
  std::vector<Rgb8> color;                   ///< PCL's rgb or rgba; red, green, blue; r, g, b
  std::vector<std::string> comments;         ///< of the header, without their mark
  std::optional<Eigen::Vector3d> viewpoint;  ///< of a PCD file
};

/// A named column of numbers, as files and messages have them.
struct NamedColumn {
  std::string name;
  bool is_float = true;         ///< false: whole numbers
  bool has_color_bits = false;  ///< the values are the bits of a packed colour
  std::vector<double> values;
};

/// Sorts columns into the table; x, y and z must be there. Fails with kBadData, naming `source`.
Status TakeColumns(std::vector<NamedColumn> columns, CloudTable& table, const std::string& source);
/// Whether TakeColumns knows what to do with a column of this name.
bool IsCloudColumn(std::string_view name);
/// Which of the columns are x, y or z: a point without one of them is none.
std::vector<bool> WhichAreCoordinates(const std::vector<NamedColumn>& columns);

/// PLY and PCD as ReadPointCloud reads them, with more of their fields.
Result<CloudTable> DecodePlyTable(std::string_view bytes, const std::string& source);
Result<CloudTable> DecodePcdTable(std::string_view bytes, const std::string& source);
/// Four little-endian floats a point, as KITTI has them: x, y, z, reflectance.
Result<CloudTable> DecodeFloatRecordTable(std::string_view bytes, const std::string& source);
/// A point a line, "x y z" or "x y z intensity", separated by blanks, commas or semicolons; a first
/// line without numbers names the columns. Lines that begin with '#' are comments.
Result<CloudTable> DecodeTextTable(std::string_view bytes, const std::string& source);

/// Metres in one of the unit m, cm or mm. Fails with kInvalidOptions for another name.
Result<double> MetresIn(const std::string& unit);
/// From coordinates in `unit_m` to metres.
void ScaleToMetres(double unit_m, CloudTable& table);

/// By the file's first bytes and name: PLY, PCD, floats (.bin), text (.xyz, .txt, .csv, .asc, .3d).
/// Of a .3d file, 3DTK's, points are turned from its left-handed centimetres (x right, y up, z
/// forward) to metres, x forward, y left, z up; the coordinates of others are in `unit_m`. Fails
/// with kIo and with kBadData, also where a coordinate is beyond 100 km or no point is a number.
Result<CloudTable> ReadCloudTable(const std::filesystem::path& path, double unit_m = 1.0);

}  // namespace foresight
