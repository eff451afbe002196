#include "core/detection/candidates.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/operator_text.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// The candidate of a detection that has one best answer and alternatives.
template <class Found>
const auto& Chosen(const Found& found, int candidate) {
  const int last = static_cast<int>(found.alternatives.size());
  const int index = std::clamp(candidate, 0, last);
  return index == 0 ? found.best : found.alternatives[static_cast<std::size_t>(index - 1)];
}

const TerrainSurface* Chosen(const TerrainDetection& terrain, int candidate) {
  if (terrain.surfaces.empty()) return nullptr;
  const int last = static_cast<int>(terrain.surfaces.size()) - 1;
  return &terrain.surfaces[static_cast<std::size_t>(std::clamp(candidate, 0, last))];
}

std::string Describe(const ValveModel& model) {
  if (model.IsLever()) return OperatorText("lever, {:.0f} mm long", 1000.0 * model.lever_length_m);
  const double across_mm = 2000.0 * model.rim_radius_m;
  if (model.spokes == 0) return OperatorText("disc, {:.0f} mm across", across_mm);
  return OperatorText("{} spokes, rim {:.0f} mm across", model.spokes, across_mm);
}

std::string Describe(const DrillModel& model) {
  return OperatorText("{}, scale {:.2f}", model.template_name, model.scale);
}

std::string Describe(const HandleModel& model) {
  return OperatorText("lever, {:.0f} mm long, on a {}{}", 1000.0 * model.length_m,
                      model.plate == HandleModel::Plate::kLong ? OperatorText("long plate")
                                                               : OperatorText("rosette"),
                      model.returned ? OperatorText(", end bent back") : std::string());
}

std::string Describe(const CylinderModel& model) {
  return OperatorText("cylinder, {:.0f} mm across, {:.0f} mm of it seen", 2000.0 * model.radius_m,
                      1000.0 * model.length_m);
}

std::string KindText(TerrainSurface::Kind kind) {
  switch (kind) {
    case TerrainSurface::Kind::kBlock:
      return OperatorText("block");
    case TerrainSurface::Kind::kGround:
      return OperatorText("ground");
    case TerrainSurface::Kind::kUnknown:
      break;
  }
  return OperatorText("unknown surface");
}

std::string Describe(const TerrainSurface& surface) {
  return OperatorText("{}, {:.0f} x {:.0f} mm, slope {:.0f} deg", KindText(surface.kind),
                      1000.0 * surface.size_m.x(), 1000.0 * surface.size_m.y(),
                      DegreesFromRadians(surface.toehold.slope_rad));
}

template <class Found>
std::string TextOf(const Found& found, int candidate) {
  const auto& chosen = Chosen(found, candidate);
  if (candidate <= 0 || found.alternatives.empty()) return Describe(chosen.model);
  const double nats = found.best.log_likelihood - chosen.log_likelihood;
  const int count = static_cast<int>(found.alternatives.size());
  return OperatorText("alternative {} of {}: {}, {}", std::min(candidate, count), count,
                      Describe(chosen.model), MarginInWords(nats));
}

template <class Found>
std::optional<double> MarginOf(const Found& found, int candidate) {
  if (candidate <= 0 || found.alternatives.empty()) return std::nullopt;
  return found.best.log_likelihood - Chosen(found, candidate).log_likelihood;
}

std::optional<double> MarginOf(const TerrainDetection&, int) {
  return std::nullopt;
}

std::optional<double> MarginOf(const CylinderDetection&, int) {
  return std::nullopt;
}

std::string TextOf(const CylinderDetection& cylinder, int) {
  return Describe(cylinder.model);
}

std::string TextOf(const TerrainDetection& terrain, int candidate) {
  const TerrainSurface* surface = Chosen(terrain, candidate);
  if (surface == nullptr) return OperatorText("no surface");
  const int count = static_cast<int>(terrain.surfaces.size());
  return OperatorText("surface {} of {}: {}", std::clamp(candidate, 0, count - 1) + 1, count,
                      Describe(*surface));
}

Rigid<frame::Base, frame::Object> PoseOf(const CylinderDetection& cylinder, int) {
  return cylinder.base_from_object;
}

template <class Found>
Rigid<frame::Base, frame::Object> PoseOf(const Found& found, int candidate) {
  return Chosen(found, candidate).base_from_object;
}

Rigid<frame::Base, frame::Object> PoseOf(const TerrainDetection& terrain, int candidate) {
  const TerrainSurface* surface = Chosen(terrain, candidate);
  return surface == nullptr ? Rigid<frame::Base, frame::Object>() : surface->base_from_object;
}

}  // namespace

SolidPart PartOf(const CylinderModel& model) {
  SolidPart part;
  part.shape = SolidPart::Shape::kCylinder;
  part.size_m = {2.0 * model.radius_m, 2.0 * model.radius_m, model.length_m};
  return part;
}

std::string MarginInWords(double nats) {
  return OperatorText(MarginWords(nats));
}

std::optional<double> MarginBehindBest(const Detection& detection, int candidate) {
  return std::visit([candidate](const auto& found) { return MarginOf(found, candidate); },
                    detection);
}

int CandidateCount(const Detection& detection) {
  if (const auto* valve = std::get_if<ValveDetection>(&detection))
    return 1 + static_cast<int>(valve->alternatives.size());
  if (const auto* drill = std::get_if<DrillDetection>(&detection))
    return 1 + static_cast<int>(drill->alternatives.size());
  if (const auto* handle = std::get_if<HandleDetection>(&detection))
    return 1 + static_cast<int>(handle->alternatives.size());
  if (std::holds_alternative<CylinderDetection>(detection)) return 1;
  return static_cast<int>(std::get<TerrainDetection>(detection).surfaces.size());
}

Rigid<frame::Base, frame::Object> CandidatePose(const Detection& detection, int candidate) {
  return std::visit([candidate](const auto& found) { return PoseOf(found, candidate); }, detection);
}

VerdictLevel CandidateLevel(const Detection& detection, int candidate) {
  if (const auto* terrain = std::get_if<TerrainDetection>(&detection)) {
    const TerrainSurface* surface = Chosen(*terrain, candidate);
    return surface == nullptr ? VerdictLevel::kUnsure : surface->verdict.level;
  }
  const VerdictLevel best = VerdictOf(detection).level;
  const auto behind = MarginBehindBest(detection, candidate);
  if (!behind) return best;
  return *behind < kComparable_nats ? std::min(best, VerdictLevel::kLikely) : VerdictLevel::kUnsure;
}

std::string CandidateText(const Detection& detection, int candidate) {
  return std::visit([candidate](const auto& found) { return TextOf(found, candidate); }, detection);
}

}  // namespace foresight
