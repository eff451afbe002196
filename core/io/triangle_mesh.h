#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// The surface of a solid as a file has it, in the file's own frame and unit (often millimetres:
/// no format says which).
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;  ///< counter-clockwise seen from outside, if the file is

  static constexpr std::size_t kMostTriangles = 5'000'000;

  /// Fails with kBadData, naming `source`: no triangle, more than kMostTriangles, a corner that is
  /// not among the vertices, a coordinate that is not finite or beyond 100 km.
  Status Check(const std::string& source) const;
};

/// By the file's first bytes and its name: PLY (ascii, binary of either byte order), OBJ (.obj),
/// STL
/// (.stl, ascii or binary). Polygons are cut into fans; normals, colours, textures and groups are
/// passed over. Fails with kIo, or kBadData for a damaged file, another format, and as Check.
/// O(bytes).
Result<TriangleMesh> ReadTriangleMesh(const std::filesystem::path& path);

/// Same, from bytes in memory; `source` names them in an error.
Result<TriangleMesh> DecodePlyMesh(std::string_view bytes, const std::string& source);
Result<TriangleMesh> DecodeObj(std::string_view bytes, const std::string& source);
Result<TriangleMesh> DecodeStl(std::string_view bytes, const std::string& source);

}  // namespace foresight
