// Our fits beside other programs' on the same held-out scenes, rays, tolerances and CPU clock:
//   fit_peers KIND FIRST_SEED COUNT [--points FOLDER] [--poses FILE]
// draws COUNT scenes that have the object in them, runs ours and PCL's, and prints a table: how
// many are right, and by how much ours is ahead. With --points it writes what other programs need,
// fit_peers.py among them; with --poses it judges their answers beside ours.
// docs/evaluation/peers.md, "Fits beside others".
#include <fmt/core.h>
#include <time.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/quantile.h"
#include "core/depth/depth_method.h"
#include "core/evaluation/fit_populations.h"
#include "core/evaluation/paired_lead.h"
#include "core/evaluation/terrain_truth.h"
#include "core/fitting/drill/support_and_background.h"
#include "core/fitting/ray_selection.h"
#include "core/fitting/wall.h"
#include "tests/benchmark/fit_peers.h"

namespace foresight {
namespace {

using peers::Patch;
using peers::Points;
using Pose = Rigid<frame::Base, frame::Object>;

constexpr int kIcpPoints = 1500;

double CpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// How one method did on one source.
struct Tally {
  int asked = 0;  ///< objects in view
  int right = 0;
  int wrong = 0;  ///< answers that are not
  std::vector<double> center_mm, seconds;
  RightOfScenes right_of_scene;
};

/// A scene as one source shows it.
struct Bench {
  const FitPopulation& population;
  const FitTrial& trial;
  std::string source;
  RaySet rays;
  Eigen::Vector3d up;
  Points foreground;  ///< what stands before wall or on table
  Eigen::Vector3d facing;
  Points model;  ///< of the true object, in its own frame
  std::map<std::string, Tally>& tallies;

  std::string Name() const {
    return fmt::format("{}_{}_{}", ToString(population.Kind()), trial.seed, source);
  }

  void Judge(const std::string& method, const Result<Detection>& found, double seconds) const {
    Tally& tally = tallies[source + " | " + method];
    tally.seconds.push_back(seconds);
    const bool terrain = population.Kind() == ObjectKind::kTerrain;
    if (terrain) {
      for (const TrueBlock& block : TrueBlocksOf(trial)) tally.asked += block.Visible() ? 1 : 0;
    } else {
      ++tally.asked;
    }
    int& right = tally.right_of_scene[trial.seed];
    for (const FitOutcome& outcome : population.Judge(trial, found)) {
      double in_view = terrain ? 0.0 : 1.0, center_mm = 0.0;
      for (const auto& [name, value] : outcome.errors) {
        if (name == "in_view") in_view = value;
        if (name == "center_mm" || name == "xy_mm") center_mm = value;
      }
      if (outcome.found && !outcome.pose_ok) ++tally.wrong;
      if (!outcome.pose_ok || in_view == 0.0) continue;
      ++tally.right;
      ++right;
      tally.center_mm.push_back(center_mm);
    }
  }
};

const Pose TruePose(const FitTrial& trial) {
  const Scene& scene = *trial.scene.scene;
  return trial.TrueBaseFromRobot() * (scene.valves.empty()
                                          ? scene.drills.front().robot_from_object
                                          : scene.valves.front().robot_from_object);
}

/// Points of the true object's own meshes, evenly by area, in its frame.
Points ModelPoints(const FitTrial& trial, Random& random) {
  const Scene& scene = *trial.scene.scene;
  const bool valve = !scene.valves.empty();
  const std::string name = valve ? scene.valves.front().name : scene.drills.front().name;
  const auto object_from_robot =
      (valve ? scene.valves.front().robot_from_object : scene.drills.front().robot_from_object)
          .Inverse();
  Points points;
  for (const SceneMesh& mesh : scene.meshes) {
    if (valve ? mesh.name != name : !mesh.name.starts_with(name)) continue;
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const auto at = [&](int i) -> Eigen::Vector3d {
        return object_from_robot * mesh.vertices[static_cast<std::size_t>(t[i])].cast<double>();
      };
      const Eigen::Vector3d a = at(0), ab = at(1) - a, ac = at(2) - a;
      // A point a 10 mm^2; the fraction of one by chance.
      for (double left = 0.5 * ab.cross(ac).norm() / 1e-5; left > random.Uniform(); left -= 1.0) {
        double u = random.Uniform(), v = random.Uniform();
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        points.push_back(a + u * ab + v * ac);
      }
    }
  }
  return RandomSubset(points, 4000, random);
}

Eigen::Vector3d Mean(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

Eigen::Isometry3d Start(const Eigen::Vector3d& z, const Eigen::Vector3d& at, double turn_rad) {
  const Eigen::Vector3d x = z.unitOrthogonal();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << x, z.cross(x), z;
  pose.linear() = pose.linear() * Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ());
  pose.translation() = at;
  return pose;
}

Pose PoseOf(const Eigen::Isometry3d& pose) {
  return {Eigen::Matrix3d(pose.linear()), Eigen::Vector3d(pose.translation())};
}

/// An answer that knows the truth's shape: peers are given it.
Detection ValveAt(const Bench& bench, const Pose& pose, std::optional<double> radius_m = {}) {
  ValveDetection valve;
  valve.best.base_from_object = pose;
  valve.best.model = bench.trial.scene.scene->valves.front().model;
  if (radius_m) valve.best.model.rim_radius_m = *radius_m;
  return valve;
}

Detection DrillAt(const Pose& pose, const Eigen::Vector2d& body_tilt_rad) {
  DrillDetection drill;
  drill.best.base_from_object = pose;
  drill.best.model.body_tilt_rad = body_tilt_rad;
  return drill;
}

Detection TerrainOf(const std::vector<Patch>& patches) {
  TerrainDetection terrain;
  for (const Patch& patch : patches) {
    TerrainSurface surface;
    surface.kind = TerrainSurface::Kind::kBlock;
    surface.base_from_object = PoseOf(patch.pose);
    surface.size_m = surface.toehold.size_m = patch.size_m;
    terrain.surfaces.push_back(surface);
  }
  return terrain;
}

Result<Detection> NoAnswer() {
  return Fail(ErrorCode::kNoConvergence, "no answer");
}

void RunValvePeers(const Bench& bench) {
  const double inlier_m = 2.0 * bench.rays.sigma_m + 0.005;
  double begin = CpuSeconds();
  const auto circle = peers::PclCircle(bench.foreground, inlier_m);
  Result<Detection> answer = NoAnswer();
  if (circle) {
    const Eigen::Vector3d z =
        circle->axis.dot(bench.facing) < 0.0 ? Eigen::Vector3d(-circle->axis) : circle->axis;
    answer = ValveAt(bench, PoseOf(Start(z, circle->middle, 0.0)), circle->radius_m);
  }
  bench.Judge("PCL CIRCLE3D", answer, CpuSeconds() - begin);

  begin = CpuSeconds();
  Random random(1);
  std::vector<Eigen::Isometry3d> starts;
  const int spokes = std::max(2, bench.trial.scene.scene->valves.front().model.spokes);
  for (int i = 0; i < 6; ++i)
    starts.push_back(
        Start(bench.facing, Mean(bench.foreground), 2.0 * std::numbers::pi / spokes * i / 6.0));
  const auto icp =
      peers::PclIcp(RandomSubset(bench.foreground, kIcpPoints, random), bench.model, starts);
  answer = icp ? Result<Detection>(ValveAt(bench, PoseOf(*icp))) : NoAnswer();
  bench.Judge("PCL ICP, 6 phases, true wheel", answer, CpuSeconds() - begin);
}

void RunDrillPeers(const Bench& bench) {
  double begin = CpuSeconds();
  const auto axis = peers::PclCylinder(bench.foreground, 2.0 * bench.rays.sigma_m + 0.005);
  Result<Detection> answer = NoAnswer();
  if (axis) {
    // A cylinder has no direction to point to: it is given the true one.
    const Pose truth = TruePose(bench.trial);
    Eigen::Vector3d z = axis->axis.dot(bench.up) < 0.0 ? Eigen::Vector3d(-axis->axis) : axis->axis;
    const Eigen::Vector3d true_x = truth.Rotate(Eigen::Vector3d::UnitX());
    Eigen::Matrix3d turn;
    const Eigen::Vector3d x = (true_x - true_x.dot(z) * z).normalized();
    turn << x, z.cross(x), z;
    answer = DrillAt({turn, axis->middle}, Eigen::Vector2d::Zero());
  }
  bench.Judge("PCL cylinder with normals, yaw given", answer, CpuSeconds() - begin);

  begin = CpuSeconds();
  Random random(1);
  std::vector<Eigen::Isometry3d> starts;
  const Eigen::Vector3d at = Mean(bench.foreground) - Mean(bench.model).z() * bench.up;
  for (int i = 0; i < 12; ++i)
    starts.push_back(Start(bench.up, at, 2.0 * std::numbers::pi * i / 12.0));
  const auto icp =
      peers::PclIcp(RandomSubset(bench.foreground, kIcpPoints, random), bench.model, starts);
  answer = icp ? Result<Detection>(
                     DrillAt(PoseOf(*icp), bench.trial.scene.scene->drills.front().body_tilt_rad))
               : NoAnswer();
  bench.Judge("PCL ICP, 12 yaws, true drill", answer, CpuSeconds() - begin);
}

void RunTerrainPeers(const Bench& bench) {
  double begin = CpuSeconds();
  Points points;
  Eigen::AlignedBox2i cells;
  for (const RangeRay& ray : bench.rays.rays) {
    points.push_back(ray.Point());
    cells.extend(ray.cell);
  }
  const Detection grown = TerrainOf(peers::PclRegionGrowing(points, bench.up));
  bench.Judge("PCL RegionGrowing", grown, CpuSeconds() - begin);
  begin = CpuSeconds();
  const int width = cells.sizes().x() + 1;
  Points grid(static_cast<std::size_t>(width * (cells.sizes().y() + 1)),
              Eigen::Vector3d::Constant(std::nan("")));
  for (const RangeRay& ray : bench.rays.rays) {
    const Eigen::Vector2i at = ray.cell - cells.min();
    grid[static_cast<std::size_t>(at.y() * width + at.x())] = ray.Point();
  }
  const Detection organized = TerrainOf(peers::PclOrganizedPlanes(grid, width, bench.up));
  bench.Judge("PCL OrganizedMultiPlane", organized, CpuSeconds() - begin);
}

void WritePoints(const std::filesystem::path& path, const Points& points) {
  std::ofstream stream(path);
  for (const Eigen::Vector3d& p : points)
    stream << fmt::format("{:.5f} {:.5f} {:.5f}\n", p.x(), p.y(), p.z());
}

/// NAME.xyz: what stands before wall or table, of terrain all; NAME_model.xyz; NAME.json.
void WriteBench(const Bench& bench, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  Points points = bench.foreground;
  if (bench.population.Kind() == ObjectKind::kTerrain) {
    points.clear();
    for (const RangeRay& ray : bench.rays.rays) points.push_back(ray.Point());
  } else {
    WritePoints(folder / (bench.Name() + "_model.xyz"), bench.model);
  }
  WritePoints(folder / (bench.Name() + ".xyz"), points);
  const auto list = [](const Eigen::Vector3d& v) {
    return std::vector<double>{v.x(), v.y(), v.z()};
  };
  std::ofstream(folder / (bench.Name() + ".json"))
      << nlohmann::json{{"kind", ToString(bench.population.Kind())},
                        {"sigma_m", bench.rays.sigma_m},
                        {"up", list(bench.up)},
                        {"viewpoint", list(bench.rays.viewpoint)}};
}

Patch PatchFrom(const nlohmann::json& value) {
  Patch patch;
  const std::vector<double> m = value.at("pose");  // row by row
  patch.pose.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(m.data());
  patch.size_m = {value.value("length_m", 0.0), value.value("width_m", 0.0)};
  return patch;
}

/// Answers of other programs, one JSON object a line: trial, method, seconds, answers.
void JudgePoses(const Bench& bench, const std::vector<nlohmann::json>& poses) {
  for (const nlohmann::json& line : poses) {
    if (line.at("trial") != bench.Name()) continue;
    std::vector<Patch> patches;
    for (const nlohmann::json& answer : line.at("answers")) patches.push_back(PatchFrom(answer));
    Result<Detection> answer = NoAnswer();
    if (bench.population.Kind() == ObjectKind::kTerrain)
      answer = TerrainOf(patches);
    else if (!patches.empty() && bench.population.Kind() == ObjectKind::kValve)
      answer = ValveAt(bench, PoseOf(patches.front().pose));
    else if (!patches.empty())
      answer = DrillAt(PoseOf(patches.front().pose),
                       bench.trial.scene.scene->drills.front().body_tilt_rad);
    bench.Judge(line.at("method"), answer, line.at("seconds"));
  }
}

struct Arguments {
  std::string kind;
  std::uint64_t first_seed = 10000;
  int count = 15;
  std::string points;
  std::vector<nlohmann::json> poses;
};

void RunSource(const FitPopulation& population, const FitTrial& trial, const ProcessedScan& scan,
               FitSource source, const Arguments& arguments,
               std::map<std::string, Tally>& tallies) {
  const char* name = source == FitSource::kRaw ? "raw" : "dense";
  const auto rays = RaysInScan(scan, source, trial.roi);
  if (!rays) return;
  Bench bench{population, trial, name, *rays, {}, {}, {}, {}, tallies};
  bench.up = trial.rig.robot_from_base.Inverse().Rotate(Eigen::Vector3d::UnitZ());
  Random random(trial.seed);
  if (population.Kind() == ObjectKind::kValve) {
    WallSplit split = SplitWall(*rays, random);
    bench.foreground = std::move(split.foreground);
    bench.facing =
        split.wall ? split.wall->normal : (rays->viewpoint - Mean(bench.foreground)).normalized();
  } else if (population.Kind() == ObjectKind::kDrill) {
    bench.foreground = FindSupportAndBackground(*rays, {.up = bench.up}, random).foreground;
  }
  if (population.Kind() != ObjectKind::kTerrain) bench.model = ModelPoints(trial, random);

  const double begin = CpuSeconds();
  const auto ours = FitInRays(*rays, population.Options(trial.rig), {});
  bench.Judge("Foresight", ours, CpuSeconds() - begin);
  if (population.Kind() == ObjectKind::kTerrain)
    RunTerrainPeers(bench);
  else if (bench.foreground.size() < 20)
    return;
  else if (population.Kind() == ObjectKind::kValve)
    RunValvePeers(bench);
  else
    RunDrillPeers(bench);
  if (!arguments.points.empty()) WriteBench(bench, arguments.points);
}

Status Run(const Arguments& arguments) {
  FORESIGHT_TRY(const auto population, MakeFitPopulation(arguments.kind));
  FitTrialOptions options;
  options.sources = {{}, {FitSource::kDepthAlone, DepthMethod::kForesight}};
  std::map<std::string, Tally> tallies;
  RunContext one_thread;
  one_thread.threads = 1;
  int done = 0;
  for (std::uint64_t seed = arguments.first_seed; done < arguments.count; ++seed) {
    if (!population->MakeScene(seed).positive) continue;
    ++done;
    FORESIGHT_TRY(const FitTrial trial, MakeFitTrial(*population, seed, options, one_thread));
    for (const char* source : {"raw", "dense"})
      JudgePoses({*population, trial, source, {}, {}, {}, {}, {}, tallies}, arguments.poses);
    RunSource(*population, trial, {trial.rig, trial.cloud, {trial.frame}}, FitSource::kRaw,
              arguments, tallies);
    FORESIGHT_TRY(const DepthResult depth,
                  ComputeDepthInFrame(trial.cloud, trial.rig, trial.frame,
                                      DefaultsOf(DepthMethod::kForesight), one_thread));
    RunSource(*population, trial, {trial.rig, trial.cloud, {trial.frame}, &depth},
              FitSource::kDepthAlone, arguments, tallies);
    fmt::print(stderr, "\r{} of {} scenes", done, arguments.count);
  }
  fmt::print(
      "\n| source | method | right | wrong answers | ours alone, it alone right | ours ahead a "
      "scene, 95 % | centre mm | CPU s |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& [name, tally] : tallies) {
    const Tally& ours = tallies[name.substr(0, name.find('|')) + "| Foresight"];
    const PairedLead lead = LeadOverSharedScenes(ours.right_of_scene, tally.right_of_scene);
    fmt::print("| {} | {} of {} | {} | {}, {} | {:.2f} ({:.2f} to {:.2f}) | {:.1f} | {:.3f} |\n",
               name, tally.right, tally.asked, tally.wrong, lead.only_first, lead.only_second,
               lead.lead, lead.low, lead.high, UpperMedian(tally.center_mm),
               UpperMedian(tally.seconds));
  }
  return {};
}

int Main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr,
               "fit_peers valve|drill|terrain FIRST_SEED COUNT [--points FOLDER] "
               "[--poses FILE]\n");
    return 2;
  }
  Arguments arguments{argv[1], std::stoull(argv[2]), std::stoi(argv[3]), {}, {}};
  for (int i = 4; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "--points") {
      arguments.points = argv[i + 1];
      continue;
    }
    std::ifstream stream(argv[i + 1]);
    for (std::string line; std::getline(stream, line);)
      arguments.poses.push_back(nlohmann::json::parse(line));
  }
  peers::QuietPcl();
  const Status status = Run(arguments);
  if (!status) fmt::print(stderr, "fit_peers: {}\n", status.error().message);
  return status ? 0 : 3;
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  try {
    return foresight::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "fit_peers: {}\n", error.what());
    return 3;
  }
}
