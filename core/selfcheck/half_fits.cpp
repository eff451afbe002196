#include "core/selfcheck/half_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/detection/candidates.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Deviations along and about the object's axes; NaN = not known.
Eigen::Matrix<double, 6, 1> Sigmas(const PoseCovariance& covariance) {
  return covariance.diagonal().cwiseSqrt();
}

PoseCovariance CovarianceOf(const Detection& detection, std::size_t part) {
  if (const auto* terrain = std::get_if<TerrainDetection>(&detection))
    return terrain->surfaces[part].covariance;
  if (const auto* drill = std::get_if<DrillDetection>(&detection)) return drill->covariance;
  if (const auto* cylinder = std::get_if<CylinderDetection>(&detection))
    return cylinder->covariance;
  if (const auto* handle = std::get_if<HandleDetection>(&detection)) return handle->covariance;
  return std::get<ValveDetection>(detection).covariance;
}

/// A block's sides differ by little: which is the long one is no part of its pose.
std::vector<PlacedObject> PlacedIn(const Detection& detection, const SensorRig& rig) {
  std::vector<PlacedObject> placed = PlacedObjectsOf(detection, "", rig.robot_from_base);
  if (std::holds_alternative<TerrainDetection>(detection))
    for (PlacedObject& object : placed) object.turns = 4;
  return placed;
}

/// An object as a half of the lines has it.
struct InHalf {
  PlacedObject object;
  Eigen::Matrix<double, 6, 1> sigmas;
};

/// The object of a half that is the same thing; nullopt where there is none.
std::optional<InHalf> SameIn(const Result<Detection>& half, const SensorRig& rig,
                             const PlacedObject& object) {
  if (!half) return std::nullopt;
  std::vector<PlacedObject> placed = PlacedIn(*half, rig);
  // Pairs hold copies: which part one was is told by its uuid.
  for (std::size_t part = 0; part < placed.size(); ++part) placed[part].uuid = std::to_string(part);
  for (const ObjectPair& pair : MatchObjects({object}, placed))
    if (pair.first && pair.second)
      return InHalf{*pair.second, Sigmas(CovarianceOf(*half, std::stoul(pair.second->uuid)))};
  return std::nullopt;
}

/// Two independent halves differ by twice the deviation of the whole; by more where the whole knew
/// more than both halves, as by an image that they do not look at. NaN where the whole's is.
Eigen::Matrix<double, 6, 1> PredictedDifference(const InHalf& even, const InHalf& odd,
                                                const PoseCovariance& whole) {
  const Eigen::Matrix<double, 6, 1> of_halves =
      (even.sigmas.cwiseAbs2() + odd.sigmas.cwiseAbs2()).cwiseSqrt();
  Eigen::Matrix<double, 6, 1> predicted = 2.0 * Sigmas(whole);
  for (int i = 0; i < 6; ++i)
    if (of_halves[i] > predicted[i]) predicted[i] = of_halves[i];
  return predicted;
}

std::vector<HalvesDifference> DifferencesOf(const InHalf& even, const InHalf& odd,
                                            const PoseCovariance& whole) {
  const PoseDifference difference = DifferenceOf(even.object, odd.object);
  const Eigen::Matrix<double, 6, 1> predicted = PredictedDifference(even, odd, whole);
  std::vector<HalvesDifference> differences;
  for (int i = 0; i < 6; ++i) {
    // A disc's phase, and the extent of what was not seen to its ends.
    if (!std::isfinite(predicted[i])) continue;
    const bool is_turn = i >= 3;
    const int axis = i % 3;
    differences.push_back({fmt::format("{} {}", is_turn ? "about" : "along", "xyz"[axis]),
                           is_turn ? difference.turn_rad[axis] : difference.shift_m[axis],
                           predicted[i], is_turn});
  }
  std::sort(
      differences.begin(), differences.end(),
      [](const HalvesDifference& a, const HalvesDifference& b) { return a.Sigmas() > b.Sigmas(); });
  return differences;
}

HalfFits::State StateOf(const std::vector<HalvesDifference>& differences,
                        const HalfFitsLimits& limits) {
  HalfFits::State state = differences.empty() ? HalfFits::State::kNotSeen : HalfFits::State::kAgree;
  for (const HalvesDifference& difference : differences) {
    const double least = difference.is_turn ? limits.least_rad : limits.least_m;
    if (std::abs(difference.value) < least || difference.Sigmas() < limits.sigmas) continue;
    state = std::max(state, difference.Sigmas() < limits.red_sigmas ? HalfFits::State::kDiffer
                                                                    : HalfFits::State::kDifferFar);
  }
  return state;
}

Result<Detection> FitInHalf(const RegisteredScan& half, const SensorRig& rig,
                            const KeptObject& object, const RunContext& context) {
  // Both halves have one image: with it they would agree for its sake.
  if (object.source == FitSource::kRaw)
    return FitInScan({rig, half}, object.source, object.roi, object.options, context);
  if (object.frame == nullptr)
    return Fail(ErrorCode::kInvalidInput, "the image that it was fitted on is not in the scan");
  FORESIGHT_TRY(const DepthResult depth, ComputeDepthInFrame(half, rig, *object.frame, object.depth,
                                                             context.Part(0.0, 0.3)));
  return FitInScan({rig, half, {}, &depth}, object.source, object.roi, object.options,
                   context.Part(0.3, 1.0));
}

}  // namespace

const char* ToString(HalfFits::State state) {
  switch (state) {
    case HalfFits::State::kAgree:
      return "agree";
    case HalfFits::State::kDiffer:
      return "differ";
    case HalfFits::State::kDifferFar:
      return "differ far";
    case HalfFits::State::kNotSeen:
      return "not seen";
  }
  return "";
}

std::string InWords(const HalvesDifference& difference) {
  const double factor = difference.is_turn ? DegreesFromRadians(1.0) : 1000.0;
  return fmt::format("{}: {:.2g} {}, {:.1f} deviations of {:.2g} {}", difference.axis,
                     factor * std::abs(difference.value), difference.is_turn ? "deg" : "mm",
                     difference.Sigmas(), factor * difference.predicted,
                     difference.is_turn ? "deg" : "mm");
}

RegisteredScan HalfOf(const RegisteredScan& cloud, bool odd) {
  RegisteredScan half;
  half.beams = cloud.beams;
  half.lines = odd ? cloud.lines / 2 : (cloud.lines + 1) / 2;
  const auto cells = static_cast<std::size_t>(half.lines) * static_cast<std::size_t>(half.beams);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const auto points = half.points.Append(cells, Eigen::Vector3f::Constant(kNaN));
  const auto range_m = half.range_m.Append(cells, kNaN);
  const auto intensity = half.intensity.Append(cells, 0.0f);
  const auto origins =
      half.origins.Append(static_cast<std::size_t>(half.lines), Eigen::Vector3f::Constant(kNaN));
  for (int line = 0; line < half.lines; ++line) {
    const int whole = 2 * line + (odd ? 1 : 0);
    origins[static_cast<std::size_t>(line)] = cloud.origins[static_cast<std::size_t>(whole)];
    for (int beam = 0; beam < half.beams; ++beam) {
      const std::size_t to = half.Index(line, beam), from = cloud.Index(whole, beam);
      points[to] = cloud.points[from];
      range_m[to] = cloud.range_m[from];
      intensity[to] = cloud.intensity[from];
    }
  }
  return half;
}

Result<std::vector<HalfFits>> CheckHalves(const RegisteredScan& cloud, const SensorRig& rig,
                                          const KeptObject& object, const HalfFitsLimits& limits,
                                          const RunContext& context) {
  const auto even = FitInHalf(HalfOf(cloud, false), rig, object, context.Part(0.0, 0.5));
  const auto odd = FitInHalf(HalfOf(cloud, true), rig, object, context.Part(0.5, 1.0));
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the check was cancelled");
  const std::vector<PlacedObject> whole = PlacedIn(object.detection, rig);
  std::vector<HalfFits> answers;
  for (std::size_t part = 0; part < whole.size(); ++part) {
    HalfFits answer;
    answer.uuid = object.uuid;
    answer.what = object.name.empty() ? whole[part].text : object.name;
    if (whole.size() > 1)
      answer.what = fmt::format("{} ({} of {})", answer.what, part + 1, whole.size());
    const auto in_even = SameIn(even, rig, whole[part]);
    const auto in_odd = SameIn(odd, rig, whole[part]);
    if (in_even && in_odd) {
      answer.differences = DifferencesOf(*in_even, *in_odd, CovarianceOf(object.detection, part));
      answer.state = StateOf(answer.differences, limits);
    }
    if (!in_even || !in_odd)
      answer.not_seen = fmt::format("{}: not found in {} alone", answer.what,
                                    !in_even && !in_odd ? "either half of the lines"
                                    : !in_even          ? "even lines"
                                                        : "odd lines");
    else if (answer.differences.empty())
      answer.not_seen = answer.what + ": its deviations are not known";
    answers.push_back(std::move(answer));
  }
  return answers;
}

}  // namespace foresight
