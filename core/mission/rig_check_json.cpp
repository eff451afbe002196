#include "core/mission/rig_check_json.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/io/json_numbers.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kMost = 1e9;
constexpr int kMostCounted = 10'000'000;  // sums of them stay numbers

/// Row by row.
template <class Matrix>
OrderedJson NumbersJson(const Matrix& matrix) {
  OrderedJson numbers = OrderedJson::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      numbers.push_back(FiniteOrNull(matrix(row, column)));
  return numbers;
}

/// null = infinite.
double NumberFrom(const nlohmann::json& number, const char* key) {
  if (number.is_null()) return std::numeric_limits<double>::infinity();
  const double value = number.get<double>();
  if (!(std::abs(value) <= kMost))
    throw std::invalid_argument(fmt::format("'{}' holds {}, which nothing measures", key, value));
  return value;
}

template <class Matrix>
void ReadNumbers(const nlohmann::json& object, const char* key, Matrix& matrix) {
  const auto size = static_cast<std::size_t>(matrix.size());
  const nlohmann::json& list = ListIn(object, key, size);
  if (list.size() != size)
    throw std::invalid_argument(fmt::format("'{}' has {} numbers, not {}", key, list.size(), size));
  std::size_t at = 0;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      matrix(row, column) = NumberFrom(list[at++], key);
}

/// Averages are weighed by the inverse.
template <class Matrix>
bool CanBeInverted(const Matrix& matrix) {
  return matrix.allFinite() && matrix.llt().info() == Eigen::Success;
}

OrderedJson CameraJson(const CameraCheck& camera) {
  return {{"depth_edges", camera.edges},
          {"images", camera.images},
          {"score", camera.score},
          {"score_before", camera.score_before},
          {"score_aside", camera.score_aside},
          {"gain_sigmas", camera.gain_sigmas},
          {"turn_rad", NumbersJson(camera.turn_rad)},
          {"covariance", NumbersJson(camera.covariance)},
          {"outward_px", NumbersJson(camera.outward_px)}};
}

CameraCheck CameraFrom(const nlohmann::json& json) {
  CameraCheck camera;
  camera.edges = IntegerIn(json, "depth_edges", 1, kMostCounted);
  camera.images = IntegerIn(json, "images", 0, 1'000'000);
  camera.score = NumberIn(json, "score", -kMost, kMost);
  camera.score_before = NumberIn(json, "score_before", -kMost, kMost);
  camera.score_aside = NumberIn(json, "score_aside", -kMost, kMost);
  camera.gain_sigmas = NumberIn(json, "gain_sigmas", -kMost, kMost);
  ReadNumbers(json, "turn_rad", camera.turn_rad);
  ReadNumbers(json, "covariance", camera.covariance);
  ReadNumbers(json, "outward_px", camera.outward_px);
  return camera;
}

OrderedJson PlateJson(const PlateCheck& plate) {
  return {{"planes", plate.planes},
          {"cells", plate.cells},
          {"up_and_down", plate.up_and_down},
          {"residual_m", plate.residual_m},
          {"speed_rad_s", plate.speed_rad_s},
          {"drift", NumbersJson(plate.drift)},
          {"covariance", NumbersJson(plate.covariance)}};
}

PlateCheck PlateFrom(const nlohmann::json& json) {
  PlateCheck plate;
  plate.planes = IntegerIn(json, "planes", 1, kMostCounted);
  plate.cells = IntegerIn(json, "cells", 1, kMostCounted);
  json.at("up_and_down").get_to(plate.up_and_down);
  plate.residual_m = NumberIn(json, "residual_m", 0.0, kMost);
  plate.speed_rad_s = NumberIn(json, "speed_rad_s", 0.0, kMost);
  ReadNumbers(json, "drift", plate.drift);
  ReadNumbers(json, "covariance", plate.covariance);
  return plate;
}

OrderedJson TurnsJson(const TurnCheck& turns) {
  return {{"images", turns.images},
          {"points", turns.points},
          {"explained", turns.explained},
          {"spread_rad", turns.spread_rad},
          {"bend_seen", turns.bend_seen},
          {"drift", NumbersJson(turns.drift)},
          {"covariance", NumbersJson(turns.covariance)}};
}

TurnCheck TurnsFrom(const nlohmann::json& json) {
  TurnCheck turns;
  turns.images = IntegerIn(json, "images", 2, 1'000'000);
  turns.points = IntegerIn(json, "points", 1, kMostCounted);
  turns.explained = NumberIn(json, "explained", 0.0, 1.0);
  turns.spread_rad = NumberIn(json, "spread_rad", 0.0, kMost);
  json.at("bend_seen").get_to(turns.bend_seen);
  ReadNumbers(json, "drift", turns.drift);
  ReadNumbers(json, "covariance", turns.covariance);
  return turns;
}

OrderedJson PassesJson(const PassCheck& passes) {
  return {{"patches", passes.patches},
          {"speed_rad_s", passes.speed_rad_s},
          {"stamp_s", passes.stamp_s},
          {"sigma_s", passes.sigma_s}};
}

PassCheck PassesFrom(const nlohmann::json& json) {
  PassCheck passes;
  constexpr double kLeast = 1e-9;  // what is averaged is weighed by the inverse
  passes.patches = IntegerIn(json, "patches", 1, kMostCounted);
  passes.speed_rad_s = NumberIn(json, "speed_rad_s", kLeast, kMost);
  passes.stamp_s = NumberIn(json, "stamp_s", -kMost, kMost);
  passes.sigma_s = NumberIn(json, "sigma_s", kLeast, kMost);
  return passes;
}

/// Of an earlier program, or of one with other unknowns, they are not there.
bool HasMeasurements(const nlohmann::json& json, const char* key, const char* value,
                     std::size_t unknowns) {
  return json.contains(key) && json[key].contains(value) && json[key][value].size() == unknowns;
}

bool CanBeAveraged(const PlateCheck& plate) {
  // A scan that sweeps one way says nothing of the stamps, the last unknown.
  static_assert(PlateCheck::kStamp + 1 == PlateCheck::kUnknowns);
  constexpr int kOthers = PlateCheck::kStamp;
  return plate.up_and_down
             ? CanBeInverted(plate.covariance)
             : CanBeInverted(plate.covariance.topLeftCorner<kOthers, kOthers>().eval());
}

bool CanBeAveraged(const TurnCheck& turns) {
  Eigen::Matrix<double, TurnCheck::kUnknowns, TurnCheck::kUnknowns> covariance = turns.covariance;
  // Two images say nothing of the bend.
  if (!turns.bend_seen) covariance(TurnCheck::kBend, TurnCheck::kBend) = 1.0;
  return CanBeInverted(covariance);
}

}  // namespace

std::string RigCheckToJson(const RigCheck& check) {
  OrderedJson findings = OrderedJson::array();
  for (const RigFinding& finding : check.findings)
    findings.push_back({{"name", finding.name},
                        {"state", ToString(finding.state)},
                        {"value", FiniteOrNull(finding.value)},
                        {"sigma", FiniteOrNull(finding.sigma)},
                        {"limit", FiniteOrNull(finding.limit)},
                        {"unit", finding.unit}});
  OrderedJson json = {{"findings", findings}, {"drifted", check.drifted}};
  if (check.camera)
    json["camera"] = CameraJson(*check.camera);
  else
    json["no_camera"] = check.no_camera;
  if (check.plate)
    json["plate"] = PlateJson(*check.plate);
  else
    json["no_plate"] = check.no_plate;
  if (check.turns)
    json["turns"] = TurnsJson(*check.turns);
  else
    json["no_turns"] = check.no_turns;
  if (check.passes)
    json["passes"] = PassesJson(*check.passes);
  else
    json["no_passes"] = check.no_passes;
  return json.dump();
}

RigCheck RigMeasurementsFromJson(const nlohmann::json& json) {
  RigCheck check;
  const std::string nothing = "the check that was kept holds no measurements";
  check.no_camera = json.value("no_camera", nothing);
  check.no_plate = json.value("no_plate", nothing);
  check.no_turns = json.value("no_turns", nothing);
  check.no_passes = json.value("no_passes", nothing);
  if (HasMeasurements(json, "camera", "turn_rad", 3)) {
    const CameraCheck camera = CameraFrom(json["camera"]);
    if (camera.turn_rad.allFinite() && CanBeInverted(camera.covariance)) check.camera = camera;
  }
  if (HasMeasurements(json, "plate", "drift", PlateCheck::kUnknowns)) {
    const PlateCheck plate = PlateFrom(json["plate"]);
    if (plate.drift.allFinite() && CanBeAveraged(plate)) check.plate = plate;
  }
  if (HasMeasurements(json, "turns", "drift", TurnCheck::kUnknowns)) {
    const TurnCheck turns = TurnsFrom(json["turns"]);
    if (turns.drift.allFinite() && CanBeAveraged(turns)) check.turns = turns;
  }
  if (json.contains("passes")) {
    check.passes = PassesFrom(json["passes"]);
    check.no_passes.clear();
  }
  if (check.turns) check.no_turns.clear();
  if (check.camera) check.no_camera.clear();
  if (check.plate) check.no_plate.clear();
  return check;
}

}  // namespace foresight
