#include "core/evaluation/fit_trial.h"

#include <time.h>

#include <algorithm>
#include <map>

#include "core/detection/detection_json.h"
#include "core/evaluation/drawn_region.h"
#include "core/evaluation/plain_cloud.h"
#include "core/registration/register_scan.h"
#include "core/simulation/simulate_scan.h"

namespace foresight {
namespace {

/// CPU time of the calling thread; fits are tried with one thread.
double CpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Result<Scan> Simulated(const World& world, const ScanPlan& plan, bool with_image,
                       const RunContext& context) {
  if (with_image) return SimulateScan(world, plan, context);
  FORESIGHT_TRY(Scan scan, SimulateSweep(world, plan, context));
  CameraFrame frame;
  frame.motor_angle_rad = frame.target_angle_rad = plan.image_angles_rad.front();
  scan.frames.push_back(std::move(frame));
  return scan;
}

/// Keeps the first lines.
void Interrupt(double fraction, Scan& scan) {
  std::vector<LidarLine> lines(scan.lines.begin(), scan.lines.end());
  lines.resize(std::max<std::size_t>(
      1, static_cast<std::size_t>(fraction * static_cast<double>(lines.size()))));
  scan.lines = std::move(lines);
  scan.state = ScanState::kInterrupted;
  scan.reason = "the simulated scan was interrupted";
}

void AddOutcomes(const FitPopulation& population, const FitTrial& trial, const std::string& source,
                 const Result<Detection>& found, double seconds,
                 std::vector<FitOutcome>& outcomes) {
  for (FitOutcome& outcome : population.Judge(trial, found)) {
    outcome.world = population.World();
    outcome.seed = trial.seed;
    outcome.source = source;
    outcome.what = trial.scene.what;
    // Where a region shows a part of an object and that was enough to tell all of it, there was
    // something to find.
    outcome.positive = trial.scene.positive || outcome.all_ok;
    outcome.seconds = seconds;
    // Of several things in one detection each has its own evidence already.
    if (outcome.found && outcome.evidence.empty()) outcome.evidence = EvidenceNumbers(*found);
    outcomes.push_back(std::move(outcome));
  }
}

}  // namespace

const char* ToString(FitWorld world) {
  constexpr const char* kNames[] = {"home", "varied", "other"};
  return kNames[static_cast<int>(world)];
}

Result<FitWorld> FitWorldFromString(const std::string& name) {
  for (const FitWorld world : {FitWorld::kHome, FitWorld::kVaried, FitWorld::kOther})
    if (name == ToString(world)) return world;
  return Fail(ErrorCode::kBadData, "world '{}' is none of home, varied, other", name);
}

bool FitTrialOptions::NeedsImage(ObjectKind kind) const {
  const bool for_beams = UsesImage(kind) && outline_weight > 0.0;
  return for_beams || std::any_of(sources.begin(), sources.end(), [](const NamedSource& source) {
           return source.source != FitSource::kRaw;
         });
}

Status FitTrialOptions::Check() const {
  if (sources.empty() && !plain_cloud)
    return Fail(ErrorCode::kInvalidOptions, "trial of fits: no source is named");
  if (!(outline_weight >= 0.0 && outline_weight <= 10.0))
    return Fail(ErrorCode::kInvalidOptions, "trial of fits: outline weight {} is not in [0, 10]",
                outline_weight);
  return rig_error ? rig_error->Check() : Status();
}

Result<FitTrial> MakeFitTrial(const FitPopulation& population, std::uint64_t seed,
                              const FitTrialOptions& options, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  FitTrialScene scene = population.MakeScene(seed);
  scene.world.seed = seed;
  // The guide needs edges, not smooth ones; four times faster.
  scene.world.camera.samples_side = 1;
  FORESIGHT_CHECK(scene.world.Check());
  const World world(scene.scene, DefaultSensorRig(), scene.world);
  FORESIGHT_TRY(Scan scan,
                Simulated(world, scene.plan, options.NeedsImage(population.Kind()), context));
  if (const auto& error = options.rig_error ? options.rig_error : scene.rig_error)
    scan.rig = MiscalibratedRig(scan.rig, *error, seed);
  if (scene.scanned < 1.0) Interrupt(scene.scanned, scan);
  FORESIGHT_TRY(RegisteredScan cloud, RegisterScan(scan, context));
  const double motor_rad = scan.frames.front().motor_angle_rad;
  FORESIGHT_TRY(const Roi roi, DrawnRegion(scene, world, motor_rad, seed));
  return FitTrial{seed,     std::move(scene), world,
                  scan.rig, std::move(cloud), std::move(scan.frames.front()),
                  roi};
}

Result<std::vector<FitOutcome>> RunFitTrial(const FitPopulation& population, std::uint64_t seed,
                                            const FitTrialOptions& options,
                                            const RunContext& context) {
  RunContext one_thread = context;
  one_thread.threads = 1;
  FORESIGHT_TRY(const FitTrial trial, MakeFitTrial(population, seed, options, one_thread));
  std::vector<FitOutcome> outcomes;
  std::map<DepthMethod, DepthResult> depths;
  for (const NamedSource& source : options.sources) {
    ProcessedScan scan{trial.rig, trial.cloud, {trial.frame}};
    scan.outline_weight = options.outline_weight;
    if (source.source != FitSource::kRaw) {
      if (!depths.contains(source.method)) {
        FORESIGHT_TRY(DepthResult depth,
                      ComputeDepthInFrame(trial.cloud, trial.rig, trial.frame,
                                          DefaultsOf(source.method), one_thread));
        depths.emplace(source.method, std::move(depth));
      }
      scan.depth = &depths.at(source.method);
    }
    const double begin = CpuSeconds();
    const Result<Detection> found =
        FitInScan(scan, source.source, trial.roi, population.Options(trial.rig), one_thread);
    AddOutcomes(population, trial, NameOf(source), found, CpuSeconds() - begin, outcomes);
  }
  if (options.plain_cloud) {
    const double begin = CpuSeconds();
    const auto found = FitInPlainCloud(PlainCloudOf(trial.cloud), trial.rig, trial.roi,
                                       population.Options(trial.rig), one_thread);
    AddOutcomes(population, trial, std::string(kCloudSource), found, CpuSeconds() - begin,
                outcomes);
  }
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the trial of a fit was cancelled");
  return outcomes;
}

}  // namespace foresight
