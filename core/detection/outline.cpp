#include "core/detection/outline.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/base/contract.h"
#include "core/detection/candidates.h"

namespace foresight {
namespace {

Wireframe InBase(Wireframe lines, const Rigid<frame::Base, frame::Object>& base_from_object) {
  for (auto& line : lines)
    for (auto& point : line) point = base_from_object * point;
  return lines;
}

std::vector<Eigen::Vector3d> RectangleOf(const Eigen::Vector2d& size_m) {
  const double x = 0.5 * size_m.x(), y = 0.5 * size_m.y();
  return {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}, {-x, -y, 0.0}};
}

Wireframe WireframeOf(const TerrainSurface& surface) {
  Wireframe lines = {RectangleOf(surface.size_m)};
  if (surface.toehold.size_m.minCoeff() > 0.0) lines.push_back(RectangleOf(surface.toehold.size_m));
  return lines;
}

std::vector<Outline> TerrainOutlines(const TerrainDetection& terrain, int candidate) {
  std::vector<Outline> outlines;
  const int last = static_cast<int>(terrain.surfaces.size()) - 1;
  for (const TerrainSurface& surface : terrain.surfaces) {
    const bool chosen = static_cast<int>(outlines.size()) == std::clamp(candidate, 0, last);
    outlines.push_back(
        {InBase(WireframeOf(surface), surface.base_from_object), surface.verdict.level, chosen});
  }
  return outlines;
}

Wireframe TemplateOf(const Detection& detection, int candidate) {
  const auto alternative = static_cast<std::size_t>(std::max(0, candidate - 1));
  if (const auto* valve = std::get_if<ValveDetection>(&detection))
    return WireframeOf(candidate > 0 ? valve->alternatives[alternative].model : valve->best.model);
  if (const auto* handle = std::get_if<HandleDetection>(&detection))
    return WireframeOf(candidate > 0 ? handle->alternatives[alternative].model
                                     : handle->best.model);
  if (const auto* cylinder = std::get_if<CylinderDetection>(&detection))
    return WireframeOf(PartOf(cylinder->model));
  const auto& drill = std::get<DrillDetection>(detection);
  return WireframeOf(candidate > 0 ? drill.alternatives[alternative].model : drill.best.model);
}

}  // namespace

std::vector<Outline> OutlinesOf(const Detection& detection, int candidate) {
  if (const auto* terrain = std::get_if<TerrainDetection>(&detection))
    return TerrainOutlines(*terrain, candidate);
  const int index = std::clamp(candidate, 0, CandidateCount(detection) - 1);
  return {{InBase(TemplateOf(detection, index), CandidatePose(detection, index)),
           CandidateLevel(detection, index), true}};
}

Wireframe Dashed(const Wireframe& lines, double dash_m, double gap_m) {
  FORESIGHT_EXPECTS(dash_m > 0.0 && gap_m > 0.0, "a dash and a gap have a length");
  Wireframe dashes;
  for (const auto& line : lines) {
    double along = 0.0;  // within dash and gap
    bool drawing = false;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double length = (line[i] - line[i - 1]).norm();
      for (double done = 0.0; done < length;) {
        const bool in_dash = along < dash_m;
        const auto at = [&](double s) -> Eigen::Vector3d {
          return line[i - 1] + s / length * (line[i] - line[i - 1]);
        };
        const double step = std::min(length - done, (in_dash ? dash_m : dash_m + gap_m) - along);
        if (in_dash) {
          if (!drawing) dashes.push_back({at(done)});
          dashes.back().push_back(at(done + step));
        }
        drawing = in_dash;
        done += step;
        along += step;
        if (along >= dash_m + gap_m - 1e-12) along = 0.0;
        // A dash ends where the sum reaches it, rounding or not.
        if (in_dash && along > dash_m - 1e-12) along = std::max(along, dash_m);
      }
    }
  }
  return dashes;
}

Wireframe Dashed(const Wireframe& lines) {
  Eigen::AlignedBox3d box;
  for (const auto& line : lines)
    for (const auto& point : line) box.extend(point);
  if (box.isEmpty() || !(box.diagonal().norm() > 0.0)) return lines;
  const double dash_m = box.diagonal().norm() / 40.0;
  return Dashed(lines, dash_m, 0.7 * dash_m);
}

}  // namespace foresight
