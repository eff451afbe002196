#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/late/late_command.h"
#include "core/exchange/import_mission.h"
#include "core/geometry/angles.h"
#include "core/io/cloud_table.h"

namespace foresight {
namespace {

struct ImportArguments {
  std::vector<std::string> files;
  std::string out;
  std::string rig;
  std::string frame;
  std::vector<double> viewpoint;
  std::vector<double> up = {0.0, 0.0, 1.0};
  std::string unit = "m";
  std::vector<double> image_deg;
  std::vector<double> view;
  int kitti_camera = 2;
  std::string cloud_topic;
  std::string image_topic;
  std::vector<int> clouds;
  bool json = false;
};

Result<ImportOptions> OptionsFrom(const ImportArguments& arguments) {
  ImportOptions options;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(options.rig, LoadSensorRig(arguments.rig));
  }
  if (!arguments.frame.empty()) {
    FORESIGHT_TRY(options.frame, CloudFrameFromText(arguments.frame));
  }
  if (!arguments.viewpoint.empty()) options.viewpoint = Eigen::Vector3d(arguments.viewpoint.data());
  options.up = Eigen::Vector3d(arguments.up.data());
  FORESIGHT_TRY(options.unit_m, MetresIn(arguments.unit));
  for (const double angle : arguments.image_deg)
    options.image_angles_rad.push_back(RadiansFromDegrees(angle));
  if (!arguments.view.empty()) {
    BlankView view;
    view.azimuth_rad = RadiansFromDegrees(arguments.view[0]);
    view.elevation_rad = RadiansFromDegrees(arguments.view[1]);
    view.field_rad = RadiansFromDegrees(arguments.view[2]);
    options.view = view;
  }
  options.kitti_camera = arguments.kitti_camera;
  options.cloud_topic = arguments.cloud_topic;
  options.image_topic = arguments.image_topic;
  options.clouds = arguments.clouds;
  return options;
}

nlohmann::ordered_json ToJson(const ImportReport::Entry& scan) {
  return {{"scan", scan.scan_id},
          {"uuid", scan.uuid},
          {"of_scan_uuid", scan.of_scan_uuid.empty() ? nlohmann::ordered_json(nullptr)
                                                     : nlohmann::ordered_json(scan.of_scan_uuid)},
          {"source", scan.source},
          {"points", scan.points},
          {"lines", scan.lines},
          {"beams", scan.beams},
          {"images", scan.images},
          {"grid", scan.grid},
          {"notes", scan.notes}};
}

void Print(const ImportArguments& arguments, const ImportReport& report) {
  for (const ImportReport::Entry& scan : report.scans)
    for (const std::string& note : scan.notes) PrintNote("scan {}: {}", scan.scan_id, note);
  if (arguments.json) {
    auto scans = nlohmann::ordered_json::array();
    for (const ImportReport::Entry& scan : report.scans) scans.push_back(ToJson(scan));
    PrintJson({{"mission", arguments.out}, {"scans", scans}});
    return;
  }
  std::string text;
  for (const ImportReport::Entry& scan : report.scans)
    text += fmt::format("scan {}: {}: {} points, {} lines of {} beams, {}; grid: {}\n",
                        scan.scan_id, scan.source, scan.points, scan.lines, scan.beams,
                        scan.images == 1 ? "1 image" : fmt::format("{} images", scan.images),
                        scan.grid);
  PrintLine(text + fmt::format("{}: {}", arguments.out,
                               report.scans.size() == 1
                                   ? "1 scan"
                                   : fmt::format("{} scans", report.scans.size())));
}

Result<ExitCode> Import(const ImportArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const ImportOptions options, OptionsFrom(arguments));
  const std::vector<std::filesystem::path> files(arguments.files.begin(), arguments.files.end());
  FORESIGHT_TRY(const ImportReport report, ImportMission(files, arguments.out, options, context));
  Print(arguments, report);
  return ExitCode::kDone;
}

}  // namespace

extern "C" void AddMissionImportOptions(CLI::App* command, Invocation* invocation) {
  const auto arguments = std::make_shared<ImportArguments>();
  command
      ->add_option("files", arguments->files,
                   "Clouds (.ply, .pcd, KITTI's .bin, .xyz, .txt, .csv, .3d), ROS 1 bags, folders "
                   "of an export; beside them images, a rig (.yaml), a calibration of KITTI (.txt)")
      ->required();
  command->add_option("-o,--out", arguments->out, "The new mission file")->required();
  command->add_option("--rig", arguments->rig, "Rig that the files were taken with");
  command->add_option("--frame", arguments->frame,
                      "Frame of the points: robot (default), or base, lidar, camera of the rig");
  command
      ->add_option("--viewpoint", arguments->viewpoint,
                   "x,y,z: where the points were measured from, in their frame, metres")
      ->delimiter(',')
      ->expected(3);
  AddOption(*command, "--up", arguments->up,
            "x,y,z: what is up in the points' frame; without a rig")
      ->delimiter(',')
      ->expected(3);
  AddOption(*command, "--unit", arguments->unit, "Unit of the coordinates: m, cm, mm");
  command
      ->add_option("--image-deg", arguments->image_deg,
                   "The motor's angle of each image, in their order")
      ->delimiter(',');
  command
      ->add_option("--view", arguments->view,
                   "azimuth,elevation,field: a grey image of 640 x 480 seen from the viewpoint, in "
                   "degrees, for clouds without an image")
      ->delimiter(',')
      ->expected(3);
  AddOption(*command, "--kitti-camera", arguments->kitti_camera, "P0 to P3 of KITTI's calibration");
  command->add_option("--cloud-topic", arguments->cloud_topic, "Topic of a bag's clouds");
  command->add_option("--image-topic", arguments->image_topic, "Topic of a bag's images");
  command->add_option("--clouds", arguments->clouds, "Only these clouds of a bag, from 1")
      ->delimiter(',');
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([invocation, arguments] {
    *invocation = [arguments](const RunContext& context) { return Import(*arguments, context); };
  });
}

}  // namespace foresight
