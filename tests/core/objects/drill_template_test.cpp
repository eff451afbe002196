#include "core/objects/drill_template.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

constexpr double kExact = 1e-12;

const char* const kExample = R"(foresight_template: 1
object: drill
name: example
parts:
  - {name: battery foot, shape: box, middle_m: [0.01, 0, 0.02], size_m: [0.10, 0.06, 0.04]}
  - {name: body, shape: cylinder, from_m: [0, 0, 0.04], to_m: [0, 0, 0.20], radius_m: 0.025}
  - {name: head, shape: capsule, from_m: [-0.05, 0, 0.21], to_m: [0.08, 0, 0.21], radius_m: 0.03}
bit: {from_m: [0.11, 0, 0.21]}
grasp_m: [0, 0, 0.12]
trigger_m: [0.03, 0, 0.16]
)";

std::string Replaced(const std::string& from, const std::string& to) {
  std::string text = kExample;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string FaultOf(const std::string& yaml) {
  const auto read = DrillTemplateFromYaml(yaml, "my.yaml");
  if (read) return "was read";
  EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  return read.error().message;
}

DrillTemplate Example() {
  auto read = DrillTemplateFromYaml(kExample, "my.yaml");
  EXPECT_TRUE(read) << read.error().message;
  return *read;
}

TEST(DrillTemplate, WhatNoHandHoldsIsRefused) {
  for (const auto& [from, to] :
       {std::pair("radius_m: 0.025", "radius_m: 1.0e4"),
        std::pair("radius_m: 0.025", "radius_m: 1.0e308"),
        std::pair("size_m: [0.10, 0.06, 0.04]", "size_m: [0.10, 1.0e4, 0.04]"),
        std::pair("to_m: [0.08, 0, 0.21]", "to_m: [1.0e308, 0, 0.21]"),
        std::pair("grasp_m: [0, 0, 0.12]", "grasp_m: [0, 0, 1.0e4]"),
        std::pair("{from_m: [0.11, 0, 0.21]}", "{from_m: [0.11, 0, 0.21], radius_m: 1.0e4}")})
    EXPECT_NE(FaultOf(Replaced(from, to)).find("my.yaml:"), std::string::npos) << to;
}

TEST(DrillTemplate, AKindMayBeSeldomAndNotMoreThanUsual) {
  EXPECT_EQ(Example().log_prior, 0.0);
  const auto read =
      DrillTemplateFromYaml(Replaced("object: drill", "object: drill\nlog_prior: -2.5"), "my.yaml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->log_prior, -2.5);
  for (const char* wrong : {"1", "-1.0e9", ".nan"})
    EXPECT_NE(FaultOf(Replaced("object: drill", std::string("object: drill\nlog_prior: ") + wrong))
                  .find("log_prior"),
              std::string::npos)
        << wrong;
}

TEST(DrillTemplate, AGripMayUsuallyLean) {
  EXPECT_EQ(Example().usual_rake_rad, 0.0);
  const auto read = DrillTemplateFromYaml(
      Replaced("object: drill", "object: drill\nusual_rake_deg: -4.5"), "my.yaml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR(read->usual_rake_rad, -0.0785, 1e-4);
  for (const char* wrong : {"40", "-1.0e9", ".nan", "much"})
    EXPECT_NE(
        FaultOf(Replaced("object: drill", std::string("object: drill\nusual_rake_deg: ") + wrong))
            .find("usual_rake_deg"),
        std::string::npos)
        << wrong;
}

TEST(DrillTemplate, ShipsABarrelDrillACutOutToolAndAPlainOne) {
  std::vector<std::string> names;
  for (const DrillTemplate& drill : ShippedDrillTemplates()) {
    EXPECT_TRUE(drill.Check()) << drill.name;
    names.push_back(drill.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"barrel drill", "cut-out tool", "plain drill"}));
}

TEST(DrillTemplate, ShippedOnesStandOnTheirOrigin) {
  for (const DrillTemplate& drill : ShippedDrillTemplates()) {
    const DrillModel model = drill.Make(1.0, {0.0, 0.0}, 0.0);
    EXPECT_LT(model.Distance({0.0, 0.0, 0.001}), 0.0) << drill.name;
    EXPECT_NEAR(model.Distance({0.0, 0.0, -0.010}), 0.010, kExact) << drill.name;
  }
}

TEST(DrillTemplate, FaultsNameFileAndLine) {
  EXPECT_EQ(FaultOf(Replaced("radius_m: 0.025", "radius_m: -1")).substr(0, 10), "my.yaml:6:");
  EXPECT_EQ(FaultOf(Replaced("shape: capsule", "shape: cone")),
            "my.yaml:7: shape 'cone' is not box, cylinder or capsule");
  EXPECT_EQ(FaultOf(Replaced("name: body", "name: boddy")),
            "my.yaml:1: drill template 'example': no part is named 'body'");
  EXPECT_EQ(FaultOf(Replaced("object: drill", "object: valve")).substr(0, 10), "my.yaml:2:");
  EXPECT_EQ(FaultOf(Replaced("foresight_template: 1", "foresight_template: 9")),
            "my.yaml:1: this version cannot be read");
}

TEST(DrillTemplate, AMistypedKeyIsNotSilentlyADefault) {
  EXPECT_EQ(FaultOf(Replaced("bit: {from_m", "bit: {lenght_m: 0.1, from_m")).substr(0, 10),
            "my.yaml:8:");
}

TEST(DrillTemplate, IsReadFromAFile) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "drill.yaml";
  std::ofstream(path) << kExample;
  const auto read = LoadDrillTemplate(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->name, "example");
  EXPECT_FALSE(LoadDrillTemplate(folder.path() / "none.yaml"));
}

TEST(DrillTemplate, ScalesTheDrillButNotItsBit) {
  const DrillModel model = Example().Make(1.2, {0.0, 0.0}, 0.05);
  EXPECT_NEAR((model.bit_tip_m - Eigen::Vector3d(0.132 + 0.05, 0.0, 0.252)).norm(), 0.0, kExact);
  EXPECT_NEAR((model.trigger_m - Eigen::Vector3d(0.036, 0.0, 0.192)).norm(), 0.0, kExact);
  EXPECT_NEAR(model.Distance({0.0, 0.13, 0.144}), 0.13 - 0.03, kExact);  // to the body's side
}

TEST(DrillTemplate, WithoutABitTheTipIsTheChucksFace) {
  const DrillModel model = Example().Make(1.0, {0.0, 0.0}, 0.0);
  EXPECT_EQ(model.parts.size(), 3u);
  EXPECT_NEAR((model.bit_tip_m - Eigen::Vector3d(0.11, 0.0, 0.21)).norm(), 0.0, kExact);
}

TEST(DrillTemplate, LeansEverythingButTheFoot) {
  const double lean = 0.2;  // about y: the head goes forwards
  const DrillModel model = Example().Make(1.0, {0.0, lean}, 0.0);
  EXPECT_NEAR(model.parts[0].object_from_part.translation().x(), 0.01, kExact);
  EXPECT_NEAR(model.parts[1].object_from_part.translation().x(), 0.12 * std::sin(lean), kExact);
  const Eigen::Vector3d up = model.object_from_grasp.Rotate(Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(std::atan2(up.x(), up.z()), lean, kExact);
  EXPECT_NEAR(model.object_from_grasp.translation().norm(), 0.12, kExact);
}

TEST(DrillTemplate, AnotherHeadTakesChuckAndTriggerAlongButNotTheGrasp) {
  const DrillModel usual = Example().Make(1.2, {0.0, 0.0}, 0.05);
  const DrillModel other =
      Example().Make(1.2, {0.0, 0.0}, 0.05, {.head_up_m = 0.015, .front_m = -0.010});
  const Eigen::Vector3d moved(-0.010, 0.0, 0.015);
  EXPECT_NEAR((other.bit_tip_m - usual.bit_tip_m - moved).norm(), 0.0, kExact);
  EXPECT_NEAR((other.trigger_m - usual.trigger_m - Eigen::Vector3d(0.0, 0.0, 0.015)).norm(), 0.0,
              kExact);
  EXPECT_EQ(other.object_from_grasp.translation(), usual.object_from_grasp.translation());
  // The body reaches as far below its head as before, and stands where it stood.
  const SolidPart& body = other.parts[1];
  EXPECT_NEAR(body.size_m.z(), usual.parts[1].size_m.z() + 0.015, kExact);
  EXPECT_NEAR(body.object_from_part.translation().z() - 0.5 * body.size_m.z(), 1.2 * 0.04, kExact);
}

TEST(DrillTemplate, AnotherFootKeepsItsMiddleAndHeight) {
  const SolidPart usual = Example().Make(1.0, {0.0, 0.0}, 0.0).parts[0];
  const SolidPart other = Example().Make(1.0, {0.0, 0.0}, 0.0, {.foot_fraction = 0.8}).parts[0];
  EXPECT_EQ(other.object_from_part.translation(), usual.object_from_part.translation());
  EXPECT_NEAR(other.size_m.x(), 0.8 * usual.size_m.x(), kExact);
  EXPECT_EQ(other.size_m.z(), usual.size_m.z());
}

TEST(DrillTemplate, AHigherFootStandsOnTheTable) {
  const SolidPart usual = Example().Make(1.1, {0.0, 0.0}, 0.0).parts[0];
  const SolidPart other =
      Example().Make(1.1, {0.0, 0.0}, 0.0, {.foot_height_fraction = 1.4}).parts[0];
  EXPECT_NEAR(other.size_m.z(), 1.4 * usual.size_m.z(), kExact);
  EXPECT_NEAR(other.object_from_part.translation().z() - 0.5 * other.size_m.z(),
              usual.object_from_part.translation().z() - 0.5 * usual.size_m.z(), kExact);
  EXPECT_EQ(other.size_m.head<2>(), usual.size_m.head<2>());
}

TEST(DrillTemplate, TheBodyReachesDownToALowerFoot) {
  const auto low = [](const SolidPart& part) {
    return part.object_from_part.translation().z() - 0.5 * part.size_m.z();
  };
  for (const double fraction : {0.4, 0.7, 1.0, 1.5}) {
    const DrillModel model =
        Example().Make(1.2, {0.0, 0.0}, 0.0, {.foot_height_fraction = fraction});
    const SolidPart &foot = model.parts[0], &body = model.parts[1];
    EXPECT_LE(low(body), low(foot) + foot.size_m.z() + kExact) << fraction;
    EXPECT_NEAR(low(body) + body.size_m.z(), 1.2 * 0.20, kExact) << "its upper end stays";
  }
}

TEST(DrillTemplate, AHeadPulledDownLeavesHalfTheBody) {
  const DrillModel model = Example().Make(1.0, {0.0, 0.0}, 0.0, {.head_up_m = -1.0});
  EXPECT_NEAR(model.parts[1].size_m.z(), 0.08, kExact);
  EXPECT_TRUE(model.Check());
}

const SolidPart& Named(const DrillModel& model, const std::string& name) {
  const auto found = std::find_if(model.parts.begin(), model.parts.end(),
                                  [&name](const SolidPart& part) { return part.name == name; });
  EXPECT_NE(found, model.parts.end()) << name;
  return *found;
}

/// Where a part of the barrel drill begins and ends along x.
std::pair<double, double> ExtentAlongX(const DrillModel& model, const std::string& name) {
  const SolidPart& part = Named(model, name);
  const double half =
      0.5 * (part.shape == SolidPart::Shape::kBox ? part.size_m.x() : part.size_m.z());
  const double middle = part.object_from_part.translation().x();
  return {middle - half, middle + half};
}

DrillTemplate Barrel() {
  return ShippedDrillTemplates().front();
}

TEST(DrillTemplate, AHeadGrowsInFrontAndBehindByItself) {
  const DrillModel usual = Barrel().Make(1.0, {0.0, 0.0}, 0.05);
  const DrillModel longer = Barrel().Make(1.0, {0.0, 0.0}, 0.05, {.front_m = 0.02, .back_m = 0.03});
  for (const auto& [name, back, front] :
       {std::tuple("head", 0.03, 0.02), std::tuple("gear case", 0.0, 0.02),
        std::tuple("chuck", -0.02, 0.02), std::tuple("bit", -0.02, 0.02)}) {
    const auto [from, to] = ExtentAlongX(usual, name);
    const auto [other_from, other_to] = ExtentAlongX(longer, name);
    EXPECT_NEAR(other_from, from - back, kExact) << name;
    EXPECT_NEAR(other_to, to + front, kExact) << name;
  }
}

TEST(DrillTemplate, AChuckMayBeLongerAndANoseThinner) {
  const DrillModel usual = Barrel().Make(1.0, {0.0, 0.0}, 0.0);
  const DrillModel other = Barrel().Make(
      1.0, {0.0, 0.0}, 0.0, {.nose_fraction = 0.8, .chuck_fraction = 0.5, .chuck_longer_m = -0.02});
  EXPECT_NEAR(Named(other, "gear case").size_m.x(), 0.8 * Named(usual, "gear case").size_m.x(),
              kExact);
  EXPECT_NEAR(Named(other, "chuck").size_m.x(), 0.5 * Named(usual, "chuck").size_m.x(), kExact);
  EXPECT_NEAR(ExtentAlongX(other, "chuck").first, ExtentAlongX(usual, "chuck").first, kExact);
  EXPECT_NEAR(ExtentAlongX(other, "chuck").second, ExtentAlongX(usual, "chuck").second - 0.02,
              kExact);
  EXPECT_NEAR(other.bit_tip_m.x(), usual.bit_tip_m.x() - 0.02, kExact);
  EXPECT_EQ(Named(other, "head").size_m, Named(usual, "head").size_m);
  // However short: something is left of it.
  EXPECT_TRUE(Barrel().Make(0.75, {0.0, 0.0}, 0.0, {.chuck_longer_m = -1.0}).Check());
  EXPECT_TRUE(Barrel().Make(0.75, {0.0, 0.0}, 0.0, {.front_m = -1.0, .back_m = -1.0}).Check());
}

TEST(DrillTemplate, GripAndHeadAreAsThickAsTheyAre) {
  const DrillModel usual = Barrel().Make(1.0, {0.0, 0.0}, 0.0);
  const DrillModel other =
      Barrel().Make(1.0, {0.0, 0.0}, 0.0, {.grip_fraction = 0.8, .head_fraction = 1.2});
  EXPECT_NEAR(Named(other, "body").size_m.x(), 0.8 * Named(usual, "body").size_m.x(), kExact);
  EXPECT_NEAR(Named(other, "body").size_m.y(), 0.8 * Named(usual, "body").size_m.y(), kExact);
  EXPECT_EQ(Named(other, "body").size_m.z(), Named(usual, "body").size_m.z());
  EXPECT_NEAR(Named(other, "head").size_m.x(), 1.2 * Named(usual, "head").size_m.x(), kExact);
  EXPECT_EQ(Named(other, "head").size_m.z(), Named(usual, "head").size_m.z()) << "its length";
  EXPECT_EQ(Named(other, "chuck").size_m, Named(usual, "chuck").size_m);
  EXPECT_TRUE(other.Check());
}

TEST(DrillTemplate, ARakedGripCarriesALevelHead) {
  const double rake = 0.2;
  const DrillModel model = Barrel().Make(1.0, {0.0, 0.0}, 0.0, {.rake_rad = rake});
  const DrillModel usual = Barrel().Make(1.0, {0.0, 0.0}, 0.0);
  const SolidPart& head = Named(model, "head");
  EXPECT_NEAR((head.object_from_part.rotation().coeffs() -
               Named(usual, "head").object_from_part.rotation().coeffs())
                  .norm(),
              0.0, kExact);
  const double height = head.object_from_part.translation().z();
  EXPECT_NEAR(head.object_from_part.translation().x() -
                  Named(usual, "head").object_from_part.translation().x(),
              height * std::tan(rake), kExact);
  const Eigen::Vector3d grip =
      Named(model, "body").object_from_part.Rotate(Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(std::atan2(grip.x(), grip.z()), rake, kExact);
  EXPECT_NEAR((model.body_tilt_rad - Eigen::Vector2d(0.0, rake)).norm(), 0.0, kExact);
  EXPECT_NEAR(ExtentAlongX(model, "battery foot").first, ExtentAlongX(usual, "battery foot").first,
              kExact);
}

TEST(DrillModel, ALeanIsWhatItsTurnDoesToTheAxis) {
  const std::vector<Eigen::Vector2d> leans = {{0.0, 0.0}, {0.1, -0.2}, {-0.3, 0.05}};
  for (const Eigen::Vector2d& lean : leans)
    EXPECT_NEAR((LeanOf(BodyTurn(lean)) - lean).norm(), 0.0, kExact);
  const Eigen::Quaterniond about_z(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(LeanOf(about_z), Eigen::Vector2d::Zero());
}

TEST(DrillModel, IsDrawnWithItsBit) {
  const DrillModel bare = Example().Make(1.0, {0.0, 0.0}, 0.0);
  const DrillModel with_bit = Example().Make(1.0, {0.0, 0.0}, 0.07);
  EXPECT_GT(WireframeOf(with_bit).size(), WireframeOf(bare).size());
  double reach = 0.0;
  for (const auto& line : WireframeOf(with_bit))
    for (const Eigen::Vector3d& point : line) reach = std::max(reach, point.x());
  EXPECT_NEAR(reach, 0.18, 1e-6);
}

TEST(DrillModel, RefusesASizeThatIsNotAboveZero) {
  DrillModel model = Example().Make(1.0, {0.0, 0.0}, 0.0);
  EXPECT_TRUE(model.Check());
  model.parts[1].size_m.z() = 0.0;
  EXPECT_FALSE(model.Check());
  EXPECT_FALSE(DrillModel().Check());
}

}  // namespace
}  // namespace foresight
