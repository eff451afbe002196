#include "app/ctl/fit_arguments.h"

#include "core/depth/depth_method.h"
#include "core/detection/fit_option_table.h"

namespace foresight {
namespace {

/// The word for the dense map of `--method`, from when there was one.
constexpr const char* kDepthAlias = "depth";

/// The options that are added from now on stand below this heading of the help.
void BeginGroup(CLI::App& command, const std::string& heading) {
  command.option_defaults()->group(heading);
}

void AddRegionArguments(CLI::App& command, RegionArguments& region) {
  BeginGroup(command, "Region, one of; with --cloud: none is the whole cloud");
  command.add_option("--roi", region.rectangle, "Rectangle: left,top,right,bottom in pixels")
      ->expected(4)
      ->delimiter(',');
  command.add_option("--polygon", region.polygon, "Polygon: x,y,x,y,x,y,... in pixels")
      ->expected(6, 2000)
      ->delimiter(',');
  command
      .add_option("--two-clicks", region.two_clicks,
                  "Two points on opposite sides of the object: x,y,x,y in pixels")
      ->expected(4)
      ->delimiter(',');
  command
      .add_option("--box", region.box,
                  "Box in the robot's frame, or with --cloud in the cloud's: middle x,y,z and "
                  "size x,y,z in metres")
      ->expected(6)
      ->delimiter(',');
}

void AddSourceArgument(CLI::App& command, FitArguments& arguments) {
  std::vector<std::string> names = SourceNames();
  names.push_back(kDepthAlias);
  for (std::size_t i = names.size(); i-- > 1;)
    names.push_back(names[i] + std::string(kAloneSuffix));
  command
      .add_option(
          "--source", arguments.source,
          "What to fit to: raw (lidar returns), or the depth map of a method, together with "
          "the returns behind it or, with -alone after its name, without them")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
}

void AddAnswerArguments(CLI::App& command, FitArguments& arguments) {
  BeginGroup(command, "Answer");
  command.add_flag("--json", arguments.json, "Print the answer as JSON");
  command.add_option("--picture", arguments.picture, "Draw the answer into this PNG");
  command.add_flag("--save", arguments.save, "Write the answer into the mission file");
  command.add_option("--gallery", arguments.gallery,
                     "Fit to every source and set the answers side by side in this folder");
}

void AddFileArguments(CLI::App& command, FitArguments& arguments) {
  BeginGroup(command, "Instead of a mission");
  command.add_option("--depth", arguments.depth_file,
                     "Depth map: PFM, or PNG of 16 bits, in millimetres along the camera's axis");
  command
      .add_option("--density", arguments.density,
                  "With --depth: fraction of its pixels with a measurement of their own")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  command.add_option("--cloud", arguments.cloud_file,
                     "Point cloud, in metres or as --unit says: PLY, PCD, .bin of four floats a "
                     "point, or text. Regions and robot_from_object of the answer are in the "
                     "cloud's own frame");
  command
      .add_option("--unit", arguments.unit,
                  "With --cloud: unit of the file's coordinates: m, cm, mm (3DTK's are in cm); "
                  "all else is in metres")
      ->capture_default_str();
  command
      .add_option("--viewpoint", arguments.viewpoint,
                  "With --cloud: where it was seen from, x,y,z in metres")
      ->expected(3)
      ->delimiter(',');
  command
      .add_option("--up", arguments.up,
                  "With --cloud: which way is up in its frame, x,y,z; default: z is up")
      ->expected(3)
      ->delimiter(',');
  command
      .add_option("--noise-mm", arguments.noise_mm,
                  "With --cloud: standard deviation of its ranges; default: measured in the region")
      ->check(CLI::Range(0.1, 200.0));
  command.add_option("--rig", arguments.rig,
                     "Calibration of the head whose camera took the image (YAML)");
}

}  // namespace

std::vector<std::string> SourceNames() {
  std::vector<std::string> names = {"raw"};
  for (const DepthMethodInfo& method : DepthMethods()) names.emplace_back(method.name);
  return names;
}

void AddFitArguments(CLI::App& command, FitArguments& arguments) {
  arguments.command = &command;
  constexpr bool kHasDepth = true;  // a scan's map is computed where it is wanted
  if (UsualSourceFor(arguments.kind, kHasDepth) == FitSource::kDepth)
    arguments.source = kDepthAlias;
  // As the help lists them: first what every fit needs.
  AddScanArguments(command, arguments.scan, NeedMission::kNo);
  AddSourceArgument(command, arguments);
  AddRegionArguments(command, arguments.region);
  AddAnswerArguments(command, arguments);
  AddFileArguments(command, arguments);
  BeginGroup(command, "In a scan that a head keeps");
  CLI::Option* head = AddLinkOptions(command, arguments.link);
  command
      .add_option("--head-scan", arguments.head_scan,
                  "With --head: the scan that the head fits in, by its id or how that begins; "
                  "default: the newest")
      ->needs(head);
  BeginGroup(command,
             fmt::format("What a {} may be, and the search for it", ToString(arguments.kind)));
  AddOptionFlags(command, FitOptionTable(arguments.kind), arguments.given);
  AddDepthArguments(command, arguments.depth);
}

namespace {

/// Options of another kind of subject, or of another source: they would change nothing, and nobody
/// would know.
Status RefuseGiven(const FitArguments& a, std::initializer_list<const char*> options,
                   const char* why) {
  for (const char* option : options)
    if (a.command->count(option) > 0) return Fail(ErrorCode::kInvalidOptions, "{} {}", option, why);
  return {};
}

Status RefuseDepthOptions(const FitArguments& a, const char* why) {
  for (const std::string& option : DepthOptionNames())
    FORESIGHT_CHECK(RefuseGiven(a, {option.c_str()}, why));
  return {};
}

Status CheckForScan(const FitArguments& a) {
  FORESIGHT_CHECK(RefuseGiven(a, {"--viewpoint", "--up", "--noise-mm", "--unit"},
                              "goes with --cloud, not with a mission"));
  FORESIGHT_CHECK(RefuseGiven(a, {"--density"}, "goes with --depth, not with a mission"));
  FORESIGHT_CHECK(
      RefuseGiven(a, {"--rig"}, "is not for a mission: its scans have their own calibration"));
  if (!a.gallery.empty()) return RefuseGiven(a, {"--method"}, "is not for --gallery: it tries all");
  if (a.source == "raw")
    return RefuseDepthOptions(a, "goes with a depth map; the fit is to raw: give --source depth");
  if (!a.source.starts_with(kDepthAlias))
    return RefuseGiven(a, {"--method"}, "goes with --source depth; --source names a method itself");
  return {};
}

Status CheckForHead(const FitArguments& a) {
  FORESIGHT_CHECK(RefuseGiven(a, {"--scan"}, "is of a mission; --head-scan is of a head"));
  FORESIGHT_CHECK(RefuseGiven(a, {"--picture"}, "needs the image here: foresightctl fetch"));
  return CheckForScan(a);
}

Status CheckForDepthMap(const FitArguments& a) {
  FORESIGHT_CHECK(RefuseGiven(a, {"--scan", "--source"}, "goes with a mission, not with --depth"));
  FORESIGHT_CHECK(RefuseDepthOptions(a, "goes with a mission: the map of --depth is made already"));
  return RefuseGiven(a, {"--viewpoint", "--up", "--noise-mm", "--unit"},
                     "goes with --cloud, not with --depth");
}

Status CheckForCloud(const FitArguments& a) {
  FORESIGHT_CHECK(RefuseGiven(a, {"--scan", "--source"}, "goes with a mission, not with --cloud"));
  FORESIGHT_CHECK(RefuseDepthOptions(a, "goes with a mission, not with --cloud"));
  FORESIGHT_CHECK(RefuseGiven(a, {"--density"}, "goes with --depth, not with --cloud"));
  if (!a.rig.empty())
    return RefuseGiven(a, {"--up"},
                       "is not for a cloud with --rig, which says how the head stands");
  return RefuseGiven(a, {"--image"}, "needs the camera's calibration: --rig");
}

}  // namespace

Status CheckFitArguments(const FitArguments& a) {
  const int subjects = int(!a.scan.mission.empty()) + int(!a.depth_file.empty()) +
                       int(!a.cloud_file.empty()) + int(!a.link.head.empty());
  if (subjects != 1)
    return Fail(ErrorCode::kInvalidOptions,
                "give one of: a mission file, --depth, --cloud, --head");
  const RegionArguments& r = a.region;
  const int regions = int(!r.rectangle.empty()) + int(!r.polygon.empty()) +
                      int(!r.two_clicks.empty()) + int(!r.box.empty());
  if (regions > 1 || (regions == 0 && a.cloud_file.empty()))
    return Fail(ErrorCode::kInvalidOptions,
                "give one region: --roi, --polygon, --two-clicks or --box");
  if (!a.depth_file.empty() && a.rig.empty())
    return Fail(ErrorCode::kInvalidOptions, "--depth needs the camera's calibration: --rig");
  if (!a.cloud_file.empty() && a.viewpoint.empty())
    return Fail(ErrorCode::kInvalidOptions, "--cloud needs where it was seen from: --viewpoint");
  if (!a.cloud_file.empty() && regions == 1 && r.box.empty() && a.rig.empty())
    return Fail(ErrorCode::kInvalidOptions,
                "a region in an image of a cloud needs the camera's calibration: --rig");
  if (a.scan.mission.empty() && (a.save || !a.gallery.empty()))
    return Fail(ErrorCode::kInvalidOptions, "--save and --gallery need a mission file");
  if (!a.scan.mission.empty()) return CheckForScan(a);
  if (!a.link.head.empty()) return CheckForHead(a);
  return a.depth_file.empty() ? CheckForCloud(a) : CheckForDepthMap(a);
}

Result<Roi> RegionFrom(const RegionArguments& arguments, double motor_rad,
                       const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Roi roi;
  if (const auto& r = arguments.rectangle; !r.empty())
    roi = ImageRoi::Rectangle(motor_rad, {r[0], r[1]}, {r[2], r[3]});
  if (const auto& c = arguments.two_clicks; !c.empty())
    roi = ImageRoi::AroundTwoClicks(motor_rad, {c[0], c[1]}, {c[2], c[3]});
  if (const auto& p = arguments.polygon; !p.empty()) {
    if (p.size() % 2 != 0)
      return Fail(ErrorCode::kInvalidOptions, "--polygon: {} numbers are no x,y pairs", p.size());
    ImageRoi image{motor_rad, {}};
    for (std::size_t i = 0; i < p.size(); i += 2) image.polygon.emplace_back(p[i], p[i + 1]);
    roi = image;
  }
  if (const auto& b = arguments.box; !b.empty()) {
    const Rigid<frame::Robot, frame::Object> robot_from_box(Eigen::Quaterniond::Identity(),
                                                            {b[0], b[1], b[2]});
    roi = BoxRoi{robot_from_base.Inverse() * robot_from_box, {b[3], b[4], b[5]}};
  }
  const Status sound = CheckRoi(roi);
  if (!sound) return Fail(ErrorCode::kInvalidOptions, "{}", sound.error().message);
  return roi;
}

Eigen::Vector3d UpOf(const FitArguments& arguments) {
  if (arguments.cloud_file.empty() || !arguments.rig.empty()) return Eigen::Vector3d::UnitZ();
  return Eigen::Vector3d(arguments.up.data()).normalized();
}

std::optional<Eigen::Vector3d> UpOfCloud(const FitArguments& arguments) {
  const Eigen::Vector3d up = UpOf(arguments);
  constexpr double kSame = 1e-6;
  if ((up - Eigen::Vector3d::UnitZ()).norm() < kSame) return std::nullopt;
  return up;
}

Result<FitOptions> FitOptionsFrom(const FitArguments& arguments,
                                  const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  FitOptions options = FitOptionsFor(arguments.kind, robot_from_base, UpOf(arguments));
  FORESIGHT_CHECK(ApplyFlags(FitOptionTable(arguments.kind), arguments.given,
                             fmt::format("a {}'s fit", ToString(arguments.kind)), options));
  const Status sound = std::visit([](const auto& held) { return held.Check(); }, options);
  if (!sound) return tl::unexpected(sound.error());
  return options;
}

}  // namespace foresight
