// Objects of simulated scans, found again in each half of the lines.
#include <gtest/gtest.h>

#include "core/evaluation/fit_populations.h"
#include "core/evaluation/fit_trial.h"
#include "core/selfcheck/half_fits.h"

namespace foresight {
namespace {

struct Halves {
  int compared = 0;
  int differ = 0;
};

/// Of the blocks that a fit to a scan's returns offers, with its image or without.
Halves BlocksInHalvesOf(const FitTrial& trial, const FitOptions& options, bool with_image) {
  ProcessedScan scan{trial.rig, trial.cloud};
  if (with_image) scan.frames = {trial.frame};
  KeptObject object;
  object.options = options;
  object.roi = trial.roi;
  object.detection = FitInScan(scan, FitSource::kRaw, trial.roi, options, {}).value();
  EXPECT_EQ(OriginOf(object.detection).image, with_image);
  const std::vector<HalfFits> halves = CheckHalves(trial.cloud, trial.rig, object, {}, {}).value();
  const auto& surfaces = std::get<TerrainDetection>(object.detection).surfaces;
  Halves count;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].verdict.level == VerdictLevel::kUnsure) continue;
    count.compared += halves[i].state != HalfFits::State::kNotSeen ? 1 : 0;
    count.differ += halves[i].state == HalfFits::State::kDiffer ||
                            halves[i].state == HalfFits::State::kDifferFar
                        ? 1
                        : 0;
  }
  return count;
}

TEST(HalvesOfAScan, AreNotAskedToPlaceBlocksAsWellAsTheImageOfTheWhole) {
  const auto population = MakeFitPopulation("terrain").value();
  Halves with, without;
  for (const std::uint64_t seed : {20001, 20002, 20004}) {
    const FitTrial trial = MakeFitTrial(*population, seed, {}, {}).value();
    for (const bool image : {true, false}) {
      const Halves halves = BlocksInHalvesOf(trial, population->Options(trial.rig), image);
      Halves& sum = image ? with : without;
      sum.compared += halves.compared;
      sum.differ += halves.differ;
    }
  }
  EXPECT_GE(with.compared, without.compared);
  EXPECT_GT(without.compared, 10);
  EXPECT_LE(with.differ, without.differ);
}

}  // namespace
}  // namespace foresight
