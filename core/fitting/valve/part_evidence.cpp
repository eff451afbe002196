#include "core/fitting/valve/part_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/fitting/valve/valve_coverage.h"
#include "core/fitting/valve/valve_tracer.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

// Of a spoke's length, as a fraction: beams nearer to its ends touch hub or rim, too.
constexpr double kMiddleBegins = 0.3;
constexpr double kMiddleEnds = 0.8;
constexpr double kSpokeStep_rad = RadiansFromDegrees(5.0);
constexpr double kBesideSpoke_rad = RadiansFromDegrees(15.0);
constexpr std::size_t kArcs = 32;  // of a rim

double SpokeLength(const ValveModel& model) {
  return std::hypot(model.rim_radius_m, model.dish_m);
}

/// How much beams speak for a spoke, by where they are on it.
struct SpokeNats {
  double on_it = 0.0;   ///< which enter it
  double middle = 0.0;  ///< on and beside its middle
  double inner_half = 0.0;
  double outer_half = 0.0;

  /// A spoke reaches from hub to rim: the half that is seen worse counts for both.
  double Whole() const { return 2.0 * std::min(inner_half, outer_half); }

  void Add(const ValveIntersection& intersection, double gain, double length_m) {
    const double along = intersection.along_m / length_m;
    if (intersection.Clearance() < 0.0) on_it += gain;
    if (along > kMiddleBegins && along < kMiddleEnds) middle += gain;
    (along < 0.5 ? inner_half : outer_half) += gain;
  }
};

using RimNats = std::array<double, kArcs>;

std::size_t ArcOf(const ValveIntersection& intersection) {
  const double arcs = kArcs;
  return static_cast<std::size_t>(std::clamp(intersection.FractionOfRim() * arcs, 0.0, arcs - 1.0));
}

/// Of every stretch of so many arcs, wherever it begins, the least.
double WeakestStretch(const RimNats& rim, std::size_t arcs) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < kArcs; ++first) {
    double sum = 0.0;
    for (std::size_t i = 0; i < arcs; ++i) sum += rim[(first + i) % kArcs];
    least = std::min(least, sum);
  }
  return least;
}

ValveCandidate Turned(const ValveCandidate& valve, double turn_rad) {
  ValveCandidate turned = valve;
  turned.base_from_object = {
      valve.base_from_object.rotation() * Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()),
      valve.base_from_object.translation()};
  return turned;
}

/// How much the beams that the valve leaves alone (where `gains` is 0) speak for one more spoke
/// like its own, at the angle where they speak for it most.
double FurtherSpokeNats(const BeamLikelihood& likelihood, const ValveCandidate& valve,
                        const Eigen::VectorXd& gains) {
  const std::vector<RangeRay>& rays = likelihood.Measured().rays().rays;
  const double length_m = SpokeLength(valve.model);
  double most = 0.0;
  for (const double turn : TurnsToFurtherSpokes(valve.model)) {
    const ValveCandidate turned = Turned(valve, turn);
    const Eigen::VectorXd turned_gains = likelihood.Gains(CoverBy(turned));
    const ValveTracer tracer(turned, ValveParts::kAll);
    std::vector<SpokeNats> spokes(static_cast<std::size_t>(valve.model.spokes));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double gain = turned_gains(static_cast<Eigen::Index>(i));
      if (gain == 0.0 || gains(static_cast<Eigen::Index>(i)) != 0.0) continue;
      const ValveIntersection intersection = tracer.Intersect(rays[i]);
      if (intersection.part == ValvePart::kSpoke)
        spokes[static_cast<std::size_t>(intersection.spoke)].Add(intersection, gain, length_m);
    }
    for (const SpokeNats& spoke : spokes) most = std::max(most, spoke.Whole());
  }
  return most;
}

}  // namespace

std::vector<double> TurnsToFurtherSpokes(const ValveModel& model) {
  const double sector = 2.0 * std::numbers::pi / model.spokes;
  std::vector<double> turns;
  for (double turn = kBesideSpoke_rad; turn <= sector - kBesideSpoke_rad; turn += kSpokeStep_rad)
    turns.push_back(turn);
  return turns;
}

void AddEvidenceOfParts(const BeamLikelihood& likelihood, const ValveCandidate& valve,
                        ValveEvidence& evidence) {
  evidence.rim_nats = evidence.weakest_arc_nats = evidence.weakest_quarter_nats = 0.0;
  evidence.weakest_spoke_nats = evidence.weakest_spoke_middle_nats = 0.0;
  evidence.further_spoke_nats = 0.0;
  if (valve.model.IsLever()) return;
  const std::vector<RangeRay>& rays = likelihood.Measured().rays().rays;
  const Eigen::VectorXd gains = likelihood.Gains(CoverBy(valve));
  const ValveTracer tracer(valve, ValveParts::kAll);
  const double length_m = SpokeLength(valve.model);
  std::vector<SpokeNats> spokes(static_cast<std::size_t>(valve.model.spokes));
  RimNats rim = {};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double gain = gains(static_cast<Eigen::Index>(i));
    if (gain == 0.0) continue;  // too far from all of it
    const ValveIntersection intersection = tracer.Intersect(rays[i]);
    if (intersection.part == ValvePart::kRim)
      rim[ArcOf(intersection)] += gain;
    else if (intersection.part == ValvePart::kSpoke)
      spokes[static_cast<std::size_t>(intersection.spoke)].Add(intersection, gain, length_m);
  }
  evidence.rim_nats = std::accumulate(rim.begin(), rim.end(), 0.0);
  evidence.weakest_arc_nats = WeakestStretch(rim, kArcs / 8);
  evidence.weakest_quarter_nats = WeakestStretch(rim, kArcs / 4);
  if (spokes.empty()) return;
  const auto weakest = [&](double SpokeNats::*nats) {
    double least = spokes.front().*nats;
    for (const SpokeNats& spoke : spokes) least = std::min(least, spoke.*nats);
    return least;
  };
  evidence.weakest_spoke_nats = weakest(&SpokeNats::on_it);
  evidence.weakest_spoke_middle_nats = weakest(&SpokeNats::middle);
  evidence.further_spoke_nats = FurtherSpokeNats(likelihood, valve, gains);
}

}  // namespace foresight
