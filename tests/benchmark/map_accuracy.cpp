// Scans of the room from two standpoints, 0.5 m and 10 deg apart, aligned from a first guess that
// is off, and compared with a drill that was moved by 0.31 m in between, and with nothing moved.
//   map_accuracy [SEEDS] [FIRST_SEED]
// Bars: 5 mm and 0.1 deg; the moved drill and nothing else.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/geometry/angles.h"
#include "core/mapping/scan_changes.h"
#include "core/mapping/scan_map.h"
#include "core/simulation/simulate_scan.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Map, frame::Robot>;
using Clock = std::chrono::steady_clock;

template <class T>
T Must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

struct Taken {
  SensorRig rig;
  RegisteredScan cloud;
};

Taken Take(std::shared_ptr<const Scene> scene, const Pose& standpoint, std::uint64_t seed) {
  SensorRig rig = DefaultSensorRig();
  const auto mounted = rig.robot_from_base;
  rig.robot_from_base =
      Rigid<frame::Robot, frame::Robot>(standpoint.rotation(), standpoint.translation()) * mounted;
  WorldOptions options;
  options.seed = seed;
  const World world(std::move(scene), rig, options);
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-45.0);
  plan.to_rad = RadiansFromDegrees(45.0);
  Scan scan = Must(SimulateSweep(world, plan, {}));
  scan.rig.robot_from_base = mounted;
  scan.rig.angle_correction = world.CalibratedCorrection();
  return {scan.rig, Must(RegisterScan(scan, {}))};
}

Eigen::Vector3d DirectionFrom(Random& random) {
  return Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
}

Pose OffBy(const Pose& pose, Random& random) {
  const Eigen::AngleAxisd turn(RadiansFromDegrees(3.0), DirectionFrom(random));
  return {Eigen::Quaterniond(pose.rotation() * turn),
          pose.translation() + 0.05 * DirectionFrom(random)};
}

std::string ChangesText(const ScanChanges& changes) {
  std::string text;
  for (const ScanChange& change : changes.changes)
    text +=
        fmt::format(" {} at ({:.2f}, {:.2f}, {:.2f}), {} points;", ToString(change.kind),
                    change.centre.x(), change.centre.y(), change.centre.z(), change.points.size());
  return text.empty() ? " nothing;" : text;
}

/// Aligns and compares; prints one line.
void Try(const char* what, const std::shared_ptr<const Scene>& before,
         const std::shared_ptr<const Scene>& after, std::uint64_t seed) {
  Random random(seed);
  const Pose truth(
      Eigen::Quaterniond(Eigen::AngleAxisd(RadiansFromDegrees(10.0), Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d(0.4, 0.3, 0.0));
  const Taken first = Take(before, {}, 2 * seed), second = Take(after, truth, 2 * seed + 1);
  const auto begin = Clock::now();
  const std::vector<MapPlace> places = Must(PlaceScans(
      {{first.cloud, first.rig, Pose()}, {second.cloud, second.rig, OffBy(truth, random)}}, {},
      {}));
  const double align_s = std::chrono::duration<double>(Clock::now() - begin).count();
  if (!places[1].InMap()) throw std::runtime_error(places[1].failure);
  const ScanChanges changes = Must(
      FindChanges({first.cloud, places[0].map_from_robot * first.rig.robot_from_base},
                  {second.cloud, places[1].map_from_robot * second.rig.robot_from_base}, {}, {}));
  const double all_s = std::chrono::duration<double>(Clock::now() - begin).count();
  const Pose& found = places[1].map_from_robot;
  fmt::print(
      "seed {:>4} {:<13} {:5.2f} mm {:6.3f} deg  rms {:4.1f} mm  overlap {:.2f}  sigma {:.2f} "
      "mm  {:.1f} s + {:.1f} s |{} {} not seen before\n",
      seed, what, 1e3 * (found.translation() - truth.translation()).norm(),
      DegreesFromRadians(found.rotation().angularDistance(truth.rotation())),
      1e3 * places[1].alignment->rms_m, places[1].alignment->overlap_ratio,
      1e3 * places[1].alignment->largest_sigma_m, align_s, all_s - align_s, ChangesText(changes),
      changes.not_seen_before);
}

void Run(int seeds, int first_seed) {
  const std::string file = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";
  std::string text = Must(ReadFile(file));
  const auto room = std::make_shared<const Scene>(Must(SceneFromYaml(text, file)));
  const std::string place = "position_m: [1.32, -0.58, 0.85]";
  const std::size_t at = text.find(place);
  if (at == std::string::npos) throw std::runtime_error("the drill of the room stands elsewhere");
  text.replace(at, place.size(), "position_m: [1.40, -0.88, 0.85]");
  const auto moved = std::make_shared<const Scene>(Must(SceneFromYaml(text, file)));
  for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
    Try("nothing moved", room, room, static_cast<std::uint64_t>(seed));
    Try("drill moved", room, moved, static_cast<std::uint64_t>(seed));
  }
}

int NumberFrom(int count, char** values, int at, int otherwise) {
  int number = otherwise;
  if (count > at) std::from_chars(values[at], values[at] + std::strlen(values[at]), number);
  return std::max(1, number);
}

}  // namespace
}  // namespace foresight

int main(int count, char** values) {
  try {
    foresight::Run(foresight::NumberFrom(count, values, 1, 10),
                   foresight::NumberFrom(count, values, 2, 1));
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "map_accuracy: {}\n", failure.what());
    return 3;
  }
}
