#include "core/mission/pose_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/pose_messages.h"

namespace foresight {
namespace {

using nlohmann::json;
using testing::HasSubstr;

DrillParameters Drill() {
  DrillParameters drill;
  drill.model.template_name = "angle drill";
  drill.model.scale = 1.02;
  drill.model.body_tilt_rad = {0.01, -0.02};
  drill.model.bit_length_m = 0.05;
  drill.model.trigger_m = {0.03, 0.0, 0.15};
  drill.model.bit_tip_m = {0.2, 0.0, 0.19};
  return drill;
}

SurfaceParameters Surface() {
  return {TerrainSurface::Kind::kBlock, {0.39, 0.19}, {0.3, 0.1}, 0.26, 0.14};
}

std::vector<PoseMessage> Samples() {
  std::vector<PoseMessage> samples(6, SamplePose());
  samples[1].parameters = Drill();
  samples[2].parameters = Surface();
  samples[4].parameters = HandleParameters{
      {0.131, 0.018, 0.007, -0.003, 0.0095, 0.052, true, HandleModel::Plate::kLong}};
  samples[5].parameters = CylinderParameters{{0.05, 0.7}};
  samples[5].probability.reset();
  samples[3].is_winner = false;
  samples[3].candidate = 1;
  samples[3].probability.reset();
  samples[3].covariance.reset();
  samples[3].frame = PoseMessage::Frame::kBase;
  samples[3].origin = PoseMessage::Origin::kReview;
  samples[3].simulated = true;
  samples[3].decision = Decision::kOpen;
  samples[3].decided_by = "caf\xc3\xa9 \"x\"";
  samples[3].scan_begin_utc_ns = std::numeric_limits<std::int64_t>::max();
  return samples;
}

/// The sample as JSON, to be changed.
json Sample() {
  return json::parse(PoseMessageToJson(SamplePose()));
}

std::string Fault(const json& value) {
  const auto read = PoseMessageFromJson(value.dump());
  if (read) return "";
  EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  return read.error().message;
}

TEST(PoseJson, IsOneLineAndSurvivesTheRoundTrip) {
  for (const PoseMessage& sample : Samples()) {
    const std::string line = PoseMessageToJson(sample);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_LT(line.size(), 2000u) << "two seconds of a link with 9600 bit/s";
    const auto read = PoseMessageFromJson(line);
    ASSERT_TRUE(read) << read.error().message << line;
    EXPECT_EQ(PoseMessageToJson(*read), line);
    EXPECT_EQ(read->position_m, sample.position_m);
    EXPECT_EQ(read->covariance, sample.covariance);
    EXPECT_EQ(read->scan_begin_utc_ns, sample.scan_begin_utc_ns);
    EXPECT_EQ(read->Id(), sample.Id());
    EXPECT_EQ(read->decided_by, sample.decided_by);
  }
}

TEST(PoseJson, SaysWhatARobotNeedsInTheWordsOfTheRecords) {
  const json value = Sample();
  EXPECT_EQ(value["version"], 1);
  EXPECT_EQ(value["id"], "6f9619ff-8b86-4d01-b42d-00cf4fc964ff/3");
  EXPECT_EQ(value["object"], "valve");
  EXPECT_EQ(value["parameters"]["spokes"], 3);
  EXPECT_EQ(value["frame"], "robot");
  EXPECT_EQ(value["quaternion_wxyz"], (json{0.5, 0.5, -0.5, 0.5}));
  EXPECT_EQ(value["covariance"][5][5], 1e-6);
  EXPECT_EQ(value["verdict"], "CONFIRMED");
  EXPECT_EQ(value["decision"], "accepted");
  EXPECT_EQ(value["origin"], "live");
  EXPECT_EQ(value["scan_begin_utc_ns"], 1'700'000'000'123'456'789);
}

TEST(PoseJson, EveryMemberMustBeThereAndIsNamedWhereItIsNot) {
  const json sample = Sample();
  for (const auto& [key, ignored] : sample.items()) {
    json value = sample;
    value.erase(key);
    EXPECT_THAT(Fault(value), HasSubstr("'" + key + "'"));
  }
}

TEST(PoseJson, NoMemberIsTakenAsAnotherType) {
  // An empty object is right for no member, and null is right where something may not be known.
  const json sample = Sample();
  for (const auto& [key, ignored] : sample.items()) {
    json value = sample;
    value[key] = json::object();
    EXPECT_NE(Fault(value), "") << key;
    if (key == "covariance" || key == "probability") continue;
    value[key] = nullptr;
    EXPECT_NE(Fault(value), "") << key;
  }
}

TEST(PoseJson, NoParameterIsTakenAsAnotherTypeOrLeftOut) {
  for (const PoseMessage& sample : Samples()) {
    const json good = json::parse(PoseMessageToJson(sample));
    for (const auto& [key, ignored] : good["parameters"].items()) {
      json value = good;
      value["parameters"][key] = json::object();
      EXPECT_NE(Fault(value), "") << key;
      // Poses of earlier programs have none.
      if (key.ends_with("_depth_ratio") || key == "behind_m" || key == "bow_m" || key == "lift_m")
        continue;
      value["parameters"].erase(key);
      EXPECT_NE(Fault(value), "") << key;
    }
  }
}

TEST(PoseJson, ValuesOutOfRangeAreNamed) {
  const auto with = [](const char* key, const json& member) {
    json value = Sample();
    value[key] = member;
    return Fault(value);
  };
  EXPECT_EQ(with("version", 2), "pose: version 2 is not known; this program reads 1");
  for (const char* id :
       {"", "a", "a/", "/1", "a/0", "a/01", "a/-1", "a/1x", "a/99999999", "a/1/2", "a b/1"})
    EXPECT_THAT(with("id", id), HasSubstr("'id'")) << id;
  EXPECT_THAT(with("object", "wheel"), HasSubstr("'object' is not known"));
  EXPECT_THAT(with("frame", "camera"), HasSubstr("'frame' is not known"));
  EXPECT_THAT(with("position_m", {1, 2}), HasSubstr("'position_m' is not 3 numbers"));
  EXPECT_THAT(with("position_m", {1, 2, 3, 4}), HasSubstr("'position_m'"));
  EXPECT_THAT(with("position_m", {1, 2, 1e9}), HasSubstr("'position_m' is"));
  EXPECT_THAT(with("quaternion_wxyz", {1, 1, 0, 0}), HasSubstr("'quaternion_wxyz' has length"));
  EXPECT_THAT(with("covariance", json::array()), HasSubstr("6 rows of 6 numbers"));
  EXPECT_THAT(with("verdict", "SURE"), HasSubstr("'verdict' is not known"));
  EXPECT_THAT(with("probability", 1.5), HasSubstr("'probability'"));
  EXPECT_THAT(with("candidate", -1), HasSubstr("'candidate'"));
  EXPECT_THAT(with("decision", "yes"), HasSubstr("'decision' is not known"));
  EXPECT_THAT(with("origin", "replay"), HasSubstr("'origin' is not known"));
  EXPECT_THAT(with("scan_begin_utc_ns", 18446744073709551615ULL), HasSubstr("whole number"));
  EXPECT_THAT(with("scan_begin_utc_ns", 1.5), HasSubstr("whole number"));
  EXPECT_THAT(with("rig", "abc"), HasSubstr("'rig'"));
  EXPECT_THAT(with("age_s", -0.1), HasSubstr("'age_s'"));
}

TEST(PoseJson, ANumberThatIsNotFiniteIsWrittenSoThatNobodyTakesIt) {
  PoseMessage message = SamplePose();
  message.position_m.x() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(PoseMessageFromJson(PoseMessageToJson(message)).error().message,
              HasSubstr("'position_m'"));
}

TEST(PoseJson, MembersThatAreNotKnownAreIgnored) {
  json value = Sample();
  value["more"] = "later";
  EXPECT_EQ(Fault(value), "");
}

TEST(PoseJson, RefusesWhatIsTooLongOrNoJson) {
  EXPECT_THAT(PoseMessageFromJson(std::string(20'000, ' ')).error().message,
              HasSubstr("20000 bytes, more than 16384"));
  for (const char* text : {"", "{", "[]", "null", "1", "\xff", "{\"version\":1}"})
    EXPECT_FALSE(PoseMessageFromJson(text)) << text;
}

}  // namespace
}  // namespace foresight
