#include "core/registration/export_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "core/io/read_point_cloud.h"
#include "tests/support/swept_plane.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

TEST(ExportCloud, WritesEveryReturnInTheRobotsFrameAndSaysSo) {
  const TemporaryFolder folder;
  Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -5, 5, 20);
  scan.uuid = "7b1c";
  scan.start_utc_ns = 1'000'000'000;
  const RegisteredScan cloud = RegisterScan(scan, {}).value();
  const auto valid = std::count_if(cloud.range_m.begin(), cloud.range_m.end(),
                                   [](float range) { return range > 0.0f; });
  for (const char* name : {"cloud.ply", "cloud.pcd"}) {
    const auto written = ExportCloud(cloud, scan, folder / name);
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(*written, static_cast<std::size_t>(valid));
    const auto points = ReadPointCloud(folder / name).value();
    ASSERT_EQ(points.size(), *written);
    // The wall is two metres before base: in the robot's frame the head's place is added to x.
    const double wall_m = 2.0 + scan.rig.robot_from_base.translation().x();
    for (const Eigen::Vector3d& point : points) ASSERT_NEAR(point.x(), wall_m, 0.001);
    const std::string bytes = ReadFile(folder / name).value();
    EXPECT_THAT(bytes, testing::HasSubstr("frame robot\n"));
    EXPECT_THAT(bytes, testing::HasSubstr("scan 7b1c 1970-01-01T00:00:01.000Z\n"));
  }
}

}  // namespace
}  // namespace foresight
