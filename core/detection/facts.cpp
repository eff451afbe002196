#include "core/detection/facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/operator_text.h"
#include "core/depth/depth_method.h"
#include "core/detection/candidates.h"
#include "core/detection/fit_in_scan.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Whose directions are told.
struct ToldFrame {
  Rigid<frame::Robot, frame::Base> from_base;
  std::optional<Eigen::Vector3d> up;  ///< of a cloud with axes of its own
};

std::string Number(double value, int digits, const char* unit) {
  return std::isfinite(value) ? fmt::format("{:.{}f} {}", value, digits, unit)
                              : OperatorText("not known");
}

std::string Millimetres(double metres, int digits = 0) {
  return Number(1000.0 * metres, digits, "mm");
}

std::string Degrees(double radians) {
  return Number(DegreesFromRadians(radians), 1, "deg");
}

std::string Place(const Eigen::Vector3d& in_robot) {
  return OperatorText("x {:.0f}, y {:.0f}, z {:.0f} mm", 1000.0 * in_robot.x(),
                      1000.0 * in_robot.y(), 1000.0 * in_robot.z());
}

/// Of length 1, in a frame that has no forward.
std::string InNumbers(const Eigen::Vector3d& direction) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", direction.x(), direction.y(), direction.z());
}

/// A direction of the robot's frame as an operator points: how far left of forward, how far up.
std::string Direction(const ToldFrame& frame, const Eigen::Vector3d& direction) {
  const double sine = frame.up ? frame.up->dot(direction) : direction.z();
  const double up_deg = DegreesFromRadians(std::asin(std::clamp(sine, -1.0, 1.0)));
  const std::string up_or_down = OperatorText(up_deg < 0.0 ? "down" : "up");
  if (frame.up)
    return OperatorText("{}, {:.1f} deg {}", InNumbers(direction), std::abs(up_deg), up_or_down);
  const double left_deg = DegreesFromRadians(std::atan2(direction.y(), direction.x()));
  return OperatorText("{:.1f} deg {} of forward, {:.1f} deg {}", std::abs(left_deg),
                      OperatorText(left_deg < 0.0 ? "right" : "left"), std::abs(up_deg),
                      up_or_down);
}

/// Of something that stands: where it leans by less than is known, a direction says nothing.
std::string Lean(const ToldFrame& frame, const Eigen::Vector3d& axis, double sigma_rad) {
  const Eigen::Vector3d up = frame.up.value_or(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d aside = axis - axis.dot(up) * up;
  const double lean_rad = std::atan2(aside.norm(), axis.dot(up));
  if (lean_rad < sigma_rad) return OperatorText("upright");
  const double lean_deg = DegreesFromRadians(lean_rad);
  if (frame.up)
    return OperatorText("leans by {:.1f} deg towards {}", lean_deg, InNumbers(aside.normalized()));
  const double left_deg = DegreesFromRadians(std::atan2(axis.y(), axis.x()));
  return OperatorText("leans by {:.1f} deg to {:.0f} deg {} of forward", lean_deg,
                      std::abs(left_deg), OperatorText(left_deg < 0.0 ? "right" : "left"));
}

/// `sigma` is that of the best answer, and says nothing of another one.
std::string WithSigma(const std::string& text, const std::string& sigma, int candidate = 0) {
  return candidate > 0 ? text : OperatorText("{} (sigma {})", text, sigma);
}

std::string SigmaOfPlace(const Eigen::Vector3d& sigma_m) {
  return OperatorText("{:.1f}, {:.1f}, {:.1f} mm along its axes", 1000.0 * sigma_m.x(),
                      1000.0 * sigma_m.y(), 1000.0 * sigma_m.z());
}

template <class Evidence>
std::string Support(const Evidence& evidence) {
  return OperatorText("{} of {} rays hit, {:.0f} % agree, RMS {}", evidence.hits, evidence.rays,
                      100.0 * evidence.inlier_ratio, Millimetres(evidence.rms_m, 1));
}

void AddFacts(const ValveDetection& valve, int candidate, const ToldFrame& frame,
              std::vector<Fact>& facts) {
  const auto pose = frame.from_base * CandidatePose(valve, candidate);
  const bool lever = valve.best.model.IsLever();
  facts.push_back(
      {lever ? OperatorText("Pivot") : OperatorText("Centre"),
       WithSigma(Place(pose.translation()), SigmaOfPlace(valve.sigma_position_m), candidate)});
  facts.push_back(
      {OperatorText("Axis (z)"), WithSigma(Direction(frame, pose.Rotate(Eigen::Vector3d::UnitZ())),
                                           Degrees(valve.sigma_axis_rad), candidate)});
  facts.push_back({lever ? OperatorText("Lever (x)") : OperatorText("Spoke (x)"),
                   valve.phase_observable
                       ? WithSigma(Direction(frame, pose.Rotate(Eigen::Vector3d::UnitX())),
                                   Degrees(valve.sigma_phase_rad), candidate)
                       : OperatorText("angle not observable")});
  if (candidate <= 0) facts.push_back({OperatorText("Support"), Support(valve.evidence)});
}

void AddFacts(const DrillDetection& drill, int candidate, const ToldFrame& frame,
              std::vector<Fact>& facts) {
  const auto pose = frame.from_base * CandidatePose(drill, candidate);
  const DrillModel& model = candidate > 0 && !drill.alternatives.empty()
                                ? drill
                                      .alternatives[std::min(drill.alternatives.size(),
                                                             static_cast<std::size_t>(candidate)) -
                                                    1]
                                      .model
                                : drill.best.model;
  const auto grasp = pose * model.object_from_grasp;  // leaning with the body
  facts.push_back(
      {OperatorText("Foot"),
       WithSigma(Place(pose.translation()), SigmaOfPlace(drill.sigma_position_m), candidate)});
  facts.push_back({OperatorText("Bit points (x)"),
                   WithSigma(Direction(frame, pose.Rotate(Eigen::Vector3d::UnitX())),
                             Degrees(drill.sigma_yaw_rad), candidate)});
  facts.push_back(
      {OperatorText("Body"),
       WithSigma(Lean(frame, grasp.Rotate(Eigen::Vector3d::UnitZ()), drill.sigma_axis_rad),
                 Degrees(drill.sigma_axis_rad), candidate)});
  facts.push_back({OperatorText("Grasp"), Place(grasp.translation())});
  facts.push_back({OperatorText("Trigger"), Place(pose * model.trigger_m)});
  facts.push_back({OperatorText("Bit tip"), Place(pose * model.bit_tip_m)});
  if (candidate > 0) return;
  facts.push_back({OperatorText("Turned round"), MarginInWords(drill.evidence.flip_margin_nats)});
  facts.push_back({OperatorText("Support"), Support(drill.evidence)});
}

/// Of odds that mean what they say: "74 : 1 against".
std::string OddsAgainst(double nats) {
  const double odds = std::exp(std::clamp(nats, 0.0, 14.0));
  const double step = std::pow(10.0, std::max(0.0, std::floor(std::log10(odds)) - 1.0));
  return OperatorText("{:.0f} : 1 against", step * std::round(odds / step));
}

/// A lever points away from it.
std::string DoorsEdge(const HandleEvidence& evidence) {
  if (evidence.edges_nats > 0.0) return OperatorText("behind the pivot");
  return evidence.edges_nats < 0.0 ? OperatorText("beyond the tip") : OperatorText("not seen");
}

void AddFacts(const HandleDetection& handle, int candidate, const ToldFrame& frame,
              std::vector<Fact>& facts) {
  const auto pose = frame.from_base * CandidatePose(handle, candidate);
  facts.push_back(
      {OperatorText("Pivot"),
       WithSigma(Place(pose.translation()), SigmaOfPlace(handle.sigma_position_m), candidate)});
  facts.push_back(
      {OperatorText("Lever (x)"), WithSigma(Direction(frame, pose.Rotate(Eigen::Vector3d::UnitX())),
                                            Degrees(handle.sigma_turn_rad), candidate)});
  facts.push_back({OperatorText("Door's normal (z)"),
                   WithSigma(Direction(frame, pose.Rotate(Eigen::Vector3d::UnitZ())),
                             Degrees(handle.sigma_normal_rad), candidate)});
  if (candidate > 0) return;
  facts.push_back({OperatorText("Length"), WithSigma(Millimetres(handle.best.model.length_m),
                                                     Millimetres(handle.sigma_length_m, 1))});
  constexpr double kNoticed_m = 0.005;
  if (handle.best.model.behind_m > kNoticed_m)
    facts.push_back({OperatorText("Behind its pivot"), Millimetres(handle.best.model.behind_m)});
  facts.push_back({OperatorText("Off the door"), Millimetres(handle.best.model.standoff_m)});
  facts.push_back({OperatorText("Turned round"), OddsAgainst(handle.evidence.mirror_margin_nats)});
  facts.push_back({OperatorText("Door's edge"), DoorsEdge(handle.evidence)});
  facts.push_back({OperatorText("Support"), Support(handle.evidence)});
}

void AddFacts(const CylinderDetection& cylinder, int, const ToldFrame& frame,
              std::vector<Fact>& facts) {
  const auto pose = frame.from_base * cylinder.base_from_object;
  const CylinderEvidence& evidence = cylinder.evidence;
  facts.push_back({OperatorText("Radius"), WithSigma(Millimetres(cylinder.model.radius_m),
                                                     Millimetres(cylinder.sigma_radius_m))});
  facts.push_back({OperatorText("Middle"),
                   WithSigma(Place(pose.translation()),
                             OperatorText("{} across", Millimetres(cylinder.sigma_across_m)))});
  facts.push_back(
      {OperatorText("Axis (z)"), WithSigma(Direction(frame, pose.Rotate(Eigen::Vector3d::UnitZ())),
                                           Degrees(cylinder.sigma_axis_rad))});
  facts.push_back(
      {OperatorText("Support"),
       OperatorText("{} beams on it, {:.0f} % agree, {:.0f} % went through, {} of its girth seen",
                    evidence.hits, 100.0 * evidence.inlier_ratio, 100.0 * evidence.see_through,
                    Degrees(evidence.seen_arc_rad))});
  facts.push_back({OperatorText("Residual"), Millimetres(evidence.residual_mad_m)});
}

void AddFacts(const TerrainDetection& terrain, int candidate, const ToldFrame& frame,
              std::vector<Fact>& facts) {
  if (terrain.surfaces.empty()) return;
  const auto index = static_cast<std::size_t>(
      std::clamp(candidate, 0, static_cast<int>(terrain.surfaces.size()) - 1));
  const TerrainSurface& surface = terrain.surfaces[index];
  const Toehold& toehold = surface.toehold;
  const auto pose = frame.from_base * surface.base_from_object;
  const bool known = toehold.sigma_height_m > 0.0;  // of blocks alone
  facts.push_back(
      {OperatorText("Middle"),
       known ? WithSigma(Place(pose.translation()),
                         OperatorText("{} in height", Millimetres(toehold.sigma_height_m, 1)))
             : Place(pose.translation())});
  const std::string normal = Direction(frame, pose.Rotate(Eigen::Vector3d::UnitZ()));
  facts.push_back({OperatorText("Normal (z)"),
                   known ? WithSigma(normal, Degrees(toehold.sigma_tilt_rad)) : normal});
  facts.push_back(
      {OperatorText("Long side (x)"), Direction(frame, pose.Rotate(Eigen::Vector3d::UnitX()))});
  facts.push_back({OperatorText("Toehold"),
                   toehold.size_m.minCoeff() > 0.0
                       ? OperatorText("{:.0f} x {:.0f} mm", 1000.0 * toehold.size_m.x(),
                                      1000.0 * toehold.size_m.y())
                       : OperatorText("none")});
  facts.push_back({OperatorText("Step"), Millimetres(toehold.step_m)});
  if (std::isfinite(surface.shift_m))
    facts.push_back({OperatorText("Moved"),
                     OperatorText("{} and {} since the accepted scan", Millimetres(surface.shift_m),
                                  Degrees(surface.turn_rad))});
  facts.push_back(
      {OperatorText("Support"),
       OperatorText("{} points, {:.0f} % covered, {} of 4 edges, RMS {}", surface.evidence.points,
                    100.0 * surface.evidence.cover, surface.evidence.confirmed_edges,
                    Millimetres(surface.evidence.rms_m, 1))});
}

}  // namespace

std::vector<Fact> FactsOf(const Detection& detection, int candidate,
                          const Rigid<frame::Robot, frame::Base>& robot_from_base,
                          const std::optional<Eigen::Vector3d>& up_of_cloud) {
  const ToldFrame told{robot_from_base, up_of_cloud};
  std::vector<Fact> facts = {{OperatorText("Answer"), CandidateText(detection, candidate)}};
  std::visit([&](const auto& found) { AddFacts(found, candidate, told, facts); }, detection);
  return facts;
}

std::string SourceTitle(const std::string& source) {
  if (source == "raw") return OperatorText("lidar returns");
  for (const DepthMethodInfo& method : DepthMethods()) {
    if (source == method.name) return OperatorText("depth map, {}", method.title);
    if (source == NameOf({FitSource::kDepthAlone, method.method}))
      return OperatorText("depth map alone, {}", method.title);
  }
  return source;
}

}  // namespace foresight
