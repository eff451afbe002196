#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <array>
#include <cmath>
#include <cstring>

#include "core/base/atomic_file.h"
#include "core/io/point_cloud_file.h"
#include "core/io/read_point_cloud.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using ReadPoints = std::vector<Eigen::Vector3d>;

/// Written by PCL, which shares no code with the reader.
pcl::PointCloud<pcl::PointXYZI> PclCloud() {
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 500; ++i) {
    pcl::PointXYZI point;
    point.x = 0.25f * static_cast<float>(i % 7);
    point.y = -1.5f;
    point.z = 0.5f + static_cast<float>(i) / 64.0f;
    point.intensity = 9.0f;
    cloud.push_back(point);
  }
  cloud[3].x = cloud[3].y = cloud[3].z = std::nanf("");
  cloud.is_dense = false;
  return cloud;
}

void ExpectEqual(const Result<ReadPoints>& read, const pcl::PointCloud<pcl::PointXYZI>& cloud) {
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), cloud.size());
  EXPECT_TRUE((*read)[3].hasNaN());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (i != 3) {
      EXPECT_EQ((*read)[i], cloud[i].getVector3fMap().cast<double>()) << i;
    }
}

TEST(ReadPointCloud, ReadsWhatPclWritesAsPcdInAllThreeWays) {
  const TemporaryFolder folder;
  const auto cloud = PclCloud();
  pcl::PCDWriter writer;
  writer.writeASCII(folder / "ascii.pcd", cloud, 9);
  writer.writeBinary(folder / "binary.pcd", cloud);
  writer.writeBinaryCompressed(folder / "compressed.pcd", cloud);
  for (const char* name : {"ascii.pcd", "binary.pcd", "compressed.pcd"}) {
    SCOPED_TRACE(name);
    ExpectEqual(ReadPointCloud(folder / name), cloud);
  }
}

TEST(ReadPointCloud, ReadsWhatPclWritesAsPly) {
  const TemporaryFolder folder;
  const auto cloud = PclCloud();
  pcl::io::savePLYFileBinary(folder / "binary.ply", cloud);
  pcl::io::savePLYFileASCII(folder / "ascii.ply", cloud);
  ExpectEqual(ReadPointCloud(folder / "binary.ply"), cloud);
  ExpectEqual(ReadPointCloud(folder / "ascii.ply"), cloud);
}

TEST(ReadPointCloud, ReadsOurOwnExports) {
  const TemporaryFolder folder;
  const std::vector<CloudPoint> points = {
      {1.5f, -2.0f, 3.25f, 1000.0f, 4, 540, 0.25, {10, 20, 30}, 0.5f}};
  ASSERT_TRUE(WritePcd(folder / "a.pcd", points, CloudFields::kWithImage));
  ASSERT_TRUE(WritePly(folder / "a.ply", points, CloudFields::kMeasured));
  for (const char* name : {"a.pcd", "a.ply"}) {
    const auto read = ReadPointCloud(folder / name);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, ReadPoints{Eigen::Vector3d(1.5, -2.0, 3.25)});
  }
}

TEST(ReadPointCloud, ReadsABigEndianPlyOfDoublesBehindAnotherElement) {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement camera 1\nproperty uchar id\n"
      "element vertex 1\nproperty uchar q\nproperty double z\nproperty double y\n"
      "property double x\nend_header\n";
  bytes += '\x07';                                  // camera
  bytes += '\x01';                                  // q
  bytes += std::string("\x40\x08\0\0\0\0\0\0", 8);  // 3
  bytes += std::string("\xC0\x00\0\0\0\0\0\0", 8);  // -2
  bytes += std::string("\x3F\xF8\0\0\0\0\0\0", 8);  // 1.5
  const auto read = DecodePly(bytes, "a.ply");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, ReadPoints{Eigen::Vector3d(1.5, -2.0, 3.0)});
}

void ExpectRefused(const Result<ReadPoints>& read, const std::string& where) {
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  EXPECT_NE(read.error().message.find(where), std::string::npos) << read.error().message;
  EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
}

TEST(ReadPointCloud, ACloudCutAnywhereIsRefused) {
  const TemporaryFolder folder;
  const auto cloud = PclCloud();
  pcl::PCDWriter writer;
  writer.writeBinary(folder / "binary.pcd", cloud);
  writer.writeBinaryCompressed(folder / "compressed.pcd", cloud);
  writer.writeASCII(folder / "ascii.pcd", cloud, 9);
  pcl::io::savePLYFileBinary(folder / "binary.ply", cloud);
  for (const char* name : {"binary.pcd", "compressed.pcd", "ascii.pcd", "binary.ply"}) {
    const std::string whole = ReadFile(folder / name).value();
    // PCL's PLY has a camera element behind its points: the last points are what must be there.
    const std::size_t last =
        std::string(name) == "binary.ply" ? whole.size() - 100 : whole.size() - 8;
    for (std::size_t length = 0; length < last; length += 97) {
      ASSERT_TRUE(WriteFileAtomically(folder / "cut", whole.substr(0, length)));
      ExpectRefused(ReadPointCloud(folder / "cut"), "cut");
    }
  }
}

/// ReadPoints as a Velodyne sweep keeps them: x, y, z, reflectance.
std::string FloatRecords(const std::vector<std::array<float, 4>>& points) {
  std::string bytes(points.size() * sizeof(points[0]), '\0');
  std::memcpy(bytes.data(), points.data(), bytes.size());
  return bytes;
}

TEST(ReadPointCloud, ReadsRecordsOfFourFloatsByTheNameOfTheFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(
      folder / "sweep.bin",
      FloatRecords({{7.25f, -4.5f, 0.5f, 0.3f}, {1.0f, std::nanf(""), 2.0f, 0.0f}})));
  const auto read = ReadPointCloud(folder / "sweep.bin");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ((*read)[0], Eigen::Vector3d(7.25, -4.5, 0.5));
  EXPECT_TRUE((*read)[1].hasNaN());
}

TEST(ReadPointCloud, RefusesRecordsThatAreCutEmptyOrWithoutNumbers) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& bytes) {
    EXPECT_TRUE(WriteFileAtomically(folder / "sweep.bin", bytes));
    return ReadPointCloud(folder / "sweep.bin");
  };
  const std::string whole = FloatRecords({{1.0f, 2.0f, 3.0f, 0.1f}, {2.0f, 3.0f, 4.0f, 0.2f}});
  for (std::size_t length = 0; length < whole.size(); ++length)
    if (length != 16) {
      ExpectRefused(read(whole.substr(0, length)), "sweep.bin");
    }
  const float nan = std::nanf("");
  ExpectRefused(read(FloatRecords({{nan, nan, nan, 0.1f}})), "none of its 1 points");
  ExpectRefused(read("a text file of 32 bytes, no cloud"), "sweep.bin");
  ExpectRefused(read("a text file of 32 bytes no cloud"), "sweep.bin");
}

TEST(ReadPointCloud, RefusesAnAbsurdCountBeforeItEatsTheMemory) {
  ExpectRefused(DecodePly("ply\nformat binary_little_endian 1.0\nelement vertex 99999999\n"
                          "property float x\nproperty float y\nproperty float z\nend_header\n1234",
                          "a.ply"),
                "a.ply");
  ExpectRefused(
      DecodePly("ply\nformat ascii 1.0\nelement vertex 99999999999999\nend_header\n", "a.ply"),
      "99999999999999");
  ExpectRefused(DecodePcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 90000000\n"
                          "HEIGHT 1\nPOINTS 90000000\nDATA binary_compressed\n\x08\0\0\0abcdefgh",
                          "a.pcd"),
                "a.pcd");
}

TEST(ReadPointCloud, RefusesCloudsWithoutNumbersOrInAnotherUnit) {
  const TemporaryFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  const auto read = [&](const std::string& body) {
    EXPECT_TRUE(WriteFileAtomically(folder / "a.ply", header + body));
    return ReadPointCloud(folder / "a.ply");
  };
  EXPECT_TRUE(read("1 2 3\nnan nan nan\n"));
  ExpectRefused(read("nan nan nan\nnan nan nan\n"), "none of its 2 points");
  ExpectRefused(read("1 2 3\n1e30 0 0\n"), "point 1");
  ExpectRefused(read("1 2 3\n1 two 3\n"), "'two'");
  ExpectRefused(read("1 2 3\n1 2\n"), "point 1");
  ExpectRefused(DecodePcd("FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nPOINTS 0\nDATA ascii\n", "a"),
                "'z'");
}

}  // namespace
}  // namespace foresight
