// What a fit does most: the intersections of a region's rays with a drill at a place, one ray after
// another and a ray a lane on each instruction set.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "core/fitting/solids/intersect_columns.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/objects/drill_template.h"
#include "tests/support/vector_targets.h"

namespace foresight {
namespace {

constexpr double kReach_m = 0.018;  // of a beam at 1.5 m

/// 1200 beams of a region at 1.5 m, most of them beside the drill.
struct Region {
  std::vector<RangeRay> rays;
  RayColumns columns;

  Region() {
    for (int line = 0; line < 30; ++line)
      for (int beam = 0; beam < 40; ++beam) {
        const Eigen::Vector3d to(1.5, 0.011 * (beam - 20), 0.014 * (line - 8));
        rays.push_back({Eigen::Vector3d::Zero(), to.normalized(), to.norm()});
        columns.Add(rays.back().origin.data(), rays.back().direction.data(), kReach_m);
      }
    columns.Pad();
  }
};

/// Each template, at eight turns.
std::vector<SolidTracer> Drills() {
  std::vector<SolidTracer> drills;
  for (const DrillTemplate& kind : ShippedDrillTemplates())
    for (int turn = 0; turn < 8; ++turn)
      drills.emplace_back(
          kind.Make(1.0, {0.05, -0.05}, 0.05, {}).parts,
          Rigid<frame::Base, frame::Object>(
              Eigen::Quaterniond(Eigen::AngleAxisd(0.7 * turn, Eigen::Vector3d::UnitZ())),
              {1.5, 0.0, -0.08}));
  return drills;
}

void OneByOne(benchmark::State& state) {
  const Region region;
  const std::vector<SolidTracer> drills = Drills();
  std::size_t next = 0;
  for (auto _ : state) {
    const SolidTracer& drill = drills[next++ % drills.size()];
    for (const RangeRay& ray : region.rays)
      benchmark::DoNotOptimize(drill.IntersectWithDepth(ray, kReach_m));
  }
}

void ARayALane(benchmark::State& state, int64_t target) {
  const OnlyVectorTarget only(target);
  const Region region;
  std::vector<PlacedSolids> drills;
  for (const SolidTracer& drill : Drills()) drills.push_back(drill.Placed());
  std::vector<double> clearance_m(region.columns.Padded()), range_m(region.columns.Padded());
  std::size_t next = 0;
  for (auto _ : state) {
    IntersectColumns(drills[next++ % drills.size()], region.columns, clearance_m, range_m);
    benchmark::DoNotOptimize(clearance_m.data());
  }
}

const bool kRegistered = [] {
  benchmark::RegisterBenchmark("IntersectDrill/one_by_one", OneByOne);
  for (const int64_t target : VectorTargets())
    benchmark::RegisterBenchmark((std::string("IntersectDrill/") + hwy::TargetName(target)).c_str(),
                                 ARayALane, target);
  return true;
}();

}  // namespace
}  // namespace foresight
