// Other programs' readers judge what is exported: PCL, VTK, ROS's own bag library.
#include "core/exchange/export_mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkGLTFReader.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/depth/depth_method.h"
#include "core/detection/candidates.h"
#include "core/detection/detection_json.h"
#include "core/exchange/import_mission.h"
#include "core/exchange/paint_cloud.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "core/mission/new_records.h"
#include "core/registration/export_cloud.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/synthetic_scan.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A mission with a scan of a valve, which was fitted and accepted; exported once with everything.
class ExportMissionTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    mission_ = MissionFile::Create(*folder_ / "m.foresight").value();
    scan_ = WallAndValveScan({.from_rad = -0.20, .to_rad = 0.20, .speed_rad_s = 0.15});
    const std::int64_t id = mission_->BeginScan(scan_).value();
    for (const LidarLine& line : scan_.lines) ASSERT_TRUE(mission_->AppendLine(id, line));
    ASSERT_TRUE(mission_->AppendMotorSamples(id, scan_.track.samples()));
    for (const CameraFrame& frame : scan_.frames) ASSERT_TRUE(mission_->AppendFrame(id, frame));
    ASSERT_TRUE(mission_->EndScan(id, ScanState::kComplete, ""));
    scan_ = mission_->LoadScan(id).value();
    cloud_ = RegisterScan(scan_, {}).value();
    AddValve(id);
    mission_
        ->AddEvent({0, 1795352793250000000, "operator", "info", "said \"go\", then\nwaited", ""})
        .value();
    options_.depth = DefaultsOf(DepthMethod::kForesight);
    depth_ = ComputeDepthInFrame(cloud_, scan_.rig, scan_.frames[0], options_.depth, {}).value();
    report_ = Export("out").value();
  }
  static void TearDownTestSuite() {
    mission_.reset();
    folder_.reset();
  }

  static void AddValve(std::int64_t scan_id) {
    const auto center =
        scan_.rig.camera.Project(scan_.rig.CameraFromBase(scan_.frames[0].motor_angle_rad) *
                                 SyntheticValvePose().translation());
    const Roi roi =
        ImageRoi::Rectangle(scan_.frames[0].motor_angle_rad, *center - Eigen::Vector2d(50, 50),
                            *center + Eigen::Vector2d(50, 50));
    const FitOptions options = FitOptionsFor(ObjectKind::kValve, scan_.rig.robot_from_base);
    const Detection found =
        FitInScan({scan_.rig, cloud_, scan_.frames}, FitSource::kRaw, roi, options, {}).value();
    DetectionRecord record = NewDetectionRecord(
        scan_, found, ProvenanceOfFit(scan_, FitSource::kRaw, nullptr, {}, options, roi).value());
    record.scan_id = scan_id;
    record.utc_ns = 1795352793250000000;
    const std::int64_t valve = mission_->AddDetection(record).value();
    ASSERT_TRUE(mission_->AddDetectionEvent(
        valve, {1795352794250000000, "operator", DetectionEvent::Action::kAccepted, ""}));
  }

  static Result<MissionExportReport> Export(const std::string& name) {
    return ExportMission(*mission_, *folder_ / name, options_, {});
  }

  static std::filesystem::path Out(const std::string& file) { return *folder_ / "out" / file; }
  static std::filesystem::path OfScan(const std::string& file) {
    return *folder_ / "out" / "scan-0001" / file;
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::unique_ptr<MissionFile> mission_;
  static inline Scan scan_;
  static inline RegisteredScan cloud_;
  static inline DepthResult depth_;
  static inline MissionExportOptions options_;
  static inline MissionExportReport report_;
};

TEST_F(ExportMissionTest, EveryPartIsThereAndNothingIsLeftOver) {
  EXPECT_THAT(report_.left_out, testing::IsEmpty());
  std::vector<std::filesystem::path> there;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder_ / "out"))
    if (entry.is_regular_file())
      there.push_back(std::filesystem::relative(entry.path(), *folder_ / "out"));
  EXPECT_THAT(there, testing::UnorderedElementsAreArray(report_.files));
  EXPECT_EQ(there.size(), 4u + 1u + 1u + 5u + 4u + 3u + 5u)
      << "tables, bag, image, rig and cameras, clouds with scan.json, surfaces, depth";
}

TEST_F(ExportMissionTest, ExportingAgainGivesTheSameBytes) {
  const MissionExportReport again = Export("again").value();
  ASSERT_EQ(again.files, report_.files);
  for (const std::filesystem::path& file : report_.files)
    EXPECT_TRUE(ReadFile(*folder_ / "again" / file).value() == ReadFile(Out(file)).value()) << file;
}

/// x, y, z, line, beam, rgb, confidence: of PCL's reader.
struct PclPoint {
  PCL_ADD_POINT4D;
  float intensity;
  std::int32_t line;
  std::int32_t beam;
  double time;
  float rgb;
  float confidence;
};

}  // namespace
}  // namespace foresight

POINT_CLOUD_REGISTER_POINT_STRUCT(
    foresight::PclPoint,
    (float, x, x)(float, y, y)(float, z, z)(float, intensity, intensity)(std::int32_t, line, line)(
        std::int32_t, beam, beam)(double, time, time)(float, rgb, rgb)(float, confidence,
                                                                       confidence))

namespace foresight {
namespace {

TEST_F(ExportMissionTest, PclReadsTheCloudWithEveryField) {
  const std::vector<CloudPoint> truth = PointsInRobot(cloud_, scan_);
  pcl::PointCloud<PclPoint> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(OfScan("cloud.pcd").string(), cloud), 0);
  ASSERT_EQ(cloud.size(), truth.size());
  std::size_t painted = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_EQ(cloud[i].x, truth[i].x);
    ASSERT_EQ(cloud[i].z, truth[i].z);
    ASSERT_EQ(cloud[i].line, truth[i].line);
    ASSERT_EQ(cloud[i].beam, truth[i].beam);
    ASSERT_EQ(cloud[i].time, truth[i].time_s);
    painted += std::isnan(cloud[i].confidence) ? 0 : 1;
  }
  EXPECT_EQ(painted, depth_.samples.KeptCount()) << "what the camera sees is painted";
  pcl::PCLPointCloud2 ply;
  ASSERT_EQ(pcl::io::loadPLYFile(OfScan("cloud.ply").string(), ply), 0);
  EXPECT_EQ(ply.width * ply.height, truth.size());
}

TEST_F(ExportMissionTest, VtkReadsPointsDepthAndSurfaces) {
  vtkNew<vtkXMLPolyDataReader> points;
  points->SetFileName(OfScan("cloud.vtp").c_str());
  points->Update();
  const std::vector<CloudPoint> truth = PointsInRobot(cloud_, scan_);
  ASSERT_EQ(points->GetOutput()->GetNumberOfPoints(), static_cast<vtkIdType>(truth.size()));
  EXPECT_EQ(points->GetOutput()->GetPointData()->GetArray("line")->GetTuple1(100), truth[100].line);
  EXPECT_EQ(points->GetOutput()->GetPointData()->GetArray("time")->GetTuple1(100),
            truth[100].time_s);

  vtkNew<vtkXMLImageDataReader> image;
  image->SetFileName(OfScan("depth-0.vti").c_str());
  image->Update();
  const int width = depth_.dense.depth_m.width(), height = depth_.dense.depth_m.height();
  ASSERT_EQ(image->GetOutput()->GetNumberOfPoints(), static_cast<vtkIdType>(width) * height);
  vtkDataArray* depths = image->GetOutput()->GetPointData()->GetArray("depth_m");
  int compared = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (std::isnan(depth_.dense.depth_m(x, y))) continue;
      ASSERT_EQ(depths->GetTuple1(static_cast<vtkIdType>(height - 1 - y) * width + x),
                depth_.dense.depth_m(x, y));
      ++compared;
    }
  EXPECT_GT(compared, width * height / 5);

  vtkNew<vtkPLYReader> ply;
  ply->SetFileName(OfScan("surface.ply").c_str());
  ply->Update();
  vtkNew<vtkOBJReader> obj;
  obj->SetFileName(OfScan("surface.obj").c_str());
  obj->Update();
  EXPECT_GT(ply->GetOutput()->GetNumberOfPolys(), 10000);
  EXPECT_EQ(obj->GetOutput()->GetNumberOfPolys(), ply->GetOutput()->GetNumberOfPolys());
  EXPECT_EQ(ply->GetOutput()->GetNumberOfPoints(), static_cast<vtkIdType>(truth.size()));
}

TEST_F(ExportMissionTest, TheGltfIsOneFileWithItsData) {
  const auto gltf = nlohmann::json::parse(ReadFile(OfScan("surface.gltf")).value());
  EXPECT_EQ(gltf.at("asset").at("version"), "2.0");
  EXPECT_FALSE(gltf.at("meshes").empty());
  for (const auto& buffer : gltf.at("buffers"))
    EXPECT_THAT(buffer.at("uri").get<std::string>(), testing::StartsWith("data:"));
}

TEST_F(ExportMissionTest, TheGltfHasTheColoursOfTheImage) {
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(OfScan("surface.gltf").c_str());
  reader->Update();
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(reader->GetOutput()->NewIterator());
  auto* surface = vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject());
  ASSERT_NE(surface, nullptr);
  vtkDataArray* colors = surface->GetPointData()->GetArray("COLOR_0");
  ASSERT_NE(colors, nullptr);
  std::vector<CloudPoint> points = PointsInRobot(cloud_, scan_);
  ASSERT_EQ(colors->GetNumberOfTuples(), static_cast<vtkIdType>(points.size()));
  PaintCloud(points, scan_.frames[0], depth_);
  // The reader gives what is kept in 16 bits as 0 to 1. IEC 61966-2-1 takes it back to sRGB.
  const auto srgb = [](double c) {
    return 255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055);
  };
  int painted = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool seen = !std::isnan(points[i].confidence);
    painted += seen ? 1 : 0;
    const Rgb8 expected = seen ? points[i].color : Rgb8{128, 128, 128};
    const double* linear = colors->GetTuple(static_cast<vtkIdType>(i));
    ASSERT_NEAR(srgb(linear[0]), expected.r, 0.1) << i;
    ASSERT_NEAR(srgb(linear[1]), expected.g, 0.1) << i;
    ASSERT_NEAR(srgb(linear[2]), expected.b, 0.1) << i;
  }
  EXPECT_GT(painted, 10'000);
}

TEST_F(ExportMissionTest, AnImportKeepsItsPosesAsNotesAndNothingThatCouldBeSent) {
  const std::vector<std::filesystem::path> bag = {Out("mission.bag")};
  const auto report = ImportMission(bag, *folder_ / "back.foresight", {}, {});
  ASSERT_TRUE(report) << report.error().message;
  const auto back = MissionFile::OpenReadOnly(*folder_ / "back.foresight").value();
  EXPECT_THAT(back->ListDetections().value(), testing::IsEmpty());
  const std::vector<NoteRecord> notes = back->ListNotes().value();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].kind, kNoteKind);
  EXPECT_EQ(notes[0].scan_uuid, report->scans[0].uuid);
  EXPECT_EQ(notes[0].author, "import");
  EXPECT_EQ(notes[0].utc_ns, 1795352793250000000);
  const std::string kept = mission_->ListDetections().value()[0].json;
  const Detection valve = DetectionFromJson(kept).value();
  const auto pose = scan_.rig.robot_from_base * CandidatePose(valve, 0);
  const Eigen::Vector3d& t = pose.translation();
  const Eigen::Quaterniond& q = pose.rotation();
  EXPECT_EQ(notes[0].text,
            fmt::format("/foresight/objects/valve: a pose in 'robot', position ({}, {}, {}) m, "
                        "quaternion (w, x, y, z) ({}, {}, {}, {})",
                        t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()))
      << "to the last digit";
}

TEST_F(ExportMissionTest, DepthIsInMillimetres) {
  const FloatImage pfm = ReadPfm(OfScan("depth-0.pfm")).value();
  const auto png = ReadPng16(OfScan("depth-0.png")).value();
  ASSERT_TRUE(pfm.SameSize(depth_.dense.depth_m));
  ASSERT_TRUE(png.SameSize(depth_.dense.depth_m));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < png.size(); ++i) {
    const float depth_m = depth_.dense.depth_m.values()[i];
    const bool masked = depth_.mask.values()[i] == 0;
    if (!std::isnan(depth_m)) {
      ASSERT_EQ(pfm.values()[i], 1000.0f * depth_m);
    }
    ASSERT_NEAR(png.values()[i], masked ? 0.0 : 1000.0 * depth_m, 0.5);
    kept += png.values()[i] != 0 ? 1 : 0;
  }
  EXPECT_GT(kept, png.size() / 5);
  EXPECT_EQ(ReadPng(OfScan("image-0.png")).value(), scan_.frames[0].image);
}

/// What ROS's own Python reader finds in the bag, message by message.
nlohmann::json ReadBag(const std::filesystem::path& bag) {
  const ProgramResult read = RunProgram(
      "/usr/bin/python3", {FORESIGHT_SOURCE_DIR "/tests/core/exchange/read_bag.py", bag.string()});
  EXPECT_EQ(read.exit_code, 0) << read.errors;
  return nlohmann::json::parse(read.output);
}

Eigen::Isometry3d PoseOf(const nlohmann::json& pose) {
  const auto& t = pose.at("position");
  const auto& q = pose.at("rotation_wxyz");
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  isometry.rotate(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  return isometry;
}

TEST_F(ExportMissionTest, RosReadsTheBag) {
  std::map<std::string, int> messages;
  for (const auto& message : ReadBag(Out("mission.bag"))) {
    const std::string topic = message.at("topic");
    ++messages[topic];
    if (topic == "/foresight/cloud") {
      const CloudPoint truth = PointsInRobot(cloud_, scan_).at(100);
      EXPECT_EQ(message.at("frame"), "robot");
      EXPECT_EQ(message.at("points"), PointsInRobot(cloud_, scan_).size());
      const auto& point = message.at("point_100");
      EXPECT_EQ(point.at("x").get<float>(), truth.x);
      EXPECT_EQ(point.at("beam"), truth.beam);
      EXPECT_EQ(point.at("time").get<double>(), truth.time_s);
    } else if (topic == "/foresight/camera/image") {
      EXPECT_EQ(message.at("width"), scan_.frames[0].image.width());
      EXPECT_EQ(message.at("fourth_byte"), scan_.frames[0].image(1, 0).r);
    } else if (topic == "/foresight/camera/camera_info") {
      EXPECT_EQ(message.at("model"), "equidistant") << "the paper's k has no name in ROS";
      EXPECT_EQ(message.at("D").size(), 4u);
    } else if (topic == "/foresight/objects/valve") {
      const Eigen::Vector3d truth = scan_.rig.robot_from_base * SyntheticValvePose().translation();
      EXPECT_LT((PoseOf(message).translation() - truth).norm(), 0.01);
      EXPECT_EQ(message.at("time_ns"), 1795352793250000000);
    }
  }
  EXPECT_EQ(messages["/foresight/cloud"], 1);
  EXPECT_EQ(messages["/foresight/camera/image"], 1);
  EXPECT_EQ(messages["/foresight/camera/camera_info"], 1);
  EXPECT_EQ(messages["/foresight/objects/valve"], 1);
  EXPECT_EQ(messages["/foresight/scan"], 1);
  EXPECT_EQ(messages["/tf_static"], 1);
  EXPECT_GT(messages["/tf"], 10);
}

TEST_F(ExportMissionTest, TheChainOfTransformsLeadsFromTheRobotToTheCamera) {
  const nlohmann::json messages = ReadBag(Out("mission.bag"));
  const auto image = std::find_if(messages.begin(), messages.end(), [](const auto& message) {
    return message.at("topic") == "/foresight/camera/image";
  });
  std::map<std::string, Eigen::Isometry3d> parent_from;  // by child, at the time of the image
  for (const auto& message : messages) {
    if (!message.contains("transforms")) continue;
    if (message.at("topic") == "/tf" && message.at("time_ns") != image->at("time_ns")) continue;
    for (const auto& transform : message.at("transforms"))
      parent_from[transform.at("child")] = PoseOf(transform);
  }
  const Eigen::Isometry3d robot_from_camera =
      parent_from.at("base") * parent_from.at("head") * parent_from.at("camera");
  const Eigen::Vector3d valve = scan_.rig.robot_from_base * SyntheticValvePose().translation();
  const Eigen::Vector3d in_camera = scan_.rig.CameraFromBase(scan_.frames[0].motor_angle_rad) *
                                    SyntheticValvePose().translation();
  EXPECT_LT((robot_from_camera.inverse() * valve - in_camera).norm(), 1e-9);
}

TEST_F(ExportMissionTest, TablesQuoteWhatNeedsIt) {
  const std::string events = ReadFile(Out("events.csv")).value();
  EXPECT_EQ(events,
            "utc,source,severity,text,json\r\n"
            "2026-11-22T13:06:33.250Z,operator,info,\"said \"\"go\"\", then\nwaited\",\r\n");
  const std::string detections = ReadFile(Out("detections.csv")).value();
  EXPECT_THAT(detections, HasSubstr(",valve,"));
  EXPECT_THAT(detections, HasSubstr(",accepted,2026-11-22T13:06:34.250Z,operator,false,1,"));
  const std::string scans = ReadFile(Out("scans.csv")).value();
  EXPECT_THAT(scans, HasSubstr(scan_.uuid));
  EXPECT_THAT(scans, HasSubstr(",complete,"));
}

TEST_F(ExportMissionTest, AScanThatIsNotThereIsRefused) {
  MissionExportOptions options;
  options.scans = {7};
  const auto report = ExportMission(*mission_, *folder_ / "seven", options, {});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(report.error().message, HasSubstr("no scan 7"));
}

TEST_F(ExportMissionTest, ACancelledExportLeavesNoBag) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto report = ExportMission(*mission_, *folder_ / "cancelled", options_, context);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
  for (const auto& entry : std::filesystem::directory_iterator(*folder_ / "cancelled"))
    EXPECT_EQ(entry.path().extension(), ".csv") << entry.path();
}

TEST_F(ExportMissionTest, AFolderThatCannotBeMadeIsAnIoError) {
  std::ofstream(*folder_ / "a file") << "x";
  const auto report = ExportMission(*mission_, *folder_ / "a file", options_, {});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace foresight
