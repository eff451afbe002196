#include "core/mission/rig_check_json.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/io/json_numbers.h"
#include "core/io/json_reader.h"
#include "core/selfcheck/seen_drifts.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kMost = 1e9;

int CountIn(const nlohmann::json& json, const char* key, int least = 1) {
  constexpr int kMostCounted = 10'000'000;  // sums of them stay numbers
  return IntegerIn(json, key, least, kMostCounted);
}

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

/// Averages are weighed by the covariance's inverse.
template <class Vector, class Matrix>
bool CanBeAveraged(const Vector& value, const Matrix& covariance) {
  return value.allFinite() && covariance.allFinite() && covariance.llt().info() == Eigen::Success;
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
  camera.edges = CountIn(json, "depth_edges");
  camera.images = CountIn(json, "images", 0);
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
  plate.planes = CountIn(json, "planes");
  plate.cells = CountIn(json, "cells");
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
  turns.images = CountIn(json, "images", 2);
  turns.points = CountIn(json, "points");
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
  passes.patches = CountIn(json, "patches");
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

bool CanBeAveraged(const CameraCheck& camera) {
  return CanBeAveraged(camera.turn_rad, camera.covariance);
}

/// Of a plate's or of turns' drifts, those that are not seen take no part.
template <class Check>
bool CanBeAveraged(const Check& check) {
  const Check seen = WithSeenDrifts(check);
  return CanBeAveraged(check.drift, seen.covariance);
}

/// `no_...` is why there is no such measurement.
template <class Check, class ToJson>
void Put(OrderedJson& json, const char* key, const std::optional<Check>& check,
         const std::string& no_check, ToJson to_json) {
  if (check)
    json[key] = to_json(*check);
  else
    json[fmt::format("no_{}", key)] = no_check;
}

template <class Check, class FromJson>
void Take(const nlohmann::json& json, const char* key, const char* value, std::size_t unknowns,
          FromJson from_json, std::optional<Check>& check) {
  if (!HasMeasurements(json, key, value, unknowns)) return;
  const Check kept = from_json(json[key]);
  if (CanBeAveraged(kept)) check = kept;
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
  Put(json, "camera", check.camera, check.no_camera, CameraJson);
  Put(json, "plate", check.plate, check.no_plate, PlateJson);
  Put(json, "turns", check.turns, check.no_turns, TurnsJson);
  Put(json, "passes", check.passes, check.no_passes, PassesJson);
  return json.dump();
}

RigCheck RigMeasurementsFromJson(const nlohmann::json& json) {
  RigCheck check;
  const std::string nothing = "the check that was kept holds no measurements";
  check.no_camera = json.value("no_camera", nothing);
  check.no_plate = json.value("no_plate", nothing);
  check.no_turns = json.value("no_turns", nothing);
  check.no_passes = json.value("no_passes", nothing);
  Take(json, "camera", "turn_rad", 3, CameraFrom, check.camera);
  Take(json, "plate", "drift", PlateCheck::kUnknowns, PlateFrom, check.plate);
  Take(json, "turns", "drift", TurnCheck::kUnknowns, TurnsFrom, check.turns);
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
