// Other programs' files become missions, and our own exports come back as they were.
#include "core/exchange/import_mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/calibration/camera_of_grid.h"
#include "core/calibration/kitti_calibration.h"
#include "core/depth/depth_method.h"
#include "core/detection/candidates.h"
#include "core/detection/fit_in_scan.h"
#include "core/exchange/bag_check.h"
#include "core/exchange/bag_file.h"
#include "core/exchange/export_mission.h"
#include "core/io/png.h"
#include "core/mission/mission_file.h"
#include "core/registration/export_cloud.h"
#include "core/sensor/rig_id.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/synthetic_scan.h"

namespace foresight {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180.0;

Result<ImportReport> Import(std::vector<fs::path> sources, const fs::path& target,
                            const ImportOptions& options = {}) {
  return ImportMission(sources, target, options, {});
}

Scan ScanOf(const fs::path& mission, std::int64_t id = 1) {
  return MissionFile::OpenReadOnly(mission).value()->LoadScan(id).value();
}

/// A mission with a scan of a valve, exported as clouds, images, rig and bag.
class ImportOfAnExport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const auto mission = MissionFile::Create(*folder_ / "m.foresight").value();
    scan_ = WallAndValveScan({.from_rad = -0.20, .to_rad = 0.20, .speed_rad_s = 0.15});
    const std::int64_t id = mission->BeginScan(scan_).value();
    for (const LidarLine& line : scan_.lines) ASSERT_TRUE(mission->AppendLine(id, line));
    ASSERT_TRUE(mission->AppendMotorSamples(id, scan_.track.samples()));
    for (const CameraFrame& frame : scan_.frames) ASSERT_TRUE(mission->AppendFrame(id, frame));
    ASSERT_TRUE(mission->EndScan(id, ScanState::kComplete, ""));
    scan_ = mission->LoadScan(id).value();
    cloud_ = RegisterScan(scan_, {}).value();
    for (const ExportPart cloud : {ExportPart::kPly, ExportPart::kPcd, ExportPart::kBag}) {
      MissionExportOptions options;
      options.parts = {cloud};
      if (cloud != ExportPart::kBag) options.parts.push_back(ExportPart::kImages);
      options.depth = DefaultsOf(DepthMethod::kForesight);
      ASSERT_TRUE(ExportMission(*mission, *folder_ / std::string(ToString(cloud)), options, {}));
    }
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void ExpectSame(const Scan& imported) {
    const RegisteredScan cloud = RegisterScan(imported, {}).value();
    ASSERT_EQ(cloud.lines, cloud_.lines);
    ASSERT_EQ(cloud.beams, cloud_.beams);
    const std::vector<CloudPoint> was = PointsInRobot(cloud_, scan_);
    const std::vector<CloudPoint> is = PointsInRobot(cloud, imported);
    ASSERT_EQ(is.size(), was.size());
    ASSERT_GT(is.size(), 10'000u);
    // A float of some metres is known to 0.24 um; the way to base and back rounds three times.
    constexpr float kFloat_m = 2e-6f;
    for (std::size_t i = 0; i < is.size(); ++i) {
      ASSERT_EQ(is[i].line, was[i].line) << i;
      ASSERT_EQ(is[i].beam, was[i].beam) << i;
      ASSERT_EQ(is[i].time_s, was[i].time_s) << i;
      ASSERT_EQ(is[i].intensity, was[i].intensity) << i;
      ASSERT_NEAR(is[i].x, was[i].x, kFloat_m) << i;
      ASSERT_NEAR(is[i].y, was[i].y, kFloat_m) << i;
      ASSERT_NEAR(is[i].z, was[i].z, kFloat_m) << i;
    }
    for (int line = 0; line < cloud.lines; ++line) {
      const auto at = static_cast<std::size_t>(line);
      if (cloud_.origins[at].allFinite()) {
        ASSERT_EQ(cloud.origins[at], cloud_.origins[at]) << line;
      }
    }
    EXPECT_EQ(RigId(imported.rig), RigId(scan_.rig)) << "camera and all poses of the head";
    EXPECT_EQ(imported.frames, scan_.frames);
    EXPECT_EQ(imported.start_utc_ns, scan_.start_utc_ns);
    EXPECT_EQ(imported.simulated, scan_.simulated);
    EXPECT_NE(imported.uuid, scan_.uuid) << "a copy is another scan";
    EXPECT_THAT(imported.source, testing::StartsWith("imported: "));
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline Scan scan_;
  static inline RegisteredScan cloud_;
};

TEST_F(ImportOfAnExport, ItsPlyIsTheScan) {
  const ImportReport report =
      Import({*folder_ / "ply/scan-0001"}, *folder_ / "from_ply.foresight").value();
  ASSERT_EQ(report.scans.size(), 1u);
  EXPECT_EQ(report.scans[0].of_scan_uuid, scan_.uuid);
  EXPECT_THAT(report.scans[0].notes, IsEmpty());
  ExpectSame(ScanOf(*folder_ / "from_ply.foresight"));
}

TEST_F(ImportOfAnExport, ItsPcdIsTheScanAlsoByTheFolderOfAllScans) {
  ASSERT_TRUE(Import({*folder_ / "pcd"}, *folder_ / "from_pcd.foresight"));
  ExpectSame(ScanOf(*folder_ / "from_pcd.foresight"));
}

TEST_F(ImportOfAnExport, ItsBagIsTheScan) {
  const auto report = Import({*folder_ / "bag/mission.bag"}, *folder_ / "from_bag.foresight");
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->scans[0].of_scan_uuid, scan_.uuid);
  ExpectSame(ScanOf(*folder_ / "from_bag.foresight"));
}

TEST_F(ImportOfAnExport, ItsValveIsFoundWhereItWas) {
  ASSERT_TRUE(Import({*folder_ / "ply/scan-0001"}, *folder_ / "valve.foresight"));
  const Scan imported = ScanOf(*folder_ / "valve.foresight");
  const double motor_rad = scan_.frames[0].motor_angle_rad;
  const auto center = scan_.rig.camera.Project(scan_.rig.CameraFromBase(motor_rad) *
                                               SyntheticValvePose().translation());
  const Roi roi = ImageRoi::Rectangle(motor_rad, *center - Eigen::Vector2d(50, 50),
                                      *center + Eigen::Vector2d(50, 50));
  const FitOptions options = FitOptionsFor(ObjectKind::kValve, scan_.rig.robot_from_base);
  const auto pose_in = [&](const Scan& scan) {
    const RegisteredScan cloud = RegisterScan(scan, {}).value();
    return CandidatePose(
        FitInScan({scan.rig, cloud, scan.frames}, FitSource::kRaw, roi, options, {}).value(), 0);
  };
  const auto was = pose_in(scan_), is = pose_in(imported);
  EXPECT_LT((was.translation() - is.translation()).norm(), 1e-4);
  // The search over the wheel's turn ends where it no longer gains; points that differ by a
  // micrometre lead it there by another way.
  EXPECT_LT(was.rotation().angularDistance(is.rotation()), 0.01);
}

TEST_F(ImportOfAnExport, ABagThatIsTornOrHasFlippedBytesIsRefusedOrReadAndNeverCrashes) {
  const std::string good = ReadFile(*folder_ / "bag/mission.bag").value();
  Random random(11);
  int refused = 0;
  for (int trial = 0; trial < 40; ++trial) {
    std::string bad = good;
    if (trial % 2 == 0) {
      bad.resize(static_cast<std::size_t>(random.Uniform() * static_cast<double>(bad.size())));
    } else {
      // Mostly where the lengths are: at the beginning and in the index at the end.
      for (int flip = 0; flip < 3; ++flip) {
        const std::size_t reach = std::min<std::size_t>(6000, bad.size());
        const auto from = static_cast<std::size_t>(random.Index(static_cast<int>(reach)));
        bad[flip % 2 == 0 ? from : bad.size() - 1 - from] ^=
            static_cast<char>(1 << random.Index(8));
      }
    }
    ASSERT_TRUE(WriteFileAtomically(*folder_ / "bad.bag", bad));
    fs::remove(*folder_ / "bad.foresight");
    const auto report = Import({*folder_ / "bad.bag"}, *folder_ / "bad.foresight");
    if (report) continue;
    ++refused;
    EXPECT_THAT(report.error().message, HasSubstr("bad.bag")) << trial;
    EXPECT_EQ(report.error().message.find('\n'), std::string::npos) << "one line";
  }
  EXPECT_GE(refused, 20) << "a torn bag has no index";
}

/// Every length in a bag, one after the other, says a gigabyte more than there is.
TEST_F(ImportOfAnExport, ALengthThatLiesNeverReachesTheLibrary) {
  const std::string good = ReadFile(*folder_ / "bag/mission.bag").value();
  ASSERT_EQ(CheckBag(*folder_ / "bag/mission.bag"), "");
  std::size_t at = std::string_view("#ROSBAG V2.0\n").size();
  int lengths = 0;
  while (at < good.size()) {
    std::uint32_t length = 0;
    std::memcpy(&length, good.data() + at, sizeof length);
    std::string bad = good;
    bad[at + 3] = static_cast<char>(bad[at + 3] | 0x40);
    ASSERT_TRUE(WriteFileAtomically(*folder_ / "long.bag", bad));
    ASSERT_THAT(CheckBag(*folder_ / "long.bag"),
                HasSubstr(fmt::format("is damaged at byte {}: ", at)))
        << lengths;
    at += 4 + length;
    ++lengths;
  }
  EXPECT_GT(lengths, 20);
}

TEST_F(ImportOfAnExport, PackedBagsAreCheckedAndRead) {
  for (const char* compression : {"bz2", "lz4"}) {
    const fs::path packed = *folder_ / (std::string(compression) + ".bag");
    const ProgramResult made = RunProgram(
        "/usr/bin/python3", {FORESIGHT_SOURCE_DIR "/tests/core/exchange/pack_bag.py",
                             *folder_ / "bag/mission.bag", packed.string(), compression});
    ASSERT_EQ(made.exit_code, 0) << made.errors;
    ASSERT_EQ(CheckBag(packed), "") << compression;
    const fs::path mission = *folder_ / (std::string(compression) + ".foresight");
    ASSERT_TRUE(Import({packed}, mission));
    ExpectSame(ScanOf(mission));
    std::string bad = ReadFile(packed).value();
    bad[bad.size() / 2] = static_cast<char>(bad[bad.size() / 2] ^ 0x10);
    ASSERT_TRUE(WriteFileAtomically(packed, bad));
    EXPECT_NE(CheckBag(packed), "") << "the packed data carry a checksum";
  }
}

TEST_F(ImportOfAnExport, ItsBagWithoutOurRecordIsPlacedByTf) {
  // What RViz would know of it: another program writes the same messages without /foresight/scan.
  const fs::path bag = *folder_ / "foreign.bag";
  {
    BagFile out;
    ASSERT_EQ(out.Open(bag.string()), "");
    const BagTime_ns time = 1795352793250000000;
    const auto pose = [](const char* frame, const char* child, const auto& rigid) {
      const Eigen::Vector3d& t = rigid.translation();
      const Eigen::Quaterniond& q = rigid.rotation();
      return BagPose{frame, child, {t.x(), t.y(), t.z()}, {q.w(), q.x(), q.y(), q.z()}};
    };
    const auto robot_from_lidar =
        Rigid<frame::Robot, frame::Lidar>(Eigen::Quaterniond::Identity(), {0.1, 0.2, 1.5});
    const Rigid<frame::Camera, frame::Lidar> camera_from_lidar(
        Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), Eigen::Vector3d(0.0, 0.07, -0.015));
    ASSERT_EQ(out.WriteTransforms("/tf_static", time,
                                  {pose("base_link", "velodyne", robot_from_lidar),
                                   pose("velodyne", "eye", camera_from_lidar.Inverse())}),
              "");
    BagCloud cloud;
    cloud.frame = "velodyne";
    cloud.fields = {{"x", BagField::Type::kFloat32},
                    {"y", BagField::Type::kFloat32},
                    {"z", BagField::Type::kFloat32},
                    {"ring", BagField::Type::kInt32}};
    for (int ring = 0; ring < 8; ++ring)
      for (int i = 0; i < 360; ++i) {
        const float xyz[3] = {static_cast<float>(5.0 * std::cos(i * kDegree)),
                              static_cast<float>(5.0 * std::sin(i * kDegree)),
                              0.1f * static_cast<float>(ring)};
        const std::int32_t number = ring;
        cloud.data.insert(cloud.data.end(), reinterpret_cast<const std::uint8_t*>(xyz),
                          reinterpret_cast<const std::uint8_t*>(xyz) + 12);
        cloud.data.insert(cloud.data.end(), reinterpret_cast<const std::uint8_t*>(&number),
                          reinterpret_cast<const std::uint8_t*>(&number) + 4);
        ++cloud.points;
      }
    ASSERT_EQ(out.WriteCloud("/points", time, cloud), "");
    BagImage image{"eye", 64, 48, 3, std::vector<std::uint8_t>(64 * 48 * 3, 90)};
    ASSERT_EQ(out.WriteImage("/eye/image_raw", time + 10'000'000, image), "");
    ASSERT_EQ(out.WriteCamera("/eye/camera_info", time,
                              {"eye", 64, 48, "plumb_bob", {0, 0, 0, 0, 0}, 40, 40, 31.5, 23.5}),
              "");
    ASSERT_EQ(out.Close(), "");
  }
  const auto report = Import({bag}, *folder_ / "foreign.foresight");
  ASSERT_TRUE(report) << report.error().message;
  const Scan scan = ScanOf(*folder_ / "foreign.foresight");
  EXPECT_EQ(scan.given.lines, 8);
  EXPECT_EQ(scan.given.beams, 360);
  ASSERT_EQ(scan.frames.size(), 1u);
  EXPECT_NEAR(scan.frames[0].time_s, 0.01, 1e-9);
  EXPECT_EQ(scan.start_utc_ns, 1795352793250000000);
  // A point 5 m ahead of the lidar: in the robot's frame, and in the camera.
  const std::vector<CloudPoint> points = PointsInRobot(RegisterScan(scan, {}).value(), scan);
  const auto ahead = std::find_if(points.begin(), points.end(), [](const CloudPoint& p) {
    return std::abs(p.x - 5.1f) < 1e-3f && std::abs(p.y - 0.2f) < 1e-3f;
  });
  ASSERT_NE(ahead, points.end());
  const Eigen::Vector3d in_base =
      scan.rig.robot_from_base.Inverse() * Eigen::Vector3d(ahead->x, ahead->y, ahead->z);
  const Eigen::Vector3d in_camera = scan.rig.CameraFromBase(0.0) * in_base;
  EXPECT_NEAR(in_camera.z(), 5.0 - 0.015, 1e-3);
  EXPECT_NEAR(in_camera.x(), 0.0, 1e-3);
}

TEST_F(ImportOfAnExport, PosesOfAnotherProgramsBagAreNotesWithTheirDigits) {
  const fs::path seed = *folder_ / "seed.bag", bag = *folder_ / "poses.bag";
  {
    BagFile out;
    ASSERT_EQ(out.Open(seed.string()), "");
    constexpr BagTime_ns kTime = 1795352793250000000;
    BagCloud cloud{"map", {}, 0, {}};
    for (const char* axis : {"x", "y", "z"})
      cloud.fields.push_back({axis, BagField::Type::kFloat32});
    for (int i = 0; i < 100; ++i) {
      const float xyz[3] = {2.0f, 0.01f * static_cast<float>(i % 10), 0.1f * static_cast<float>(i)};
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(xyz);
      cloud.data.insert(cloud.data.end(), bytes, bytes + sizeof(xyz));
      ++cloud.points;
    }
    ASSERT_EQ(out.WritePose("/seed", kTime, {"map", "", {}, {}}), "");
    ASSERT_EQ(out.WriteCloud("/cloud", kTime, cloud), "");
    ASSERT_EQ(out.Close(), "");
  }
  const ProgramResult wrote = RunProgram(
      "/usr/bin/python3",
      {FORESIGHT_SOURCE_DIR "/tests/core/exchange/write_bag.py", seed.string(), bag.string()});
  ASSERT_EQ(wrote.exit_code, 0) << wrote.errors;
  const auto report = Import({bag}, *folder_ / "poses.foresight");
  ASSERT_TRUE(report) << report.error().message;
  const auto mission = MissionFile::OpenReadOnly(*folder_ / "poses.foresight").value();
  EXPECT_THAT(mission->ListDetections().value(), IsEmpty());
  const std::vector<NoteRecord> notes = mission->ListNotes().value();
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[1].text,
            "/goal: a pose in 'map', position (0.3333333333333333, -2, 1e-09) m, quaternion "
            "(w, x, y, z) (0.8, 0, 0.6, 0)");
  EXPECT_EQ(notes[1].utc_ns, 1795352794250000000);
  EXPECT_EQ(notes[1].scan_uuid, report->scans[0].uuid);
  EXPECT_THAT(report->scans[0].notes, Contains(HasSubstr("/goal that is not finite is left out")));
}

/// KITTI's form: a pinhole, beside the reference camera, turned by a rectification.
const char* const kKitti =
    "P0: 700 0 60 0 0 700 20 0 0 0 1 0\n"
    "P2: 700 0 60 42 0 700 20 0 0 0 1 0\n"
    "R0_rect: 1 0 0 0 1 0 0 0 1\n"
    "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 -0.08 1 0 0 -0.27\n";

TEST(KittiCalibration, PlacesTheColourCameraOnTheVelodyne) {
  const KittiCamera camera = KittiCameraFrom(kKitti, 2, "calib.txt").value();
  EXPECT_EQ(camera.camera.fx, 700.0);
  // 6 cm right of the reference camera: P2's fourth column by its focal length.
  const Eigen::Vector3d point = camera.camera_from_velodyne * Eigen::Vector3d(10.27, 0.0, -0.08);
  EXPECT_TRUE(point.isApprox(Eigen::Vector3d(0.06, 0.0, 10.0), 1e-12)) << point.transpose();
  const KittiCamera reference = KittiCameraFrom(kKitti, 0, "calib.txt").value();
  EXPECT_NEAR((reference.camera_from_velodyne * Eigen::Vector3d(10.27, 0.0, -0.08)).x(), 0.0,
              1e-12);
}

TEST(KittiCalibration, WhatIsNoneIsRefusedByTheRow) {
  const auto why = [](std::string text, const char* from, const char* to) {
    text.replace(text.find(from), std::strlen(from), to);
    return KittiCameraFrom(text, 2, "calib.txt").error().message;
  };
  EXPECT_THAT(why(kKitti, "P2:", "Q2:"), HasSubstr("calib.txt: is no calibration of KITTI"));
  EXPECT_THAT(why(kKitti, "P2: 700", "P2: x"), HasSubstr("P2: 'x' is not a number"));
  EXPECT_THAT(why(kKitti, "P2: 700", "P2:"), HasSubstr("11 numbers instead of 12"));
  EXPECT_THAT(why(kKitti, "P2: 700 0", "P2: 700 5"), HasSubstr("no projection"));
  EXPECT_THAT(why(kKitti, "-0.27", "-2.7e30"), HasSubstr("m from the velodyne (at most 2)"));
  EXPECT_THAT(why(kKitti, "cam: 0 -1", "cam: 0 -2"), HasSubstr("Tr_velo_to_cam is no rotation"));
}

/// A plane seen by a depth camera whose frame is turned to an x that is up.
CloudTable DepthCameraCloud(int width, int height, double focal_px) {
  CloudTable table;
  table.width = static_cast<std::size_t>(width);
  table.height = static_cast<std::size_t>(height);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()));
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3d ray((u - 0.52 * width) / focal_px, (v - 0.47 * height) / focal_px, 1.0);
      const double depth = 2.0 / (1.0 + 0.3 * ray.x() - 0.2 * ray.y());
      table.points.push_back(turn * (depth * ray));
      table.color.push_back({static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v), 9});
    }
  return table;
}

TEST(CameraOfGrid, IsFoundFromTheRowsOfADepthCamera) {
  const CloudTable table = DepthCameraCloud(120, 80, 100.0);
  const auto found = CameraOfGrid(table.points, 120);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->camera.fx, 100.0, 1e-6);
  EXPECT_NEAR(found->camera.fy, 100.0, 1e-6);
  EXPECT_NEAR(found->camera.cx, 0.52 * 120, 1e-6);
  EXPECT_LT(found->rms_px, 1e-6);
}

TEST(CameraOfGrid, PointsThatAppearElsewhereAreLeftOut) {
  CloudTable table = DepthCameraCloud(120, 80, 100.0);
  for (std::size_t i = 0; i < table.points.size(); i += 10)
    table.points[i] = Eigen::Vector3d(0.3, -0.1, 0.2 + 1e-4 * static_cast<double>(i));
  const auto found = CameraOfGrid(table.points, 120);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->camera.fx, 100.0, 1e-3);
  EXPECT_NEAR(found->agreeing_ratio, 0.9, 0.01);
}

TEST(CameraOfGrid, ALidarsRowsAreNoCamera) {
  std::vector<Eigen::Vector3d> points;
  for (int ring = 0; ring < 16; ++ring)
    for (int i = 0; i < 360; ++i)
      points.push_back(5.0 *
                       Eigen::Vector3d(std::cos(i * kDegree), std::sin(i * kDegree), 0.05 * ring));
  EXPECT_FALSE(CameraOfGrid(points, 360));
}

TEST(AssembleScan, AnOrganisedCloudWithColoursIsItsOwnImage) {
  ScanParts parts;
  parts.name = "depth.pcd";
  parts.cloud = DepthCameraCloud(120, 80, 100.0);
  const ImportedScan imported = AssembleScan(std::move(parts), {}).value();
  const Scan& scan = imported.scan;
  EXPECT_EQ(scan.given.lines, 80);
  EXPECT_EQ(scan.given.beams, 120);
  ASSERT_EQ(scan.frames.size(), 1u);
  EXPECT_EQ(scan.frames[0].image(30, 20), (Rgb8{30, 20, 9}));
  // Each point appears at its own pixel.
  const Eigen::Vector3d point = scan.given.points[scan.given.Index(20, 30)].cast<double>();
  const auto pixel = scan.rig.camera.Project(scan.rig.CameraFromBase(0.0) * point);
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Eigen::Vector2d(30, 20)).norm(), 1e-3);
  EXPECT_THAT(imported.notes, Contains(HasSubstr("its pinhole of 100 x 100 px")));
}

class ImportOfFiles : public testing::Test {
 protected:
  void Write(const char* name, const std::string& bytes) {
    ASSERT_TRUE(WriteFileAtomically(folder_ / name, bytes));
  }
  /// 8 turns of 200 points, 6 m away, as KITTI's records.
  void WriteTurns(const char* name) {
    std::string bytes;
    for (int ring = 0; ring < 8; ++ring)
      for (int i = 0; i < 200; ++i) {
        const double azimuth = (i + 0.5) * 1.8 * kDegree;
        const float record[4] = {static_cast<float>(6.0 * std::cos(azimuth)),
                                 static_cast<float>(6.0 * std::sin(azimuth)),
                                 -0.1f * static_cast<float>(ring), 0.25f};
        bytes.append(reinterpret_cast<const char*>(record), sizeof(record));
      }
    Write(name, bytes);
  }
  std::string Why(std::vector<fs::path> sources, const ImportOptions& options = {}) {
    const auto report = Import(std::move(sources), target_, options);
    EXPECT_FALSE(fs::exists(target_)) << "nothing is left of an import that failed";
    EXPECT_FALSE(fs::exists(target_.string() + ".part"));
    return report ? "" : report.error().message;
  }

  /// Metres to the first point of a file that is imported in this unit; NaN where it is not.
  float RangeOfFirst(const char* name, double unit_m) {
    ImportOptions options;
    options.unit_m = unit_m;
    const auto report = Import({folder_ / name}, target_, options);
    EXPECT_TRUE(report) << report.error().message;
    return report ? ScanOf(target_).given.points[0].norm() : std::nanf("");
  }

  TemporaryFolder folder_;
  const fs::path target_ = folder_ / "m.foresight";
};

TEST_F(ImportOfFiles, AKittiFrameGetsItsGridItsImageAndItsCamera) {
  WriteTurns("000007.bin");
  Write("000007_calib.txt", kKitti);
  ASSERT_TRUE(WritePng(folder_ / "000007.png", ColorImage(120, 40, {1, 2, 3})));
  const auto report = Import(
      {folder_ / "000007.png", folder_ / "000007_calib.txt", folder_ / "000007.bin"}, target_);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->scans[0].grid, "recovered: turns of a spinning lidar");
  EXPECT_EQ(report->scans[0].points, 1600u);
  const Scan scan = ScanOf(target_);
  EXPECT_EQ(scan.given.lines, 8);
  EXPECT_EQ(scan.given.beams, 200);
  EXPECT_EQ(scan.rig.camera.width, 120);
  EXPECT_EQ(scan.given.intensity[0], 0.25f);
  const auto mission = MissionFile::OpenReadOnly(target_).value();
  EXPECT_EQ(mission->ListScans()->at(0).source, "imported: 000007.bin");
  std::string log;
  const std::vector<EventRecord> events = mission->ListEvents().value();
  for (const EventRecord& event : events) log += event.text + "\n";
  EXPECT_THAT(log, HasSubstr("1600 points on a grid of 8 lines of 200 beams"));
  EXPECT_THAT(log, HasSubstr("when it was measured is not in the file"));
}

TEST_F(ImportOfFiles, FarPointsInMillimetresAreNear) {
  Write("mm.xyz", "250000 0 0\n250000 100 0\n250000 0 100\n");
  EXPECT_THAT(Why({folder_ / "mm.xyz"}), HasSubstr("are its coordinates in another unit?"));
  EXPECT_NEAR(RangeOfFirst("mm.xyz", 0.001), 250.0f, 0.2f);
}

TEST_F(ImportOfFiles, FarPointsInMillimetresOfABagAreNear) {
  BagFile out;
  ASSERT_EQ(out.Open((folder_ / "mm.bag").string()), "");
  BagCloud cloud{"map", {}, 0, {}};
  for (const char* axis : {"x", "y", "z"}) cloud.fields.push_back({axis, BagField::Type::kFloat32});
  for (int i = 0; i < 3; ++i) {
    const float xyz[3] = {250'000.0f, 100.0f * static_cast<float>(i), 0.0f};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(xyz);
    cloud.data.insert(cloud.data.end(), bytes, bytes + sizeof(xyz));
    ++cloud.points;
  }
  ASSERT_EQ(out.WriteCloud("/cloud", 1795352793250000000, cloud), "");
  ASSERT_EQ(out.Close(), "");
  EXPECT_THAT(Why({folder_ / "mm.bag"}), HasSubstr("are its coordinates in another unit?"));
  EXPECT_NEAR(RangeOfFirst("mm.bag", 0.001), 250.0f, 0.2f);
}

TEST_F(ImportOfFiles, AUnitIsNotTakenTwiceWhereTheFileKnowsItsOwn) {
  Write("scan000.3d", "0 0 400\n10 0 400\n0 10 400\n");  // centimetres
  EXPECT_NEAR(RangeOfFirst("scan000.3d", 0.01), 4.0f, 0.01f);
}

TEST_F(ImportOfFiles, SeveralCloudsBecomeSeveralScansWithTheirOwnImages) {
  WriteTurns("a.bin");
  WriteTurns("b.bin");
  Write("calib.txt", kKitti);
  ASSERT_TRUE(WritePng(folder_ / "b_left.png", ColorImage(120, 40, {1, 2, 3})));
  ASSERT_TRUE(
      Import({folder_ / "a.bin", folder_ / "b.bin", folder_ / "b_left.png", folder_ / "calib.txt"},
             target_));
  EXPECT_TRUE(ScanOf(target_, 1).frames.empty());
  EXPECT_EQ(ScanOf(target_, 2).frames.size(), 1u);
}

TEST_F(ImportOfFiles, AViewMakesADepthMapOfTheCloudAlone) {
  WriteTurns("a.bin");
  ImportOptions options;
  options.view = BlankView{20.0 * kDegree, 0.0, 60.0 * kDegree, 64, 48};
  ASSERT_TRUE(Import({folder_ / "a.bin"}, target_, options));
  const Scan scan = ScanOf(target_);
  ASSERT_EQ(scan.frames.size(), 1u);
  // The view's middle looks 20 deg to the left.
  const auto ray = scan.rig.camera.Unproject({31.5, 23.5});
  const Eigen::Vector3d in_robot =
      scan.rig.robot_from_base.Rotate(scan.rig.CameraFromBase(0.0).Inverse().Rotate(*ray));
  EXPECT_NEAR(std::atan2(in_robot.y(), in_robot.x()), 20.0 * kDegree, 1e-6);
  const auto depth = ComputeDepthInFrame(RegisterScan(scan, {}).value(), scan.rig, scan.frames[0],
                                         DefaultsOf(DepthMethod::kForesight), {});
  EXPECT_TRUE(depth) << depth.error().message;
}

TEST_F(ImportOfFiles, BadInputOfEveryKindIsRefusedInOneLineThatNamesIt) {
  WriteTurns("a.bin");
  WriteTurns("b.bin");
  Write("short.bin", "12345");
  Write("empty.ply", "");
  Write("no.bag", "hello");
  Write("torn.bag", "#ROSBAG V2.0\n" + std::string(200, 'x'));
  Write("calib.txt", kKitti);
  Write("bad_calib.txt", "P2: 1 2 3\n");
  Write("odd_calib.txt", "Q0: 1 2 3\n");
  Write("bad.yaml", "foresight_rig: 1\n");
  ASSERT_TRUE(WritePng(folder_ / "small.png", ColorImage(10, 10, {1, 2, 3})));
  ASSERT_TRUE(WritePng(folder_ / "a.png", ColorImage(120, 40, {1, 2, 3})));
  fs::create_directories(folder_ / "nothing");
  fs::create_directories(folder_ / "no_record");
  ASSERT_TRUE(WriteFileAtomically(folder_ / "no_record/cloud.ply", "ply\n"));
  const auto in = [&](const char* name) { return fs::path(folder_ / name); };
  EXPECT_THAT(Why({in("missing.bin")}), HasSubstr("missing.bin"));
  EXPECT_THAT(Why({in("short.bin")}), HasSubstr("short.bin: 5 bytes are no points"));
  EXPECT_THAT(Why({in("empty.ply")}), HasSubstr("empty.ply: is empty"));
  EXPECT_THAT(Why({in("no.bag")}), HasSubstr("no.bag: is no ROS bag"));
  EXPECT_THAT(Why({in("torn.bag")}), HasSubstr("torn.bag: "));
  EXPECT_THAT(Why({in("calib.txt")}), HasSubstr("no cloud among the files"));
  EXPECT_THAT(Why({in("a.bin"), in("bad_calib.txt")}), HasSubstr("bad_calib.txt: P2 has 3"));
  EXPECT_THAT(Why({in("a.bin"), in("bad.yaml")}), HasSubstr("bad.yaml"));
  EXPECT_THAT(Why({in("a.bin"), in("a.png")}), HasSubstr("an image needs its camera"));
  EXPECT_THAT(Why({in("a.bin"), in("calib.txt"), in("a.png"), in("small.png")}),
              HasSubstr("image 1 is 10 x 10, but its camera 120 x 40"));
  EXPECT_THAT(Why({in("a.bin"), in("b.bin"), in("small.png"), in("calib.txt")}),
              AllOf(HasSubstr("small.png: by its name it belongs to none of the clouds "),
                    HasSubstr("a.bin and "), HasSubstr("b.bin; import them one by one")));
  EXPECT_THAT(Why({in("a.bin"), in("a.png"), in("odd_calib.txt")}),
              HasSubstr("odd_calib.txt: is neither points nor a calibration of KITTI"));
  EXPECT_THAT(Why({in("nothing")}), HasSubstr("nothing: holds no cloud.ply"));
  EXPECT_THAT(Why({in("no_record")}), HasSubstr("no_record: is no exported scan"));
  ImportOptions up;
  up.up.setZero();
  EXPECT_THAT(Why({in("a.bin")}, up), HasSubstr("is no direction"));
  ImportOptions frame;
  frame.frame = CloudFrame::kLidar;
  EXPECT_THAT(Why({in("a.bin")}, frame), HasSubstr("needs a rig"));
}

TEST_F(ImportOfFiles, NothingIsWrittenOver) {
  WriteTurns("a.bin");
  Write("m.foresight", "somebody's");
  const auto report = Import({folder_ / "a.bin"}, target_);
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("is there already"));
  EXPECT_EQ(ReadFile(target_).value(), "somebody's");
}

TEST_F(ImportOfFiles, CanBeCancelled) {
  WriteTurns("a.bin");
  std::stop_source stop;
  stop.request_stop();
  const std::vector<fs::path> sources = {folder_ / "a.bin"};
  const auto report = ImportMission(sources, target_, {}, {.stop = stop.get_token()});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
  EXPECT_FALSE(fs::exists(target_));
}

}  // namespace
}  // namespace foresight
