#include "core/io/point_cloud_file.h"

#include <bit>
#include <string>

#include "core/base/atomic_file.h"
#include "core/base/printable.h"
#include "core/base/utc_text.h"

namespace foresight {
namespace {

static_assert(std::endian::native == std::endian::little, "values are appended as they lie");

template <class T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void AppendMeasured(std::string& bytes, const CloudPoint& point) {
  Append(bytes, point.x);
  Append(bytes, point.y);
  Append(bytes, point.z);
  Append(bytes, point.intensity);
  Append(bytes, point.line);
  Append(bytes, point.beam);
  Append(bytes, point.time_s);
}

constexpr std::size_t kMaxBytesPerPoint = 40;

/// One line a fact, each after `mark`: how the format begins a comment.
std::string Comments(const char* mark, const CloudOrigin& origin) {
  std::string lines = fmt::format("{} unit metre\n", mark);
  if (!origin.frame.empty()) lines += fmt::format("{} frame {}\n", mark, Printable(origin.frame));
  if (!origin.scan_uuid.empty())
    lines += fmt::format("{} scan {} {}\n", mark, Printable(origin.scan_uuid),
                         UtcText(origin.scan_utc_ns));
  return lines;
}

}  // namespace

Status WritePly(const std::filesystem::path& path, std::span<const CloudPoint> points,
                CloudFields fields, const CloudOrigin& origin) {
  const bool with_image = fields == CloudFields::kWithImage;
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\n{}element vertex {}\n"
      "property float x\nproperty float y\nproperty float z\nproperty float intensity\n"
      "property int line\nproperty int beam\nproperty double time\n{}end_header\n",
      Comments("comment", origin), points.size(),
      with_image ? "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                   "property float confidence\n"
                 : "");
  bytes.reserve(bytes.size() + points.size() * kMaxBytesPerPoint);
  for (const CloudPoint& point : points) {
    AppendMeasured(bytes, point);
    if (!with_image) continue;
    Append(bytes, point.color);
    Append(bytes, point.confidence);
  }
  return WriteFileAtomically(path, bytes);
}

Status WritePcd(const std::filesystem::path& path, std::span<const CloudPoint> points,
                CloudFields fields, const CloudOrigin& origin) {
  const bool with_image = fields == CloudFields::kWithImage;
  std::string bytes = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\n{}VERSION 0.7\n"
      "FIELDS x y z intensity line beam time{}\nSIZE 4 4 4 4 4 4 8{}\nTYPE F F F F I I F{}\n"
      "COUNT 1 1 1 1 1 1 1{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\n"
      "DATA binary\n",
      Comments("#", origin), with_image ? " rgb confidence" : "", with_image ? " 4 4" : "",
      with_image ? " F F" : "", with_image ? " 1 1" : "", points.size(), points.size());
  bytes.reserve(bytes.size() + points.size() * kMaxBytesPerPoint);
  for (const CloudPoint& point : points) {
    AppendMeasured(bytes, point);
    if (!with_image) continue;
    Append(bytes, static_cast<std::uint32_t>(point.color.r) << 16 |
                      static_cast<std::uint32_t>(point.color.g) << 8 | point.color.b);
    Append(bytes, point.confidence);
  }
  return WriteFileAtomically(path, bytes);
}

}  // namespace foresight
