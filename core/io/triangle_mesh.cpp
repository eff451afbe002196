#include "core/io/triangle_mesh.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "core/base/atomic_file.h"
#include "core/io/cloud_columns.h"

namespace foresight {
namespace {

constexpr double kFarthest = 1e5;
constexpr std::size_t kMostBytes = std::size_t{1} << 29;
// An STL file: 80 bytes of anything, a count, and 50 bytes a triangle: a normal, three corners and
// two bytes that mean nothing.
constexpr std::size_t kStlHeader = 80, kStlRecord = 50, kStlNormal = 12;

std::optional<double> NumberFrom(std::string_view word) {
  double value = 0.0;
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Three numbers from words[first] on.
std::optional<Eigen::Vector3d> PointFrom(const std::vector<std::string_view>& words,
                                         std::size_t first) {
  if (words.size() < first + 3) return std::nullopt;
  Eigen::Vector3d point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = NumberFrom(words[first + axis]);
    if (!value) return std::nullopt;
    point[static_cast<Eigen::Index>(axis)] = *value;
  }
  return point;
}

std::uint32_t Word32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return value;
}

/// The vertex that "7", "7/1/3" or "-1" (the last so far) of an OBJ face names.
std::optional<int> CornerFrom(std::string_view word, std::size_t vertices) {
  const auto number = NumberFrom(word.substr(0, word.find('/')));
  if (!number || *number != std::floor(*number)) return std::nullopt;
  const double index = *number > 0.0 ? *number - 1.0 : static_cast<double>(vertices) + *number;
  if (!(index >= 0.0 && index < static_cast<double>(vertices))) return std::nullopt;
  return static_cast<int>(index);
}

Result<TriangleMesh> DecodeBinaryStl(std::string_view bytes, std::size_t count) {
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view corners = bytes.substr(kStlHeader + 4 + i * kStlRecord + kStlNormal);
    const int first = static_cast<int>(mesh.vertices.size());
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Eigen::Vector3f point;
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[static_cast<Eigen::Index>(axis)] =
            std::bit_cast<float>(Word32(corners.substr(12 * corner + 4 * axis)));
      mesh.vertices.push_back(point.cast<double>());
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

Result<TriangleMesh> DecodeAsciiStl(std::string_view bytes, const std::string& source) {
  TriangleMesh mesh;
  int number = 0;
  while (const auto line = TakeLine(bytes)) {
    ++number;
    const std::vector<std::string_view> words = Words(*line);
    if (words.empty() || words[0] != "vertex") continue;
    const auto point = PointFrom(words, 1);
    if (!point || mesh.vertices.size() >= 3 * TriangleMesh::kMostTriangles)
      return Fail(ErrorCode::kBadData, "{}:{}: STL vertex without three numbers", source, number);
    mesh.vertices.push_back(*point);
  }
  if (mesh.vertices.size() % 3 != 0)
    return Fail(ErrorCode::kBadData, "{}: {} STL vertices make no triangles", source,
                mesh.vertices.size());
  for (int i = 0; i + 2 < static_cast<int>(mesh.vertices.size()); i += 3)
    mesh.triangles.emplace_back(i, i + 1, i + 2);
  return mesh;
}

}  // namespace

Status TriangleMesh::Check(const std::string& source) const {
  if (triangles.empty()) return Fail(ErrorCode::kBadData, "{}: has no triangles", source);
  if (triangles.size() > kMostTriangles)
    return Fail(ErrorCode::kBadData, "{}: {} triangles are more than {}", source, triangles.size(),
                kMostTriangles);
  const int count = static_cast<int>(vertices.size());
  for (const Eigen::Vector3i& triangle : triangles)
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= count)
      return Fail(ErrorCode::kBadData, "{}: a triangle names a vertex that is not there", source);
  for (const Eigen::Vector3d& vertex : vertices)
    if (!(vertex.allFinite() && vertex.cwiseAbs().maxCoeff() <= kFarthest))
      return Fail(ErrorCode::kBadData, "{}: a vertex at ({}, {}, {})", source, vertex.x(),
                  vertex.y(), vertex.z());
  return {};
}

Result<TriangleMesh> DecodeObj(std::string_view bytes, const std::string& source) {
  TriangleMesh mesh;
  int number = 0;
  while (const auto line = TakeLine(bytes)) {
    ++number;
    const std::vector<std::string_view> words = Words(*line);
    if (words.empty()) continue;
    if (words[0] == "v") {
      const auto point = PointFrom(words, 1);
      if (!point)
        return Fail(ErrorCode::kBadData, "{}:{}: OBJ vertex without three numbers", source, number);
      mesh.vertices.push_back(*point);
    } else if (words[0] == "f") {
      std::vector<int> corners;
      for (std::size_t i = 1; i < words.size(); ++i) {
        const auto corner = CornerFrom(words[i], mesh.vertices.size());
        if (!corner)
          return Fail(ErrorCode::kBadData, "{}:{}: OBJ face with the corner '{}'", source, number,
                      words[i].substr(0, 32));
        corners.push_back(*corner);
      }
      for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
    }
  }
  FORESIGHT_CHECK(mesh.Check(source));
  return mesh;
}

Result<TriangleMesh> DecodeStl(std::string_view bytes, const std::string& source) {
  // Binary files may begin with "solid" too: only the length tells.
  const bool has_count = bytes.size() >= kStlHeader + 4;
  const std::size_t count = has_count ? Word32(bytes.substr(kStlHeader)) : 0;
  const bool binary = has_count && count <= TriangleMesh::kMostTriangles &&
                      bytes.size() == kStlHeader + 4 + count * kStlRecord;
  if (!binary && !bytes.starts_with("solid"))
    return Fail(ErrorCode::kBadData, "{}: is no STL file: {} bytes are not those of {} triangles",
                source, bytes.size(), count);
  FORESIGHT_TRY(TriangleMesh mesh,
                binary ? DecodeBinaryStl(bytes, count) : DecodeAsciiStl(bytes, source));
  FORESIGHT_CHECK(mesh.Check(source));
  return mesh;
}

Result<TriangleMesh> ReadTriangleMesh(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path, kMostBytes));
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (bytes.starts_with("ply")) return DecodePlyMesh(bytes, path.string());
  if (extension == ".obj") return DecodeObj(bytes, path.string());
  if (extension == ".stl") return DecodeStl(bytes, path.string());
  return Fail(ErrorCode::kBadData, "{}: is no mesh: PLY, OBJ (.obj) and STL (.stl) are read",
              path.string());
}

}  // namespace foresight
