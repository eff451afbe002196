// Other people's scans: a frame of KITTI, a tilting SICK, a rotating scanner, a Kinect. Each is
// imported, gets a depth map, a fit and exports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "core/base/quantile.h"
#include "core/depth/depth_method.h"
#include "core/exchange/export_mission.h"
#include "core/exchange/import_mission.h"
#include "core/fitting/cylinder/fit_cylinder.h"
#include "core/mission/mission_file.h"
#include "core/registration/grid_surface.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

constexpr double kRealDegree = 0.017453292519943295;

fs::path Data(const std::string& name) {
  return fs::path(FORESIGHT_TEST_DATA) / "scans" / name;
}

#define SKIP_WITHOUT(file) \
  if (!fs::exists(Data(file))) GTEST_SKIP() << "needs FORESIGHT_TEST_DATA: " << Data(file)

struct Imported {
  ImportReport report;
  std::unique_ptr<MissionFile> mission;
  Scan scan;
  RegisteredScan cloud;
};

class ImportOfRealData : public testing::Test {
 protected:
  void Import(const std::vector<fs::path>& files, const ImportOptions& options = {}) {
    const fs::path path = folder_ / "m.foresight";
    auto report = ImportMission(files, path, options, {});
    ASSERT_TRUE(report) << report.error().message;
    it_.report = std::move(*report);
    it_.mission = MissionFile::OpenReadOnly(path).value();
    it_.scan = it_.mission->LoadScan(1).value();
    it_.cloud = RegisterScan(it_.scan, {}).value();
    const ImportReport::Entry& entry = it_.report.scans[0];
    std::cout << entry.source << ": " << entry.points << " points, " << entry.lines << " x "
              << entry.beams << ", " << entry.grid << '\n';
  }

  Result<DepthResult> Depth() const {
    return ComputeDepthInFrame(it_.cloud, it_.scan.rig, it_.scan.frames[0],
                               DefaultsOf(DepthMethod::kForesight), {});
  }

  /// Exports it, imports the export, and compares the number of points.
  void ExpectExportComesBack() {
    MissionExportOptions options;
    options.parts = {ExportPart::kPly, ExportPart::kImages, ExportPart::kSurfacePly};
    options.depth = DefaultsOf(DepthMethod::kForesight);
    const auto exported = ExportMission(*it_.mission, folder_ / "out", options, {});
    ASSERT_TRUE(exported) << exported.error().message;
    const auto again = ImportMission(std::vector<fs::path>{folder_ / "out/scan-0001"},
                                     folder_ / "again.foresight", {}, {});
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->scans[0].points, it_.report.scans[0].points);
    EXPECT_EQ(again->scans[0].lines, it_.cloud.lines);
    EXPECT_EQ(again->scans[0].images, it_.scan.frames.size());
  }

  /// Cells whose neighbour on the line is measured too.
  double NeighbourRatio() const {
    std::size_t all = 0, with = 0;
    for (int line = 0; line < it_.cloud.lines; ++line)
      for (int beam = 0; beam + 1 < it_.cloud.beams; ++beam) {
        if (!it_.cloud.Valid(line, beam)) continue;
        ++all;
        with += it_.cloud.Valid(line, beam + 1) ? 1 : 0;
      }
    return static_cast<double>(with) / static_cast<double>(all);
  }

  TemporaryFolder folder_;
  Imported it_;
};

TEST_F(ImportOfRealData, AFrameOfKittiIsUpsampledFittedAndExported) {
  SKIP_WITHOUT("kitti_000007/000007.bin");
  Import({Data("kitti_000007/000007.bin"), Data("kitti_000007/000007.png"),
          Data("kitti_000007/000007_calib.txt")});
  EXPECT_EQ(it_.cloud.lines, 64) << "the lasers of an HDL-64";
  EXPECT_GT(it_.cloud.beams, 1900);
  EXPECT_LT(it_.cloud.beams, 2300);
  EXPECT_GT(NeighbourRatio(), 0.75);
  EXPECT_EQ(it_.report.scans[0].points, 115'236u);
  const auto depth = Depth();
  ASSERT_TRUE(depth) << depth.error().message;
  const auto kept = std::count(depth->mask.values().begin(), depth->mask.values().end(), 255);
  std::cout << depth->samples.samples.size() << " samples, " << 100.0 * depth->density
            << " % measured, " << 100.0 * static_cast<double>(kept) / (1242.0 * 375.0)
            << " % of the image kept\n";
  EXPECT_GT(depth->samples.samples.size(), 15'000u) << "a sixth of the sweep lies in the image";
  EXPECT_GT(kept, 1242 * 375 / 5);
  // The lamp post: radius .223 m at x 7.25, y -4.70 of the Velodyne, which is robot here.
  const auto base_from_robot = it_.scan.rig.robot_from_base.Inverse();
  const BoxRoi box{
      {base_from_robot.rotation(), base_from_robot * Eigen::Vector3d(7.25, -4.70, -0.4)},
      {0.8, 0.8, 1.7}};
  const auto rays = RaysFromScan(it_.cloud, it_.scan.rig, box, 0.02, BoxRays::kPassThrough);
  ASSERT_TRUE(rays) << rays.error().message;
  FitCylinderOptions options;
  options.up = base_from_robot.Rotate(Eigen::Vector3d::UnitZ());
  const auto post = FitCylinder(*rays, options, {});
  ASSERT_TRUE(post) << post.error().message;
  std::cout << "post: radius " << 1000.0 * post->model.radius_m << " mm\n";
  EXPECT_NEAR(post->model.radius_m, 0.223, 0.020);
  ExpectExportComesBack();
}

TEST_F(ImportOfRealData, TheLinesOfATiltingSickAreFound) {
  SKIP_WITHOUT("3dtk_sick/scan000.3d");
  for (const char* name :
       {"3dtk_sick/scan000.3d", "3dtk_sick/scan001.3d", "3dtk_sick/scan002.3d"}) {
    fs::remove(folder_ / "m.foresight");
    ImportOptions options;
    options.view = BlankView{0.0, 0.0, 90.0 * kRealDegree, 320, 240};
    Import({Data(name)}, options);
    EXPECT_EQ(it_.cloud.lines, 226);
    EXPECT_EQ(it_.cloud.beams, 360);
    EXPECT_GT(NeighbourRatio(), 0.99);
    EXPECT_NEAR(it_.scan.rig.lidar.angle_step_rad, 0.5 * kRealDegree, 1e-4);
  }
  EXPECT_TRUE(Depth());
  ExpectExportComesBack();
}

TEST_F(ImportOfRealData, TheLinesOfARotatingScannerAreFound) {
  SKIP_WITHOUT("room_scan/room_scan1.pcd");
  ImportOptions options;
  options.view = BlankView{0.0, 0.0, 90.0 * kRealDegree, 320, 240};
  Import({Data("room_scan/room_scan1.pcd")}, options);
  EXPECT_THAT(it_.report.scans[0].grid, StartsWith("recovered: lines"));
  EXPECT_GT(it_.cloud.lines, 600);
  EXPECT_LT(it_.cloud.lines, 660);
  EXPECT_GT(NeighbourRatio(), 0.9);
  const auto depth = Depth();
  ASSERT_TRUE(depth) << depth.error().message;
  EXPECT_GT(GridSurface(it_.cloud, {})->size(), 50'000u);
  ExpectExportComesBack();
}

TEST_F(ImportOfRealData, AKinectsCloudBringsItsCameraAndItsImage) {
  SKIP_WITHOUT("stairs_kinect2/0001_cloud.pcd");
  Import({Data("stairs_kinect2/0001_cloud.pcd")});
  EXPECT_EQ(it_.cloud.lines, 424);
  EXPECT_EQ(it_.cloud.beams, 512);
  EXPECT_THAT(it_.report.scans[0].notes, Contains(HasSubstr("an image of a depth camera")));
  // A Kinect 2 sees with some 365 px.
  EXPECT_NEAR(it_.scan.rig.camera.fx, 365.0, 10.0);
  EXPECT_NEAR(it_.scan.rig.camera.fy, 365.0, 10.0);
  ASSERT_EQ(it_.scan.frames.size(), 1u);
  const auto depth = Depth();
  ASSERT_TRUE(depth) << depth.error().message;
  // The map says what the points say.
  std::vector<double> errors_m;
  for (const AlignedSample& sample : depth->samples.samples) {
    const float there = depth->dense.depth_m(static_cast<int>(std::lround(sample.u)),
                                             static_cast<int>(std::lround(sample.v)));
    if (std::isfinite(there)) errors_m.push_back(std::abs(there - sample.depth_m));
  }
  ASSERT_GT(errors_m.size(), 100'000u);
  EXPECT_LT(UpperMedian(std::move(errors_m)), 0.005);
  ExpectExportComesBack();
}

TEST_F(ImportOfRealData, AKinectsColourImageOfAnotherCameraIsRefused) {
  SKIP_WITHOUT("stairs_kinect2/0001_color.png");
  const auto report = ImportMission(std::vector<fs::path>{Data("stairs_kinect2/0001_cloud.pcd"),
                                                          Data("stairs_kinect2/0001_color.png")},
                                    folder_ / "m.foresight", {}, {});
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("an image needs its camera"));
}

}  // namespace
}  // namespace foresight
