#include "core/detection/detection_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/objects/drill_template.h"

namespace foresight {
namespace {

ValveDetection Sample() {
  ValveDetection detection;
  detection.best = {{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.1, -0.2, 1.3}},
                    {0.12, 0.013, 4, 0.009, 0.024, 0.031},
                    1234.5};
  detection.best.brightness = 0.7;
  detection.best.model.rim_depth_ratio = 0.4;
  detection.best.model.spoke_depth_ratio = 1.6;
  detection.phase_observable = false;
  detection.sigma_position_m = {0.001, 0.002, 0.003};
  detection.sigma_axis_rad = 0.01;
  detection.sigma_phase_rad = 0.02;
  detection.evidence = {900, 200, 0.9, 0.03, 0.02, 0.006, 0.95, 88.0, 700.0};
  detection.evidence.weakest_spoke = 0.4;
  detection.evidence.weakest_spoke_nats = -3.5;
  detection.evidence.weakest_spoke_middle_nats = -1.5;
  detection.evidence.further_spoke_nats = 7.25;
  detection.evidence.rim_nats = 640.5;
  detection.evidence.weakest_arc_nats = -4.5;
  detection.evidence.weakest_quarter_nats = 12.5;
  detection.evidence.pipe_margin_nats = 31.5;
  detection.evidence.outline_nats_per_px = 0.125;
  detection.evidence.weakest_outline_nats_per_px = -0.25;
  detection.evidence.further_outline_nats_per_px = 0.0625;
  detection.evidence.margin_line_sigmas = 2.25;
  detection.verdict = {VerdictLevel::kLikely, 0.83, "only 58 % of the rim is seen", {}};
  detection.alternatives = {detection.best};
  detection.alternatives[0].model.spokes = 2;
  detection.origin.roi = ImageRoi::Rectangle(0.25, {10.0, 20.0}, {30.5, 40.0});
  detection.origin.seconds = 0.4;
  detection.origin.source = "jbu";
  detection.origin.image = true;
  detection.verdict.features = {0.5, -3.25};
  detection.verdict.failed_gates = {"too few measurements", "a disc fits as well"};
  detection.covariance = PoseCovariance::Identity() * 1e-6;
  return detection;
}

TEST(DetectionJson, SurvivesTheRoundTrip) {
  const ValveDetection sample = Sample();
  const auto any = DetectionFromJson(DetectionToJson(sample, {}));
  ASSERT_TRUE(any) << any.error().message;
  const auto* read = std::get_if<ValveDetection>(&*any);
  ASSERT_NE(read, nullptr);
  EXPECT_TRUE(read->best.base_from_object.Matrix() == sample.best.base_from_object.Matrix());
  EXPECT_EQ(read->best.model.spokes, 4);
  EXPECT_EQ(read->best.model.dish_m, sample.best.model.dish_m);
  EXPECT_EQ(read->best.model.rim_depth_ratio, 0.4);
  EXPECT_EQ(read->best.model.spoke_depth_ratio, 1.6);
  EXPECT_FALSE(read->phase_observable);
  EXPECT_EQ(read->sigma_position_m, sample.sigma_position_m);
  EXPECT_EQ(read->evidence.hits, 200);
  EXPECT_EQ(read->evidence.gain_nats, 700.0);
  EXPECT_EQ(read->evidence.weakest_spoke, 0.4);
  EXPECT_EQ(read->evidence.weakest_spoke_nats, -3.5);
  EXPECT_EQ(read->evidence.weakest_spoke_middle_nats, -1.5);
  EXPECT_EQ(read->evidence.further_spoke_nats, 7.25);
  EXPECT_EQ(read->evidence.rim_nats, 640.5);
  EXPECT_EQ(read->evidence.weakest_arc_nats, -4.5);
  EXPECT_EQ(read->evidence.weakest_quarter_nats, 12.5);
  EXPECT_EQ(read->evidence.pipe_margin_nats, 31.5);
  EXPECT_EQ(read->evidence.outline_nats_per_px, 0.125);
  EXPECT_EQ(read->evidence.weakest_outline_nats_per_px, -0.25);
  EXPECT_EQ(read->evidence.further_outline_nats_per_px, 0.0625);
  EXPECT_EQ(read->evidence.margin_line_sigmas, 2.25);
  EXPECT_EQ(read->best.brightness, 0.7);
  EXPECT_EQ(read->verdict.level, VerdictLevel::kLikely);
  EXPECT_EQ(read->verdict.reason, sample.verdict.reason);
  ASSERT_EQ(read->alternatives.size(), 1U);
  EXPECT_EQ(read->alternatives[0].model.spokes, 2);
  EXPECT_EQ(read->origin.source, "jbu");
  EXPECT_TRUE(read->origin.image);
  EXPECT_EQ(read->verdict.features, sample.verdict.features);
  EXPECT_EQ(read->verdict.failed_gates, sample.verdict.failed_gates);
  EXPECT_EQ(read->covariance, sample.covariance);
  EXPECT_EQ(std::get<ImageRoi>(read->origin.roi).polygon,
            std::get<ImageRoi>(sample.origin.roi).polygon);
  // And the text itself is stable.
  EXPECT_EQ(DetectionToJson(*read, {}), DetectionToJson(sample, {}));
}

TEST(DetectionJson, AValveOfAnOlderProgramIsRound) {
  nlohmann::json old = nlohmann::json::parse(DetectionToJson(Sample(), {}));
  for (auto* candidate : {&old["best"], &old["alternatives"][0]})
    for (const char* ratio : {"rim_depth_ratio", "spoke_depth_ratio"})
      ASSERT_EQ((*candidate)["model"].erase(ratio), 1U);
  const auto any = DetectionFromJson(old.dump());
  ASSERT_TRUE(any) << any.error().message;
  const ValveModel& model = std::get<ValveDetection>(*any).best.model;
  EXPECT_EQ(model.rim_depth_ratio, 1.0);
  EXPECT_EQ(model.spoke_depth_ratio, 1.0);
}

DrillDetection SampleDrill() {
  DrillDetection drill;
  drill.best.base_from_object = {Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.1, 0.2, 1.0}};
  drill.best.model = ShippedDrillTemplates().front().Make(1.05, {0.02, -0.03}, 0.06);
  drill.best.log_likelihood = 90.0;
  drill.sigma_yaw_rad = 0.04;
  drill.table = Plane{-Eigen::Vector3d::UnitY(), 0.2};
  drill.evidence.best_alternative = "box";
  drill.evidence.flip_margin_nats = 21.0;
  drill.evidence.no_foot_margin_nats = 63.5;
  drill.evidence.nozzle_margin_nats = 12.25;
  drill.evidence.no_chuck_margin_nats = 8.5;
  drill.evidence.unusual_nats = 1.75;
  drill.alternatives = {drill.best};
  drill.alternatives[0].log_likelihood = 80.0;
  drill.verdict = {VerdictLevel::kConfirmed, 0.97, "drill", {1.0}};
  drill.origin.roi = BoxRoi{drill.best.base_from_object, {0.3, 0.4, 0.5}};
  return drill;
}

TEST(DetectionJson, ADrillSurvivesTheRoundTrip) {
  const DrillDetection sample = SampleDrill();
  const auto any = DetectionFromJson(DetectionToJson(sample, {}));
  ASSERT_TRUE(any) << any.error().message;
  const auto* read = std::get_if<DrillDetection>(&*any);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->best.model.parts.size(), sample.best.model.parts.size());
  EXPECT_EQ(read->table->offset, 0.2);
  EXPECT_EQ(read->evidence.no_foot_margin_nats, 63.5);
  EXPECT_EQ(read->evidence.nozzle_margin_nats, 12.25);
  EXPECT_EQ(read->evidence.no_chuck_margin_nats, 8.5);
  EXPECT_EQ(read->evidence.unusual_nats, 1.75);
  std::string old = DetectionToJson(sample, {});
  old.replace(old.find("63.5"), 4, "null");
  const auto older = DetectionFromJson(old);
  ASSERT_TRUE(older) << older.error().message;
  EXPECT_EQ(std::get<DrillDetection>(*older).evidence.no_foot_margin_nats, std::nullopt);
  EXPECT_EQ(std::get<BoxRoi>(read->origin.roi).size_m, Eigen::Vector3d(0.3, 0.4, 0.5));
  EXPECT_EQ(DetectionToJson(*read, {}), DetectionToJson(sample, {}));
}

TEST(DetectionJson, ADrillSaysWhereToGraspAndByHowMuchItBeatsItsAlternatives) {
  const Rigid<frame::Robot, frame::Base> mounted(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5});
  const auto json = nlohmann::json::parse(DetectionToJson(SampleDrill(), mounted));
  const double in_base = json["grasp"]["bit_tip_in_base_m"][2];
  EXPECT_NEAR(json["grasp"]["bit_tip_in_robot_m"][2].get<double>(), in_base + 1.5, 1e-12);
  EXPECT_EQ(json["alternatives"][0]["margin_nats"], 10.0);
  // Turned by 180 deg about x.
  EXPECT_EQ(json["best"]["base_from_object"]["z_axis"], nlohmann::json({0.0, 0.0, -1.0}));
}

HandleDetection SampleHandle() {
  HandleDetection handle;
  handle.best.base_from_object = {Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.1, 0.2, 1.0}};
  handle.best.model = {0.131, 0.021, -0.006, 0.004, 0.0095, 0.052, true, HandleModel::Plate::kLong};
  handle.best.log_likelihood = 90.0;
  handle.door = {-Eigen::Vector3d::UnitY(), 0.2};
  handle.sigma_length_m = 0.004;
  handle.evidence.best_alternative = "pull bar";
  handle.evidence.mirror_margin_nats = 12.0;
  handle.alternatives = {handle.best, handle.best};
  handle.alternatives[0].log_likelihood = 78.0;
  handle.alternatives[1].model.length_m = 0.111;
  handle.verdict = {VerdictLevel::kLikely, 0.9, "handle", {1.0}};
  handle.origin.roi = BoxRoi{handle.best.base_from_object, {0.3, 0.4, 0.5}};
  return handle;
}

TEST(DetectionJson, ADoorHandleSurvivesTheRoundTripAndSaysHowFarTheFlippedOneIsBehind) {
  const std::string text = DetectionToJson(SampleHandle(), {});
  const auto any = DetectionFromJson(text);
  ASSERT_TRUE(any) << any.error().message;
  const auto* read = std::get_if<HandleDetection>(&*any);
  ASSERT_NE(read, nullptr);
  EXPECT_TRUE(read->best.model.returned);
  EXPECT_EQ(read->best.model.plate, HandleModel::Plate::kLong);
  EXPECT_EQ(read->door.offset, 0.2);
  EXPECT_EQ(read->alternatives[1].model.length_m, 0.111);
  EXPECT_EQ(read->best.model.behind_m, 0.021);
  EXPECT_EQ(read->best.model.bow_m, -0.006);
  EXPECT_EQ(read->best.model.lift_m, 0.004);
  EXPECT_EQ(DetectionToJson(*read, {}), text);
  EXPECT_EQ(nlohmann::json::parse(text)["alternatives"][0]["margin_nats"], 12.0);
}

TEST(DetectionJson, ADoorHandleThatIsLongerThanAMetreOrOnAnUnknownPlateIsRefused) {
  for (const auto& [key, value] : {std::pair<const char*, nlohmann::json>{"length_m", 1.5},
                                   {"length_m", -0.1},
                                   {"behind_m", -0.001},
                                   {"behind_m", 0.5},
                                   {"bow_m", -0.3},
                                   {"lift_m", "high"},
                                   {"plate", "round"}}) {
    nlohmann::json wrong = nlohmann::json::parse(DetectionToJson(SampleHandle(), {}));
    wrong["best"]["model"][key] = value;
    EXPECT_FALSE(DetectionFromJson(wrong.dump())) << key;
  }
}

TEST(DetectionJson, ADoorHandleOfBeforeLeversWentOnBehindTheirPivotAndWereBowedIsStraight) {
  nlohmann::json older = nlohmann::json::parse(DetectionToJson(SampleHandle(), {}));
  for (const char* key : {"behind_m", "bow_m", "lift_m"}) older["best"]["model"].erase(key);
  const auto read = DetectionFromJson(older.dump());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(std::get<HandleDetection>(*read).best.model.behind_m, 0.0);
  EXPECT_EQ(std::get<HandleDetection>(*read).best.model.bow_m, 0.0);
  EXPECT_EQ(std::get<HandleDetection>(*read).best.model.lift_m, 0.0);
}

TEST(DetectionJson, ACylinderSurvivesTheRoundTripWithoutAProbability) {
  CylinderDetection sample;
  sample.base_from_object = {Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.1, 0.2, 1.0}};
  sample.model = {0.05, 0.7};
  sample.sigma_radius_m = 0.004;
  sample.covariance(0, 0) = 1e-6;
  sample.evidence.hits = 77;
  sample.evidence.in_drawn_box = 0.75;
  sample.verdict = {VerdictLevel::kLikely, std::nan(""), "77 beams on it", {}, {"never confirmed"}};
  sample.origin.roi = BoxRoi{sample.base_from_object, {0.3, 0.4, 0.5}};
  const std::string text = DetectionToJson(sample, {});
  EXPECT_TRUE(nlohmann::json::parse(text)["probability"].is_null());
  const auto any = DetectionFromJson(text);
  ASSERT_TRUE(any) << any.error().message;
  const auto* read = std::get_if<CylinderDetection>(&*any);
  ASSERT_NE(read, nullptr);
  EXPECT_TRUE(std::isnan(read->verdict.probability));
  EXPECT_EQ(read->model.radius_m, 0.05);
  EXPECT_EQ(read->evidence.in_drawn_box, 0.75);
  EXPECT_EQ(read->covariance(0, 0), 1e-6);
  EXPECT_TRUE(std::isnan(read->covariance(2, 2)));
  EXPECT_EQ(DetectionToJson(*read, {}), text);
}

TEST(DetectionJson, AlternativesThatWereCalledRivalsAreRead) {
  const std::string text = DetectionToJson(SampleDrill(), {});
  nlohmann::json old = nlohmann::json::parse(text);
  old["rivals"] = old["alternatives"];
  old.erase("alternatives");
  EXPECT_EQ(DetectionToJson(DetectionFromJson(old.dump()).value(), {}), text);
  old.erase("rivals");
  EXPECT_FALSE(DetectionFromJson(old.dump()));
}

TEST(DetectionJson, EvidenceUnderItsOldNamesIsRead) {
  const auto with_old_names = [](const std::string& text) {
    nlohmann::json json = nlohmann::json::parse(text);
    nlohmann::json& evidence = json["evidence"];
    for (const auto& [name, old_name] : {std::pair("inlier_ratio", "inlier_share"),
                                         std::pair("alternative_margin_nats", "rival_margin_nats"),
                                         std::pair("best_alternative", "best_rival")}) {
      if (!evidence.contains(name)) continue;
      evidence[old_name] = evidence[name];
      evidence.erase(name);
    }
    return json.dump();
  };
  DrillDetection drill = SampleDrill();
  drill.evidence.inlier_ratio = 0.9;
  drill.evidence.alternative_margin_nats = 12.0;
  const std::string drill_text = DetectionToJson(drill, {});
  EXPECT_NE(with_old_names(drill_text), nlohmann::json::parse(drill_text).dump());
  EXPECT_EQ(DetectionToJson(DetectionFromJson(with_old_names(drill_text)).value(), {}), drill_text);
  const std::string valve_text = DetectionToJson(Sample(), {});
  EXPECT_NE(with_old_names(valve_text), nlohmann::json::parse(valve_text).dump());
  EXPECT_EQ(DetectionToJson(DetectionFromJson(with_old_names(valve_text)).value(), {}), valve_text);
  // Neither name: no detection.
  nlohmann::json neither = nlohmann::json::parse(valve_text);
  neither["evidence"].erase("inlier_ratio");
  EXPECT_FALSE(DetectionFromJson(neither.dump()));
}

TEST(DetectionJson, TerrainSurvivesTheRoundTripWithEverySurface) {
  TerrainDetection sample;
  TerrainSurface block;
  block.kind = TerrainSurface::Kind::kBlock;
  block.base_from_object = {Eigen::Quaterniond::Identity(), {0.5, 0.6, 2.0}};
  block.size_m = {0.397, 0.390};
  block.evidence = {.points = 400,
                    .cover = 0.9,
                    .see_through = 0.01,
                    .outside = 0.02,
                    .confirmed_edges = 4,
                    .rms_m = 0.004,
                    .outline_nats = 1.5,
                    .size_margin = -0.07,
                    .size_nats = 0.02};
  block.toehold = {{0.357, 0.350}, 0.26, 0.19, 0.002, 0.004};
  block.verdict = {VerdictLevel::kConfirmed, 0.98, "four edges", {}};
  block.shift_m = 0.031;
  TerrainSurface ground;
  ground.kind = TerrainSurface::Kind::kGround;
  sample.surfaces = {block, ground};
  sample.origin.roi = ImageRoi::Rectangle(0.0, {0, 0}, {9, 9});
  const auto any = DetectionFromJson(DetectionToJson(sample, {}));
  ASSERT_TRUE(any) << any.error().message;
  const auto* read = std::get_if<TerrainDetection>(&*any);
  ASSERT_NE(read, nullptr);
  ASSERT_EQ(read->surfaces.size(), 2U);
  EXPECT_EQ(read->surfaces[0].evidence.confirmed_edges, 4);
  EXPECT_EQ(read->surfaces[0].evidence.outline_nats, 1.5);
  EXPECT_EQ(read->surfaces[0].evidence.size_margin, -0.07);
  EXPECT_EQ(read->surfaces[0].evidence.size_nats, 0.02);
  EXPECT_EQ(read->surfaces[0].toehold.step_m, 0.19);
  EXPECT_TRUE(std::isnan(read->surfaces[1].toehold.step_m));
  EXPECT_EQ(read->surfaces[1].kind, TerrainSurface::Kind::kGround);
  EXPECT_EQ(DetectionToJson(*read, {}), DetectionToJson(sample, {}));
}

TEST(DetectionJson, AValveOfAnOlderRecordIsStillRead) {
  auto json = nlohmann::json::parse(DetectionToJson(Sample(), {}));
  for (const char* added_later : {"source", "features", "gates", "covariance"})
    json.erase(added_later);
  for (const char* added_later : {"kind", "lever_length_m"})
    json["best"]["model"].erase(added_later);
  const auto any = DetectionFromJson(json.dump());
  ASSERT_TRUE(any) << any.error().message;
  const auto& read = std::get<ValveDetection>(*any);
  EXPECT_EQ(read.origin.source, "raw");
  EXPECT_TRUE(read.verdict.features.empty());
  EXPECT_TRUE(read.verdict.failed_gates.empty());
  EXPECT_TRUE(read.covariance.hasNaN());
  EXPECT_FALSE(read.best.model.IsLever());
}

std::string FaultOf(const nlohmann::json& json) {
  const auto read = DetectionFromJson(json.dump());
  if (read) return "was read";
  EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  return read.error().message;
}

TEST(DetectionJson, NumbersThatNoObjectHasAreRefusedByName) {
  const auto valve = nlohmann::json::parse(DetectionToJson(Sample(), {}));
  const std::string model = "/best/model/";
  for (const auto& [member, value] : std::vector<std::pair<std::string, nlohmann::json>>{
           {model + "spokes", 1'000'000'000},
           {model + "spokes", 1e300},
           {model + "spokes", -1},
           {model + "rim_radius_m", 1e308},
           {model + "tube_radius_m", nullptr},
           {model + "rim_depth_ratio", -1.0},
           {model + "spoke_depth_ratio", 1e9},
           {model + "dish_m", -1e9},
           {"/alternatives/0/model/spokes", 7},
           {"/evidence/hits", 1e10},
           {"/best/base_from_object/position_m", {0.0, 0.0, 1e308}},
           {"/best/base_from_object/position_m", {0.0, nullptr, 1.0}},
           {"/roi/polygon_px", {{0.0, 0.0}, {1e300, 0.0}, {1.0, 1.0}}},
           {"/alternatives", 3}}) {
    nlohmann::json changed = valve;
    changed[nlohmann::json::json_pointer(member)] = value;
    const std::string fault = FaultOf(changed);
    EXPECT_NE(fault, "was read") << member << value;
    const std::string name = member.substr(member.rfind('/') + 1);
    EXPECT_NE(fault.find(name == "polygon_px" ? "polygon" : name), std::string::npos) << fault;
  }
}

TEST(DetectionJson, ADrillOfAbsurdPartsIsRefused) {
  const auto drill = nlohmann::json::parse(DetectionToJson(SampleDrill(), {}));
  for (const auto& [member, value] : std::vector<std::pair<std::string, nlohmann::json>>{
           {"/best/model/parts/0/size_m", {1e308, 1.0, 1.0}},
           {"/best/model/parts/0/size_m", {-1.0, 1.0, 1.0}},
           {"/best/model/scale", 1e9},
           {"/best/model/bit_length_m", 1e9},
           {"/best/model/trigger_m", {0.0, 0.0, 1e9}}}) {
    nlohmann::json changed = drill;
    changed[nlohmann::json::json_pointer(member)] = value;
    EXPECT_NE(FaultOf(changed), "was read") << member << value;
  }
}

TEST(DetectionJson, ATextThatIsNoUtf8IsStillWrittenAsJson) {
  DrillDetection drill = SampleDrill();
  drill.best.model.template_name = "caf\xe9";
  EXPECT_NO_THROW(nlohmann::json::parse(DetectionToJson(drill, {})));
}

TEST(DetectionJson, TellsThePoseInTheRobotsFrameToo) {
  const Rigid<frame::Robot, frame::Base> mounted(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5});
  const std::string text = DetectionToJson(Sample(), mounted);
  EXPECT_NE(text.find("robot_from_object"), std::string::npos);
  EXPECT_NE(text.find("2.8"), std::string::npos);  // 1.3 + 1.5 along z
}

TEST(DetectionJson, AnUnknownLikelihoodStaysUnknown) {
  ValveDetection sample = Sample();
  sample.evidence.margin_nats = std::numeric_limits<double>::quiet_NaN();
  const auto read = DetectionFromJson(DetectionToJson(sample, {}));
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(std::get<ValveDetection>(*read).evidence.margin_nats));
}

TEST(DetectionJson, RefusesDamagedText) {
  const std::string whole = DetectionToJson(Sample(), {});
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{\"kind\": \"valve\"}"),
        whole.substr(0, whole.size() / 2)}) {
    const auto read = DetectionFromJson(text);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  }
}

}  // namespace
}  // namespace foresight
