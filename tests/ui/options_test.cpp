#include "ui/viewmodels/options_model.h"

#include <gtest/gtest.h>

#include "core/depth/depth_option_table.h"
#include "core/detection/fit_option_table.h"
#include "core/mission/recompute.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

std::shared_ptr<const Scan> SharedScan() {
  static const auto scan = std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.20, .to_rad = 0.20, .speed_rad_s = 0.15}));
  return scan;
}

struct OptionsTest : testing::Test {
  SessionModel session{SessionMode::kSimulation};
  DepthViewModel depth{&session};
  FitViewModel fit{&session};
  DepthOptionsModel depth_options{&depth};
  FitOptionsModel fit_options{&fit};
  std::vector<Notice> notices;

  OptionsTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  bool Computed() {
    return WaitFor([&] { return !depth.Runner()->Busy(); }) && session.Depth() != nullptr;
  }
  static const OptionRow* Row(const std::vector<OptionRow>& rows, const std::string& key) {
    for (const OptionRow& row : rows)
      if (row.info.key == key) return &row;
    return nullptr;
  }
  void DrawAroundValve() {
    const auto center = session.CurrentScan()->rig.camera.Project(
        session.CurrentScan()->rig.CameraFromBase(session.CurrentImage()->motor_angle_rad) *
        SyntheticValvePose().translation());
    fit.DrawRegion({*center - Eigen::Vector2d(50, 50), *center + Eigen::Vector2d(50, 50)});
  }
};

TEST_F(OptionsTest, AllOptionsOfTheMethodAreListedAndNoOthers) {
  std::size_t applicable = 0;
  for (const auto& option : DepthOptionTable()) applicable += option.AppliesTo(depth.Options());
  EXPECT_EQ(depth_options.Rows().size(), applicable);
  EXPECT_NE(Row(depth_options.Rows(), "local_plane.ridge"), nullptr);
  depth.setMethod(DepthMethod::kTgv);
  EXPECT_EQ(Row(depth_options.Rows(), "local_plane.ridge"), nullptr);
  EXPECT_NE(Row(depth_options.Rows(), "tgv.straightness"), nullptr);
}

TEST_F(OptionsTest, AnOptionOfTheFilterComputesAgainAndOneOfTheMaskDoesNot) {
  session.SetScan(SharedScan());
  ASSERT_TRUE(Computed());
  ASSERT_TRUE(depth_options.Set("mask.threshold", 0.8));
  EXPECT_EQ(depth.ComputedCount(), 1);
  EXPECT_FALSE(depth.Runner()->Busy());
  EXPECT_EQ(session.MaskOptions().threshold, 0.8);
  ASSERT_TRUE(depth_options.Set("local_plane.iterations", std::int64_t{1}));
  ASSERT_TRUE(Computed());
  EXPECT_EQ(depth.ComputedCount(), 2);
  EXPECT_EQ(session.Depth()->options.local_plane.iterations, 1);
  EXPECT_EQ(session.MaskOptions().threshold, 0.8);
  EXPECT_TRUE(depth_options.AnyChanged());
  depth_options.Reset();
  EXPECT_FALSE(depth_options.AnyChanged());
  ASSERT_TRUE(Computed());
}

TEST_F(OptionsTest, AValueThatIsRefusedChangesNothing) {
  const std::string before = DepthOptionsToJson(depth.Options());
  const Status status = depth_options.Set("local_plane.radius_in_sigmas", 99.0);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("99"), std::string::npos);
  EXPECT_EQ(DepthOptionsToJson(depth.Options()), before);
  EXPECT_FALSE(fit_options.Set("min_rim_radius_m", 0.5)) << "above the largest";
  EXPECT_FALSE(fit_options.AnyChanged());
}

TEST_F(OptionsTest, EachMethodKeepsItsOwnOptions) {
  ASSERT_TRUE(depth_options.Set("local_plane.ridge", 0.1));
  depth.setMethod(DepthMethod::kPaper);
  EXPECT_FALSE(depth_options.AnyChanged());
  depth.setMethod(DepthMethod::kForesight);
  EXPECT_EQ(depth.Options().local_plane.ridge, 0.1);
}

TEST_F(OptionsTest, ATerrainIsFittedToTheMapWhereThereIsOneUntilTheOperatorChooses) {
  fit.SetTool(ObjectKind::kTerrain, true);
  EXPECT_EQ(fit.From(), FitSource::kRaw) << "there is no map yet";
  session.SetScan(SharedScan());
  ASSERT_TRUE(Computed());
  EXPECT_EQ(fit.From(), FitSource::kDepth);
  fit.SetTool(ObjectKind::kValve, true);
  EXPECT_EQ(fit.From(), FitSource::kRaw);
  fit.SetSource(FitSource::kDepthAlone);
  fit.SetTool(ObjectKind::kTerrain, true);
  EXPECT_EQ(fit.From(), FitSource::kDepthAlone) << "what was chosen stays";
}

TEST_F(OptionsTest, WhatIsFoundNamesEveryOptionAndIsFoundAgain) {
  session.SetScan(SharedScan());
  ASSERT_TRUE(Computed());
  ASSERT_TRUE(depth_options.Set("mask.threshold", 0.5));
  fit.SetSource(FitSource::kDepth);
  fit.SetTool(ObjectKind::kValve, true);
  ASSERT_TRUE(fit_options.Set("seed", std::uint64_t{7}));
  ASSERT_TRUE(fit_options.Set("max_spokes", std::int64_t{5}));
  DrawAroundValve();
  ASSERT_TRUE(WaitFor([&] { return session.Objects().size() == 1; }));
  const auto provenance = ProvenanceFromJson(session.Objects()[0].provenance_json, "object");
  ASSERT_TRUE(provenance) << provenance.error().message;
  EXPECT_EQ(provenance->source, "foresight");
  EXPECT_EQ(provenance->image_position, session.ImageIndex());
  ASSERT_TRUE(provenance->depth && provenance->fit);
  EXPECT_EQ(provenance->depth->mask.threshold, 0.5);
  EXPECT_EQ(std::get<FitValveOptions>(*provenance->fit).seed, 7u);
  EXPECT_EQ(std::get<FitValveOptions>(*provenance->fit).max_spokes, 5);
}

}  // namespace
}  // namespace foresight
