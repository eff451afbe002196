#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/io/obj_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <bit>
#include <cstring>

#include "core/base/atomic_file.h"
#include "core/io/triangle_mesh.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// Six times the volume that the triangles enclose: right only for all of them, wound as written.
double SixVolumes(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles)
    sum += mesh.vertices[static_cast<std::size_t>(t[0])].dot(
        mesh.vertices[static_cast<std::size_t>(t[1])].cross(
            mesh.vertices[static_cast<std::size_t>(t[2])]));
  return sum;
}

/// A tetrahedron of volume 4: its corner is at the origin, its sides on the axes are 2, 3 and 4
/// long.
const std::vector<Eigen::Vector3f> kCorners = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
const std::vector<Eigen::Vector3i> kFaces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

pcl::PolygonMesh PclTetrahedron() {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const Eigen::Vector3f& corner : kCorners)
    cloud.push_back(pcl::PointXYZ(corner.x(), corner.y(), corner.z()));
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2(cloud, mesh.cloud);
  for (const Eigen::Vector3i& face : kFaces) {
    pcl::Vertices polygon;
    for (const int corner : {face[0], face[1], face[2]})
      polygon.vertices.push_back(static_cast<pcl::index_t>(corner));
    mesh.polygons.push_back(polygon);
  }
  return mesh;
}

std::string BinaryStl() {
  std::string bytes(80, ' ');
  // Some programs begin their binary files with the word of the others.
  bytes.replace(0, 5, "solid");
  const auto add = [&bytes](auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  };
  add(static_cast<std::uint32_t>(kFaces.size()));
  for (const Eigen::Vector3i& face : kFaces) {
    for (int i = 0; i < 3; ++i) add(0.0f);
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        add(kCorners[static_cast<std::size_t>(face[corner])][axis]);
    add(std::uint16_t{0});
  }
  return bytes;
}

std::string AsciiStl() {
  std::string text = "solid tetrahedron\n";
  for (const Eigen::Vector3i& face : kFaces) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3f& at = kCorners[static_cast<std::size_t>(face[corner])];
      text += fmt::format("  vertex {} {} {:e}\n", at.x(), at.y(), at.z());
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

TEST(TriangleMesh, ReadsWhatPclWrites) {
  const TemporaryFolder folder;
  const pcl::PolygonMesh mesh = PclTetrahedron();
  pcl::io::savePLYFile(folder / "ascii.ply", mesh);
  pcl::io::savePLYFileBinary(folder / "binary.ply", mesh);
  pcl::io::saveOBJFile(folder / "mesh.obj", mesh);
  for (const char* name : {"ascii.ply", "binary.ply", "mesh.obj"}) {
    const auto read = ReadTriangleMesh(folder / name);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->vertices.size(), 4u) << name;
    EXPECT_NEAR(SixVolumes(*read), 24.0, 1e-4) << name;
  }
}

TEST(TriangleMesh, ReadsBothKindsOfStl) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "binary.STL", BinaryStl()));
  ASSERT_TRUE(WriteFileAtomically(folder / "ascii.stl", AsciiStl()));
  for (const char* name : {"binary.STL", "ascii.stl"}) {
    const auto read = ReadTriangleMesh(folder / name);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->triangles.size(), 4u) << name;
    EXPECT_NEAR(SixVolumes(*read), 24.0, 1e-4) << name;
  }
}

TEST(TriangleMesh, ReadsPolygonsOfAnyLengthAndCornersCountedFromTheEnd) {
  const auto square = DecodeObj(
      "# a square\nv 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\nvt 0 0\nf -4/1/1 -3/1 -2//1 -1\n", "a.obj");
  ASSERT_TRUE(square) << square.error().message;
  ASSERT_EQ(square->triangles.size(), 2u);
  EXPECT_EQ(square->triangles[1], Eigen::Vector3i(0, 2, 3));
  const auto ply = DecodePlyMesh(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty uchar flags\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 1\n2 0 1\n2 2 1\n0 2 1\n9 4 0 1 2 3\n",
      "a.ply");
  ASSERT_TRUE(ply) << ply.error().message;
  EXPECT_EQ(ply->triangles.size(), 2u);
}

TEST(TriangleMesh, RefusesWhatIsDamaged) {
  const auto error = [](const Result<TriangleMesh>& mesh) {
    return mesh ? "no error" : mesh.error().message;
  };
  EXPECT_THAT(error(DecodeObj("v 0 0 0\nf 1 2 3\n", "a.obj")), HasSubstr("a.obj:2"));
  EXPECT_THAT(error(DecodeObj("v 0 zero 0\n", "a.obj")), HasSubstr("a.obj:1"));
  EXPECT_THAT(error(DecodeObj("v 0 0 0\n", "a.obj")), HasSubstr("no triangles"));
  EXPECT_THAT(error(DecodeStl(BinaryStl().substr(0, 150), "a.stl")), HasSubstr("a.stl"));
  EXPECT_THAT(error(DecodeStl("nothing", "a.stl")), HasSubstr("is no STL"));
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 1\n2 0 1\n2 2 1\n";
  EXPECT_THAT(error(DecodePlyMesh(header + "3 0 1 3\n", "a.ply")), HasSubstr("not there"));
  EXPECT_THAT(error(DecodePlyMesh(header + "3 0 1\n", "a.ply")), HasSubstr("face 1"));
  EXPECT_THAT(error(DecodePlyMesh(header, "a.ply")), HasSubstr("face 1"));
}

}  // namespace
}  // namespace foresight
