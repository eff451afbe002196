#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/detection/json_values.h"
#include "core/detection/object_json.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

constexpr double kLargestSurface_m = 1000.0;
constexpr std::size_t kMostSurfaces = 10'000;

Json EvidenceJson(const BlockEvidence& evidence) {
  return {{"points", evidence.points},
          {"cover", evidence.cover},
          {"see_through", evidence.see_through},
          {"outside", evidence.outside},
          {"confirmed_edges", evidence.confirmed_edges},
          {"rms_m", evidence.rms_m},
          {"outline_nats", evidence.outline_nats},
          {"size_margin", evidence.size_margin},
          {"size_nats", evidence.size_nats}};
}

BlockEvidence BlockEvidenceFrom(const Json& value) {
  BlockEvidence evidence;
  evidence.points = CountIn(value, "points");
  evidence.cover = NumberFrom(value.at("cover"));
  evidence.see_through = NumberFrom(value.at("see_through"));
  evidence.outside = NumberFrom(value.at("outside"));
  evidence.confirmed_edges = IntegerIn(value, "confirmed_edges", 0, 4);
  evidence.rms_m = NumberFrom(value.at("rms_m"));
  // Earlier programs did not write these.
  for (const auto& [name, member] : {std::pair("outline_nats", &evidence.outline_nats),
                                     std::pair("size_margin", &evidence.size_margin),
                                     std::pair("size_nats", &evidence.size_nats)})
    if (value.contains(name)) *member = NumberFrom(value[name]);
  return evidence;
}

Json ToeholdJson(const Toehold& toehold) {
  return {{"size_m", ToJson(toehold.size_m)},
          {"slope_rad", toehold.slope_rad},
          {"step_m", toehold.step_m},
          {"sigma_height_m", toehold.sigma_height_m},
          {"sigma_tilt_rad", toehold.sigma_tilt_rad}};
}

Toehold ToeholdFrom(const Json& value) {
  Toehold toehold;
  toehold.size_m = Vector2From(value.at("size_m"));
  toehold.slope_rad = NumberFrom(value.at("slope_rad"));
  toehold.step_m = NumberFrom(value.at("step_m"));
  toehold.sigma_height_m = NumberFrom(value.at("sigma_height_m"));
  toehold.sigma_tilt_rad = NumberFrom(value.at("sigma_tilt_rad"));
  return toehold;
}

Json SurfaceJson(const TerrainSurface& surface,
                 const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Json value = {{"kind", ToString(surface.kind)},
                {"base_from_object", ToJson(surface.base_from_object)},
                {"robot_from_object", ToJson(robot_from_base * surface.base_from_object)},
                {"size_m", ToJson(surface.size_m)},
                {"covariance", ToJson(surface.covariance)},
                {"evidence", EvidenceJson(surface.evidence)},
                {"toehold", ToeholdJson(surface.toehold)},
                {"shift_m", surface.shift_m},
                {"turn_rad", surface.turn_rad}};
  AddVerdict(surface.verdict, value);
  return value;
}

TerrainSurface SurfaceFrom(const Json& value) {
  TerrainSurface surface;
  surface.kind = SurfaceKindFrom(value.at("kind"));
  surface.base_from_object = PoseFrom(value.at("base_from_object"));
  surface.size_m = Vector2From(value.at("size_m"));
  if (!(surface.size_m.array().abs() <= kLargestSurface_m).all())
    throw std::invalid_argument("'size_m' of a surface is beyond a kilometre");
  surface.covariance = CovarianceFrom(value);
  surface.evidence = BlockEvidenceFrom(value.at("evidence"));
  surface.toehold = ToeholdFrom(value.at("toehold"));
  surface.verdict = VerdictFrom(value);
  surface.shift_m = NumberFrom(value.at("shift_m"));
  surface.turn_rad = NumberFrom(value.at("turn_rad"));
  return surface;
}

}  // namespace

TerrainSurface::Kind SurfaceKindFrom(const std::string& name) {
  using enum TerrainSurface::Kind;
  for (const auto kind : {kBlock, kGround, kUnknown})
    if (name == ToString(kind)) return kind;
  throw std::invalid_argument("surface '" + name + "' is not known");
}

Json ToJson(const TerrainDetection& detection,
            const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Json surfaces = Json::array();
  for (const TerrainSurface& surface : detection.surfaces)
    surfaces.push_back(SurfaceJson(surface, robot_from_base));
  return {{"surfaces", surfaces}};
}

TerrainDetection TerrainFrom(const Json& value) {
  TerrainDetection detection;
  for (const Json& surface : ListIn(value, "surfaces", kMostSurfaces))
    detection.surfaces.push_back(SurfaceFrom(surface));
  return detection;
}

}  // namespace foresight
