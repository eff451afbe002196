#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "core/base/atomic_file.h"
#include "core/io/point_cloud_file.h"
#include "core/io/read_point_cloud.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

const std::vector<CloudPoint>& Points() {
  static const std::vector<CloudPoint> points = {
      {1.5f, -2.0f, 3.25f, 1000.0f, 4, 540, 0.25, {10, 20, 30}, 0.5f},
      {-1.0f, 0.0f, 2.0f, 7.0f, 5, 541, 0.5, {255, 0, 128}, 1.0f}};
  return points;
}

/// PCL judges the files: it shares no code with the writer.
void ExpectPoints(const pcl::PCLPointCloud2& cloud) {
  pcl::PointCloud<pcl::PointXYZRGB> colored;
  pcl::fromPCLPointCloud2(cloud, colored);
  ASSERT_EQ(colored.size(), 2u);
  EXPECT_EQ(colored[0].getVector3fMap(), Eigen::Vector3f(1.5f, -2.0f, 3.25f));
  EXPECT_EQ(colored[1].getVector3fMap(), Eigen::Vector3f(-1.0f, 0.0f, 2.0f));
  EXPECT_EQ(colored[1].r, 255);
  EXPECT_EQ(colored[1].g, 0);
  EXPECT_EQ(colored[1].b, 128);
  pcl::PointCloud<pcl::PointXYZI> intensities;
  pcl::fromPCLPointCloud2(cloud, intensities);
  EXPECT_EQ(intensities[0].intensity, 1000.0f);
}

TEST(PointCloudFile, PclReadsThePcdWithItsColors) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePcd(folder / "a.pcd", Points(), CloudFields::kWithImage));
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(folder / "a.pcd", cloud), 0);
  ExpectPoints(cloud);
}

TEST(PointCloudFile, PclReadsThePlyWithItsColors) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePly(folder / "a.ply", Points(), CloudFields::kWithImage));
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::io::loadPLYFile(folder / "a.ply", cloud), 0);
  ExpectPoints(cloud);
}

/// The header's lines before the points.
std::string HeaderOf(const std::filesystem::path& file, const char* last) {
  const std::string bytes = ReadFile(file).value();
  return bytes.substr(0, bytes.find(last));
}

TEST(PointCloudFile, NamesItsFrameItsScanAndItsUnit) {
  const TemporaryFolder folder;
  // 2026-11-22 13:06:33.25 UTC
  const CloudOrigin origin{"robot", "7b1c", 1795352793250000000};
  ASSERT_TRUE(WritePly(folder / "a.ply", Points(), CloudFields::kMeasured, origin));
  EXPECT_THAT(HeaderOf(folder / "a.ply", "end_header"),
              testing::HasSubstr("comment unit metre\ncomment frame robot\n"
                                 "comment scan 7b1c 2026-11-22T13:06:33.250Z\n"));
  ASSERT_TRUE(WritePcd(folder / "a.pcd", Points(), CloudFields::kMeasured, origin));
  EXPECT_THAT(HeaderOf(folder / "a.pcd", "DATA"),
              testing::HasSubstr("# unit metre\n# frame robot\n"
                                 "# scan 7b1c 2026-11-22T13:06:33.250Z\n"));
  pcl::PCLPointCloud2 cloud;
  EXPECT_EQ(pcl::io::loadPLYFile(folder / "a.ply", cloud), 0);
  EXPECT_EQ(pcl::io::loadPCDFile(folder / "a.pcd", cloud), 0);
  EXPECT_TRUE(ReadPointCloud(folder / "a.ply"));
  EXPECT_TRUE(ReadPointCloud(folder / "a.pcd"));
}

TEST(PointCloudFile, ANameWithALineFeedStaysInItsComment) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePly(folder / "a.ply", Points(), CloudFields::kMeasured,
                       {"robot", "x\nelement vertex 9", 0}));
  EXPECT_EQ(ReadPointCloud(folder / "a.ply").value().size(), 2U);
}

TEST(PointCloudFile, WithoutAnImageAPointTakes32Bytes) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePcd(folder / "none.pcd", {}, CloudFields::kMeasured));
  ASSERT_TRUE(WritePcd(folder / "two.pcd", Points(), CloudFields::kMeasured));
  // "0" and "2" in the header are equally long.
  EXPECT_EQ(std::filesystem::file_size(folder / "two.pcd"),
            std::filesystem::file_size(folder / "none.pcd") + 64);
}

TEST(PointCloudFile, AFolderThatIsNotThereIsAnIoError) {
  const TemporaryFolder folder;
  const auto status = WritePly(folder / "missing/a.ply", Points(), CloudFields::kMeasured);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace foresight
