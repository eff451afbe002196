#include "core/detection/fit_in_scan.h"

#include <gtest/gtest.h>

#include "core/base/quantile.h"
#include "core/depth/depth_method.h"
#include "core/evaluation/fit_populations.h"
#include "core/evaluation/fit_trial.h"

namespace foresight {
namespace {

TEST(FitSource, HasANameForEachMethodWithAndWithoutItsBeams) {
  for (const DepthMethodInfo& method : DepthMethods())
    for (const FitSource source : {FitSource::kDepth, FitSource::kDepthAlone}) {
      const auto read = FitSourceFromName(NameOf({source, method.method}));
      ASSERT_TRUE(read);
      EXPECT_EQ(read->source, source);
      EXPECT_EQ(read->method, method.method);
    }
  EXPECT_EQ(FitSourceFromName("raw")->source, FitSource::kRaw);
}

TEST(FitSource, RefusesANameThatIsNone) {
  for (const char* name : {"", "-alone", "raw-alone", "foresigh", "foresight alone"})
    EXPECT_FALSE(FitSourceFromName(name)) << name;
}

TEST(RaysInScan, AMapBringsTheBeamsBehindItUnlessItIsWantedAlone) {
  const auto population = MakeFitPopulation("valve");
  ASSERT_TRUE(population);
  FitTrialOptions options;
  options.sources = {{FitSource::kDepth, DepthMethod::kForesight}};
  const auto trial = MakeFitTrial(**population, 3, options, {});
  ASSERT_TRUE(trial) << trial.error().message;
  const auto depth = ComputeDepthInFrame(trial->cloud, trial->rig, trial->frame,
                                         DefaultsOf(DepthMethod::kForesight), {});
  ASSERT_TRUE(depth);
  const ProcessedScan scan{trial->rig, trial->cloud, {trial->frame}, &*depth};
  const auto raw = RaysInScan(scan, FitSource::kRaw, trial->roi);
  const auto both = RaysInScan(scan, FitSource::kDepth, trial->roi);
  const auto alone = RaysInScan(scan, FitSource::kDepthAlone, trial->roi);
  ASSERT_TRUE(raw && both && alone);
  ASSERT_NE(both->beams, nullptr);
  EXPECT_EQ(both->beams->rays.size(), raw->rays.size());
  EXPECT_EQ(alone->beams, nullptr);
  EXPECT_EQ(alone->rays.size(), both->rays.size());
}

/// What became of a fit to the lidar's returns of a scene at home, with the image or without.
FitOutcome OutcomeOf(const char* kind, std::uint64_t seed, bool with_image) {
  const auto population = MakeFitPopulation(kind).value();
  const FitTrial trial = MakeFitTrial(*population, seed, {}, {}).value();
  ProcessedScan scan{trial.rig, trial.cloud};
  if (with_image) scan.frames = {trial.frame};
  return population
      ->Judge(trial,
              FitInScan(scan, FitSource::kRaw, trial.roi, population->Options(trial.rig), {}))
      .front();
}

TEST(FitInScan, TheImageTellsWhichWayADrillPointsWhereBeamsDoNot) {
  for (const std::uint64_t seed : {189, 20071}) {
    EXPECT_FALSE(OutcomeOf("drill", seed, false).pose_ok) << seed;
    EXPECT_TRUE(OutcomeOf("drill", seed, true).all_ok) << seed;
  }
}

TEST(FitInScan, TheImageTellsWhichWayALeverPointsWhereBeamsDoNot) {
  for (const std::uint64_t seed : {116, 141}) {
    EXPECT_FALSE(OutcomeOf("handle", seed, false).pose_ok) << seed;
    EXPECT_TRUE(OutcomeOf("handle", seed, true).all_ok) << seed;
  }
}

TEST(FitInScan, BeamsThatWentThroughAValveAreBeamsAndNotPixelsOfAMap) {
  const auto population = MakeFitPopulation("valve").value();
  FitTrialOptions options;
  options.sources = {{FitSource::kDepth, DepthMethod::kForesight}};
  const FitTrial trial = MakeFitTrial(*population, 3, options, {}).value();
  const DepthResult depth = ComputeDepthInFrame(trial.cloud, trial.rig, trial.frame,
                                                DefaultsOf(DepthMethod::kForesight), {})
                                .value();
  const ProcessedScan scan{trial.rig, trial.cloud, {trial.frame}, &depth};
  FitValveOptions more;
  more.max_rays = 3000;
  const auto rays_of = [&](FitSource source) {
    return FitValveInScan(scan, source, trial.roi, more, {}).value().evidence.rays;
  };
  // A map has more pixels there than the scan has beams.
  const int beams = rays_of(FitSource::kRaw);
  EXPECT_EQ(rays_of(FitSource::kDepth), beams);
  EXPECT_GT(rays_of(FitSource::kDepthAlone), beams);
}

TEST(FitInScan, TheImageTellsOfAValveWhetherItsPartsAreThereAndNotWhereItIs) {
  const auto population = MakeFitPopulation("valve").value();
  const FitTrial trial = MakeFitTrial(*population, 3, {}, {}).value();
  const auto fit = [&](const SharedList<CameraFrame>& frames) {
    ProcessedScan scan{trial.rig, trial.cloud};
    scan.frames = frames;
    return FitValveInScan(scan, FitSource::kRaw, trial.roi, FitValveOptions(), {}).value();
  };
  const ValveDetection with = fit({trial.frame}), without = fit({});
  EXPECT_TRUE(with.origin.image);
  EXPECT_FALSE(without.origin.image);
  EXPECT_GT(with.evidence.outline_nats_per_px, 0.0);
  EXPECT_EQ(without.evidence.outline_nats_per_px, 0.0);
  EXPECT_EQ(with.best.base_from_object.Matrix(), without.best.base_from_object.Matrix());
}

TEST(FitInScan, TheImageTellsHowManySpokesAWheelHasWhereBeamsDoNot) {
  EXPECT_FALSE(OutcomeOf("valve", 34, false).all_ok);
  EXPECT_TRUE(OutcomeOf("valve", 34, true).all_ok);
}

TEST(FitInScan, TheImagePlacesBlocksThatLidarLinesHardlyShow) {
  const auto population = MakeFitPopulation("terrain").value();
  double with_mm = 0.0, without_mm = 0.0;
  for (const std::uint64_t seed : {20001, 20004}) {
    const auto centers_mm = [&](double outline_weight) {
      FitTrialOptions options;
      options.outline_weight = outline_weight;
      std::vector<double> errors;
      const std::vector<FitOutcome> outcomes = RunFitTrial(*population, seed, options, {}).value();
      for (const FitOutcome& outcome : outcomes)
        for (const auto& [name, error] : outcome.errors)
          if (outcome.pose_ok && name == "center_mm") errors.push_back(error);
      EXPECT_FALSE(errors.empty()) << seed;
      return Quantile(std::move(errors), 0.5);
    };
    with_mm += centers_mm(ImageEdges::kIndependentPerPixel);
    without_mm += centers_mm(0.0);
  }
  EXPECT_LT(with_mm, 0.6 * without_mm);
}

TEST(FitInRegion, WhatStandsOnMoreThanItsRegionShowsIsToldWhatLiesRoundIt) {
  RaySet rays;
  for (int i = 0; i < 100; ++i)
    rays.rays.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d(0.001 * i, 0.0, 1.0).normalized(),
                         2.0, Eigen::Vector2i(i, 0)});
  const auto boxes_asked_for = [&](const FitOptions& options) {
    std::vector<BoxRoi> boxes;
    const auto rays_of = [&](const Roi& roi, BoxRays) -> Result<RaySet> {
      if (const auto* box = std::get_if<BoxRoi>(&roi)) boxes.push_back(*box);
      return rays;
    };
    // What becomes of the fit does not matter: a line of rays is nothing.
    (void)FitInRegion(rays_of, {}, ImageRoi::Rectangle(0.0, {0, 0}, {10, 10}), options, {});
    return boxes;
  };
  for (const FitOptions& options :
       {FitOptions(FitDrillOptions()), FitOptions(FitHandleOptions())}) {
    const std::vector<BoxRoi> boxes = boxes_asked_for(options);
    ASSERT_EQ(boxes.size(), 1u);
    EXPECT_TRUE(boxes[0].Contains(rays.rays[50].Point()));
    EXPECT_EQ(boxes[0].size_m, Eigen::Vector3d::Constant(1.0));
  }
  EXPECT_TRUE(boxes_asked_for(FitValveOptions()).empty());
  EXPECT_TRUE(boxes_asked_for(FitTerrainOptions()).empty());
}

}  // namespace
}  // namespace foresight
