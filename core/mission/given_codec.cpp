#include "core/mission/given_codec.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/mission/deflater.h"

namespace foresight {
namespace {

static_assert(std::endian::native == std::endian::little, "values are stored as they lie");

constexpr int kGivenZlibLevel = 1;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <class T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
T TakeValue(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  bytes.remove_prefix(sizeof(T));
  return value;
}

std::size_t BytesOf(const PackedGivenLine& packed) {
  const std::size_t floats = 3 + ((packed.parts & PackedGivenLine::kHasIntensity) != 0 ? 1 : 0);
  const std::size_t doubles = (packed.parts & PackedGivenLine::kHasTime) != 0 ? 1 : 0;
  return 3 * sizeof(float) + static_cast<std::size_t>(packed.beams) *
                                 (floats * sizeof(float) + doubles * sizeof(double));
}

}  // namespace

Result<PackedGivenLine> PackGivenLine(const GivenCloud& cloud, int line) {
  PackedGivenLine packed;
  packed.beams = cloud.beams;
  std::string bytes;
  for (int axis = 0; axis < 3; ++axis)
    Append(bytes, cloud.origins[static_cast<std::size_t>(line)][axis]);
  const std::size_t begin = cloud.Index(line, 0);
  const auto beams = static_cast<std::size_t>(cloud.beams);
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = begin; i < begin + beams; ++i) Append(bytes, cloud.points[i][axis]);
  if (!cloud.intensity.empty()) {
    packed.parts |= PackedGivenLine::kHasIntensity;
    for (std::size_t i = begin; i < begin + beams; ++i) Append(bytes, cloud.intensity[i]);
  }
  if (!cloud.time_s.empty()) {
    packed.parts |= PackedGivenLine::kHasTime;
    for (std::size_t i = begin; i < begin + beams; ++i) Append(bytes, cloud.time_s[i]);
  }
  thread_local Deflater deflater(kGivenZlibLevel);
  std::optional<std::string> deflated = deflater.Pack(bytes);
  if (!deflated)
    return Fail(ErrorCode::kInvalidInput, "line {} of a cloud: zlib cannot pack it", line);
  packed.bytes = std::move(*deflated);
  return packed;
}

Status GivenCloudBuilder::CheckShape(std::int64_t line, const PackedGivenLine& packed) {
  constexpr std::int64_t kAllParts = PackedGivenLine::kHasIntensity | PackedGivenLine::kHasTime;
  if (packed.beams < 1 || packed.beams > GivenCloud::kMostBeams || packed.parts < 0 ||
      packed.parts > kAllParts)
    return Fail(ErrorCode::kBadData, "{} beams with parts {} are no line of a cloud", packed.beams,
                packed.parts);
  if (line < cloud_.lines || line >= GivenCloud::kMostLines ||
      (line + 1) * packed.beams > static_cast<std::int64_t>(GivenCloud::kMostCells))
    return Fail(ErrorCode::kBadData, "{} beams cannot be line {} of a cloud", packed.beams, line);
  if (cloud_.beams != 0 && (packed.beams != cloud_.beams || packed.parts != parts_))
    return Fail(ErrorCode::kBadData, "{} beams with parts {} where earlier lines have {} with {}",
                packed.beams, packed.parts, cloud_.beams, parts_);
  cloud_.beams = static_cast<int>(packed.beams);
  parts_ = packed.parts;
  return {};
}

void GivenCloudBuilder::AppendEmptyLines(int count) {
  const std::size_t cells =
      static_cast<std::size_t>(count) * static_cast<std::size_t>(cloud_.beams);
  cloud_.lines += count;
  cloud_.points.Append(cells, Eigen::Vector3f::Constant(kNaN));
  if ((parts_ & PackedGivenLine::kHasIntensity) != 0) cloud_.intensity.Append(cells, 0.0f);
  if ((parts_ & PackedGivenLine::kHasTime) != 0)
    cloud_.time_s.Append(cells, std::numeric_limits<double>::quiet_NaN());
  cloud_.origins.Append(static_cast<std::size_t>(count), Eigen::Vector3f::Constant(kNaN));
}

Status GivenCloudBuilder::Add(std::int64_t line, const PackedGivenLine& packed) {
  FORESIGHT_CHECK(CheckShape(line, packed));
  const std::size_t expected = BytesOf(packed);
  std::string bytes(expected, '\0');
  uLongf size = expected;
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                 reinterpret_cast<const Bytef*>(packed.bytes.data()), packed.bytes.size());
  if (status != Z_OK || size != expected)
    return Fail(ErrorCode::kBadData, "{} packed bytes are not a line of {} beams",
                packed.bytes.size(), packed.beams);
  AppendEmptyLines(static_cast<int>(line) - cloud_.lines);
  std::string_view rest = bytes;
  Eigen::Vector3f origin;
  for (int axis = 0; axis < 3; ++axis) origin[axis] = TakeValue<float>(rest);
  cloud_.origins.push_back(origin);
  const auto beams = static_cast<std::size_t>(cloud_.beams);
  const std::span<Eigen::Vector3f> points = cloud_.points.Append(beams, Eigen::Vector3f::Zero());
  for (int axis = 0; axis < 3; ++axis)
    for (Eigen::Vector3f& point : points) point[axis] = TakeValue<float>(rest);
  if ((parts_ & PackedGivenLine::kHasIntensity) != 0)
    for (float& value : cloud_.intensity.Append(beams, 0.0f)) value = TakeValue<float>(rest);
  if ((parts_ & PackedGivenLine::kHasTime) != 0)
    for (double& value : cloud_.time_s.Append(beams, 0.0)) value = TakeValue<double>(rest);
  ++cloud_.lines;
  return {};
}

}  // namespace foresight
