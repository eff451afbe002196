#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "app/common/connect_head.h"
#include "app/common/emulation.h"
#include "app/common/record_calibration.h"
#include "app/common/simulated_bench.h"
#include "app/common/wait_for_head.h"
#include "app/ctl/command.h"
#include "core/geometry/angles.h"
#include "hardware/assembly/real_head.h"
#include "hardware/link/client/remote_head.h"
#include "hardware/simulated/simulated_head.h"

namespace foresight {
namespace {

struct RecordArguments {
  std::string folder;
  EmulationArguments emulation;  ///< also of the head that is simulated in this process
  bool emulate = false;
  std::string head_config;  ///< of a real head, in place of a scene
  LinkArguments link;       ///< to a head elsewhere
  std::string prior;
  std::string name = "unnamed";
  std::string mount;
  std::string board;
  std::vector<int> places;
  std::string place_name;
  bool view = false;
  std::string stops_deg = "-30:10:80";
  int lines = StopPlan().lines;
  double sweep_deg_s = 50.0;
  std::optional<double> exposure_ms;  ///< not given: the head's
  bool json = false;
};

/// A head, what it is made of where it is made here, and the world whose stand is moved.
struct RecordingBench {
  std::shared_ptr<const World> world;  ///< nullptr: a real head
  std::unique_ptr<EmulatedDevices> emulated;
  CameraSettings exposure;
  std::shared_ptr<SensorHead> head;    ///< goes before what is above
  std::shared_ptr<MovingStand> stand;  ///< of a simulated head elsewhere; nullptr: it is carried
};

/// For a sweep over a link, until it is whole.
std::string SpoolBeside(const std::string& session) {
  return session + ".spool";
}

Result<RecordingBench> SetUp(const RecordArguments& arguments) {
  RecordingBench bench;
  if (!arguments.head_config.empty()) {
    FORESIGHT_TRY(const HeadConfig config, LoadHeadConfig(arguments.head_config));
    bench.exposure = config.exposure;
    bench.head = MakeRealHead(config);
  } else if (!arguments.link.head.empty()) {
    FORESIGHT_TRY(const auto remote, ConnectHead(arguments.link, HeadUse::kOperate, nullptr,
                                                 SpoolBeside(arguments.folder)));
    bench.head = remote;
    bench.stand = remote->Stand();
  } else if (arguments.emulate) {
    FORESIGHT_TRY(bench.emulated, StartEmulation(arguments.emulation));
    bench.world = bench.emulated->world();
    bench.head = MakeRealHead(ConfigFor(*bench.emulated));
  } else {
    FORESIGHT_TRY(SimulatedBench simulated, SetUpBench({.scene = arguments.emulation.scene,
                                                        .rig = arguments.emulation.rig,
                                                        .seed = arguments.emulation.seed}));
    bench.world = simulated.world;
    bench.head = std::move(simulated.head);
  }
  if (arguments.exposure_ms) bench.exposure.exposure_s = 1e-3 * *arguments.exposure_ms;
  return bench;
}

Status BadStops(const std::string& text) {
  return Fail(ErrorCode::kInvalidOptions,
              "--stops {}: expected FROM:STEP:TO in degrees, such as "
              "-30:10:80",
              text);
}

/// "-30:10:80"
Result<std::vector<double>> AnglesFrom(const std::string& text) {
  std::array<double, 3> value{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto read = std::from_chars(at, end, value[i]);
    const bool ends_well = i < 2 ? read.ptr != end && *read.ptr == ':' : read.ptr == end;
    if (read.ec != std::errc() || !ends_well) return tl::unexpected(BadStops(text).error());
    at = read.ptr + 1;
  }
  const auto [from, step, to] = value;
  if (!(step >= 0.5) || !(to >= from) || !(to - from <= 180.0))
    return tl::unexpected(BadStops(text).error());
  std::vector<double> angles;
  for (int i = 0; from + i * step <= to + 1e-6; ++i)
    angles.push_back(RadiansFromDegrees(from + i * step));
  return angles;
}

Result<PoseRecording> PoseFrom(const RecordArguments& arguments, const RecordingBench& bench) {
  PoseRecording pose;
  FORESIGHT_TRY(pose.stops.angles_rad, AnglesFrom(arguments.stops_deg));
  pose.stops.lines = arguments.lines;
  pose.stops.exposure_s = bench.exposure.exposure_s;
  pose.stops.gain_db = bench.exposure.gain_db;
  FORESIGHT_CHECK(pose.stops.Check());
  if (!(arguments.sweep_deg_s > 0.0)) return pose;
  ScanPlan sweep;
  sweep.from_rad = pose.stops.angles_rad.front();
  sweep.to_rad = pose.stops.angles_rad.back();
  sweep.speed_rad_s = RadiansFromDegrees(arguments.sweep_deg_s);
  sweep.passes = 2;
  sweep.image_angles_rad = {sweep.from_rad};  // a scan has one at least
  sweep.exposure_s = pose.stops.exposure_s;
  FORESIGHT_CHECK(sweep.Check());
  pose.sweep = sweep;
  return pose;
}

const BoardStand* StandOf(const RecordingBench& bench, bool two_boards) {
  if (!bench.world) return nullptr;
  for (const BoardStand& stand : bench.world->scene().stands)
    if (stand.b.has_value() == two_boards) return &stand;
  return nullptr;
}

/// The boards as they were asked for, or as the scene has them.
Result<BoardMount> MountFrom(const RecordArguments& arguments, const RecordingBench& bench) {
  if (arguments.mount.empty()) {
    if (const BoardStand* stand = StandOf(bench, true)) return stand->Mount();
    if (bench.stand) return bench.stand->Mount();
    return UsualBoardMount();
  }
  const std::size_t comma = arguments.mount.find(',');
  FORESIGHT_TRY(const CalibrationBoard a,
                CalibrationBoardFromText(arguments.mount.substr(0, comma)));
  if (comma == std::string::npos) return BoardMount{.a = a, .b = {}, .a_from_b = {}};
  FORESIGHT_TRY(const CalibrationBoard b,
                CalibrationBoardFromText(arguments.mount.substr(comma + 1)));
  return HingedMount(a, b, kHinge_m);
}

Result<SessionFolder> OpenFolder(const RecordArguments& arguments, const RecordingBench& bench) {
  if (IsCalibrationSession(arguments.folder)) return SessionFolder::Open(arguments.folder);
  SessionSetup setup;
  setup.name = arguments.name;
  FORESIGHT_TRY(setup.mount, MountFrom(arguments, bench));
  setup.intrinsic_board = setup.mount.a;
  if (const BoardStand* stand = StandOf(bench, false)) setup.intrinsic_board = stand->a.board;
  if (bench.stand && arguments.mount.empty()) setup.intrinsic_board = bench.stand->SingleBoard();
  if (!arguments.board.empty()) {
    FORESIGHT_TRY(setup.intrinsic_board, CalibrationBoardFromText(arguments.board));
  }
  setup.prior = bench.head->Rig();
  if (!arguments.prior.empty()) {
    FORESIGHT_TRY(setup.prior, LoadSensorRig(arguments.prior));
  }
  return SessionFolder::Create(arguments.folder, setup);
}

struct RecordTally {
  int poses = 0;
  int stops = 0;
  int images = 0;
  int sweeps = 0;
  int views = 0;
  std::vector<std::string> missing;
};

/// Captures what belongs to the boards that stand there.
Status RecordHere(const PoseRecording& pose, bool view, RecordingBench& bench,
                  SessionFolder& folder, RecordTally& tally, const RunContext& context) {
  if (view) {
    StopPlan stop = pose.stops;
    stop.angles_rad = {0.0};
    stop.lines = 0;
    const std::string origin = pose.name.empty() ? "head" : pose.name;
    FORESIGHT_CHECK(RecordIntrinsicView(*bench.head, stop, origin, folder, context));
    ++tally.views;
    PrintProgress(fmt::format("{}: image {} of the camera's board", origin,
                              folder.Index().intrinsic_views.size()),
                  ProgressEnd::kLast);
    return {};
  }
  FORESIGHT_TRY(const RecordedPose recorded, RecordPose(*bench.head, pose, folder, context));
  if (recorded.stops > 0) ++tally.poses;
  tally.stops += recorded.stops;
  tally.images += recorded.images;
  tally.sweeps += recorded.sweep ? 1 : 0;
  if (!recorded.missing.empty()) {
    tally.missing.push_back(recorded.missing);
    PrintNote("{}{}{}", pose.name, pose.name.empty() ? "" : ": ", recorded.missing);
  }
  return {};
}

Status MoveAndWait(MovingStand& stand, int place, const RunContext& context) {
  stand.MoveTo(place);
  while (stand.Moving() && !context.Cancelled())
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (stand.Trouble().empty()) return {};
  return Fail(ErrorCode::kDevice, "the stand did not go to place {}: {}", place + 1,
              stand.Trouble());
}

/// The stand of a simulated head elsewhere goes to its places by itself.
Status RecordWithStand(const RecordArguments& arguments, PoseRecording pose, RecordingBench& bench,
                       SessionFolder& folder, RecordTally& tally, const RunContext& context) {
  const std::vector<MovingStand::Place>& there = bench.stand->Places();
  std::vector<int> places = arguments.places;
  if (places.empty())
    for (int place = 1; place <= static_cast<int>(there.size()); ++place) places.push_back(place);
  for (const int place : places) {
    if (context.Cancelled()) return {};
    if (place < 1 || place > static_cast<int>(there.size()))
      return Fail(ErrorCode::kInvalidOptions, "--places {}: the head's stand has places 1 to {}",
                  place, there.size());
    FORESIGHT_CHECK(MoveAndWait(*bench.stand, place - 1, context));
    const MovingStand::Place& here = there[static_cast<std::size_t>(place - 1)];
    pose.name = here.name;
    FORESIGHT_CHECK(RecordHere(pose, !here.mount, bench, folder, tally, context));
  }
  return {};
}

/// The scene's stand goes to its places by itself; a real one stands where somebody put it.
Status RecordAll(const RecordArguments& arguments, PoseRecording pose, RecordingBench& bench,
                 SessionFolder& folder, RecordTally& tally, const RunContext& context) {
  const bool here = !arguments.place_name.empty() || arguments.view;
  if (bench.stand && !here) return RecordWithStand(arguments, pose, bench, folder, tally, context);
  if (!bench.world && !arguments.places.empty())
    return Fail(ErrorCode::kInvalidOptions,
                "--places: the stand of this head is carried: put it there, and name the place "
                "(--place-name)");
  if (!bench.world) {
    pose.name = arguments.place_name;
    return RecordHere(pose, arguments.view, bench, folder, tally, context);
  }
  const Scene& scene = bench.world->scene();
  std::vector<int> places = arguments.places;
  if (places.empty())
    for (int place = 1; place <= static_cast<int>(scene.places.size()); ++place)
      places.push_back(place);
  if (places.empty())
    return Fail(ErrorCode::kInvalidInput, "scene '{}' has no places of a stand", scene.name);
  for (const int place : places) {
    if (context.Cancelled()) return {};
    if (place == 0) return Fail(ErrorCode::kInvalidOptions, "--places 0: places count from 1");
    FORESIGHT_CHECK(bench.world->MoveStand(place));
    const StandPlace& there = scene.places[static_cast<std::size_t>(place - 1)];
    pose.name = there.name;
    const bool view = !scene.stands[static_cast<std::size_t>(there.stand)].b.has_value();
    FORESIGHT_CHECK(RecordHere(pose, view, bench, folder, tally, context));
  }
  return {};
}

void PrintTally(const RecordArguments& arguments, const RecordTally& tally) {
  if (arguments.json)
    PrintJson({{"session", arguments.folder},
               {"poses", tally.poses},
               {"stops", tally.stops},
               {"images", tally.images},
               {"sweeps", tally.sweeps},
               {"intrinsic_views", tally.views},
               {"missing", tally.missing}});
  else
    PrintLine(fmt::format(
        "{}: {} poses with {} stops, {} images and {} sweeps, and {} images for "
        "the camera alone were added",
        arguments.folder, tally.poses, tally.stops, tally.images, tally.sweeps, tally.views));
}

Result<ExitCode> Record(const RecordArguments& arguments, const RunContext& context) {
  FORESIGHT_CHECK(AnglesFrom(arguments.stops_deg));
  FORESIGHT_TRY(RecordingBench bench, SetUp(arguments));
  FORESIGHT_TRY(const PoseRecording pose, PoseFrom(arguments, bench));
  FORESIGHT_TRY(SessionFolder folder, OpenFolder(arguments, bench));
  FORESIGHT_CHECK(HomeAndWait(*bench.head, context));
  RecordTally tally;
  const Status recorded = RecordAll(arguments, pose, bench, folder, tally, context);
  PrintTally(arguments, tally);
  std::error_code not_there_or_not_empty;
  std::filesystem::remove(SpoolBeside(arguments.folder), not_there_or_not_empty);
  FORESIGHT_CHECK(recorded);
  const bool complete = tally.missing.empty() && !context.Cancelled();
  return complete ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddCalibrateRecordCommand(CLI::App& calibrate, Invocation& invocation) {
  const auto arguments = std::make_shared<RecordArguments>();
  CLI::App* command = calibrate.add_subcommand(
      "record",
      "Record a calibration session from a head: at one place of the stand, stops and a sweep");
  command
      ->add_option("session", arguments->folder,
                   "The session's folder; one that exists is gone on with")
      ->required();
  CLI::Option* scene = command->add_option(
      "--scene", arguments->emulation.scene,
      "Scene file (YAML) with places of a stand: a simulated head goes through them");
  AddEmulationOptions(*command, scene, arguments->emulation);
  command
      ->add_flag("--emulate", arguments->emulate,
                 "Emulate the scene's devices on real sockets, in real time")
      ->needs(scene);
  CLI::Option* places = command
                            ->add_option("--places", arguments->places,
                                         "Places of the stand of a simulated head; default: all")
                            ->delimiter(',');
  command
      ->add_option("--head-config", arguments->head_config,
                   "A real head and its devices (YAML), in place of a scene")
      ->excludes(scene)
      ->excludes(places);
  AddLinkOptions(*command, arguments->link)->excludes(scene)->excludes("--head-config");
  command
      ->add_option("--place-name", arguments->place_name,
                   "What the place is called where the stand is, of a real head")
      ->excludes(places);
  command
      ->add_flag("--view", arguments->view,
                 "Take one image of the board for the camera alone, of a real head")
      ->excludes(places);
  const auto option = [&](const char* name, auto& value, const char* help) {
    return command->add_option(name, value, help);
  };
  option("--stops", arguments->stops_deg, "Stops of the motor, FROM:STEP:TO in degrees")
      ->capture_default_str();
  option("--lines", arguments->lines, "Lidar lines at a stop")->capture_default_str();
  option("--sweep-speed", arguments->sweep_deg_s, "Of the sweep up and down, deg/s; 0 = no sweep")
      ->capture_default_str();
  option("--exposure", arguments->exposure_ms, "Exposure in milliseconds; default: the head's");
  option("--name", arguments->name, "Of a new session")->capture_default_str();
  option("--mount", arguments->mount,
         "Boards of a new session's stand, A or A,B (checkerboard:9x6:50,checkerboard:7x6:50); "
         "default: the scene's");
  option("--board", arguments->board,
         "Board of a new session's images for the camera alone; default: the scene's, or A");
  option("--prior", arguments->prior,
         "What a new session knows before: the CAD rig (YAML); default: the head's");
  command->add_flag("--json", arguments->json, "Print what was recorded as JSON");
  command->callback([&invocation, arguments] {
    if (arguments->emulation.scene.empty() && arguments->head_config.empty() &&
        arguments->link.head.empty())
      throw CLI::RequiredError("--scene, --head-config or --head");
    invocation = [arguments](const RunContext& context) { return Record(*arguments, context); };
  });
}

}  // namespace foresight
