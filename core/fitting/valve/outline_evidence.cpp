#include "core/fitting/valve/outline_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "core/fitting/valve/part_evidence.h"
#include "core/fitting/valve/valve_tracer.h"

namespace foresight {
namespace {

constexpr int kRimChords = 48;
constexpr int kBarPieces = 4;
constexpr int kMostMove_px = 4;  // what rig and fit may be off by

/// A point of a part's middle line, in the object's frame, with the ellipse that is its section.
struct Section {
  Eigen::Vector3d middle;
  Eigen::Vector3d width_axis;  ///< of length 1, across the middle line
  Eigen::Vector3d depth_axis;  ///< of length 1, across both
  double width_m;              ///< half of it
  double depth_m;
};
using MiddleLine = std::vector<Section>;

MiddleLine RimOf(const ValveModel& model) {
  MiddleLine rim;
  for (int i = 0; i <= kRimChords; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRimChords;
    const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
    rim.push_back({model.rim_radius_m * outwards, outwards, Eigen::Vector3d::UnitZ(),
                   model.tube_radius_m, model.RimDepth()});
  }
  return rim;
}

MiddleLine BarOf(const Eigen::Vector3d& begin, const Eigen::Vector3d& end, double width_m,
                 double depth_m) {
  const Eigen::Vector3d width_axis = Eigen::Vector3d::UnitZ().cross(end - begin).normalized();
  const Eigen::Vector3d depth_axis = (end - begin).cross(width_axis).normalized();
  MiddleLine bar;
  for (int i = 0; i <= kBarPieces; ++i)
    bar.push_back({begin + static_cast<double>(i) / kBarPieces * (end - begin), width_axis,
                   depth_axis, width_m, depth_m});
  return bar;
}

MiddleLine SpokeOf(const ValveModel& model, double angle) {
  const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d hub(0.0, 0.0, -model.dish_m);
  const Eigen::Vector3d begin = hub + model.hub_radius_m * outwards;
  const Eigen::Vector3d end = (model.rim_radius_m - model.tube_radius_m) * outwards;
  return BarOf(begin, end, model.spoke_radius_m, model.SpokeDepth());
}

double AngleOfSpoke(const ValveModel& model, int spoke) {
  return 2.0 * std::numbers::pi * spoke / model.spokes;
}

/// A valve seen from the camera.
class SeenValve {
 public:
  SeenValve(const ImageEdges& image, const ValveCandidate& valve)
      : image_(image), valve_(valve), tracer_(valve, ValveParts::kAll) {
    eye_in_object_ = valve.base_from_object.Inverse() * image.Eye();
  }

  /// Where a part's outline is the valve's.
  std::vector<ImageEdges::Piece> PiecesOf(const MiddleLine& part) const {
    const auto range_along = [this](const Eigen::Vector3d& ray) {
      const ValveIntersection entry =
          tracer_.Intersect({.origin = image_.Eye(), .direction = ray, .range_m = 0.0}, 0.0);
      return entry.Clearance() < 0.0 ? entry.Range() : std::numeric_limits<double>::infinity();
    };
    return image_.PiecesAlong(SidesOf(part), [&](std::span<const Eigen::Vector3d> directions,
                                                 std::span<double> ranges_m) {
      std::transform(directions.begin(), directions.end(), ranges_m.begin(), range_along);
    });
  }

  /// Both sides of a part that the valve has not.
  std::vector<ImageEdges::Piece> PiecesOfFurther(const MiddleLine& part) const {
    return image_.PiecesAlong(SidesOf(part), nullptr);
  }

 private:
  /// Where the sections of a part end, as the camera sees them, on either side.
  std::vector<ImageEdges::Edge> SidesOf(const MiddleLine& part) const {
    std::vector<ImageEdges::Edge> sides;
    for (const double side : {-1.0, 1.0}) {
      std::optional<Eigen::Vector2d> last;
      for (const Section& section : part) {
        const auto pixel = image_.PixelOf(valve_.base_from_object * EndOf(section, side));
        if (last && pixel) sides.push_back({*last, *pixel});
        last = pixel;
      }
    }
    return sides;
  }

  /// The point of an ellipse that is furthest across the sight.
  Eigen::Vector3d EndOf(const Section& section, double side) const {
    const Eigen::Vector3d sight = section.middle - eye_in_object_;
    const double across_width = -sight.dot(section.depth_axis);
    const double across_depth = sight.dot(section.width_axis);
    const double width_m = section.width_m * section.width_m * across_width;
    const double depth_m = section.depth_m * section.depth_m * across_depth;
    const double reach = std::hypot(section.width_m * across_width, section.depth_m * across_depth);
    if (!(reach > 0.0)) return section.middle;
    return section.middle +
           side / reach * (width_m * section.width_axis + depth_m * section.depth_axis);
  }

  const ImageEdges& image_;
  const ValveCandidate& valve_;
  ValveTracer tracer_;
  Eigen::Vector3d eye_in_object_;
};

std::vector<MiddleLine> PartsOf(const ValveModel& model) {
  if (model.IsLever())
    return {BarOf(Eigen::Vector3d(model.hub_radius_m, 0.0, 0.0),
                  Eigen::Vector3d(model.lever_length_m, 0.0, 0.0), model.tube_radius_m,
                  model.tube_radius_m)};
  std::vector<MiddleLine> parts = {RimOf(model)};
  for (int i = 0; i < model.spokes; ++i) parts.push_back(SpokeOf(model, AngleOfSpoke(model, i)));
  return parts;
}

using Pieces = std::vector<ImageEdges::Piece>;

std::vector<Pieces> PiecesOfParts(const SeenValve& seen, const ValveModel& model) {
  std::vector<Pieces> parts;
  for (const MiddleLine& part : PartsOf(model)) parts.push_back(seen.PiecesOf(part));
  return parts;
}

/// Of all parts together.
Pieces Joined(const std::vector<Pieces>& parts) {
  Pieces outline;
  for (const Pieces& part : parts) outline.insert(outline.end(), part.begin(), part.end());
  return outline;
}

/// By how much the outline must move for the image's edges to lie on it: rig and fit are off.
Eigen::Vector2d BestMove(const ImageEdges& image, const Pieces& outline) {
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = image.SupportOf(outline).nats;
  for (int x = -kMostMove_px; x <= kMostMove_px; ++x)
    for (int y = -kMostMove_px; y <= kMostMove_px; ++y) {
      const Eigen::Vector2d move(x, y);
      const double nats = image.SupportOf(image.Moved(outline, move)).nats;
      if (!(nats > most)) continue;
      most = nats;
      best = move;
    }
  return best;
}

double FurtherOutline(const ImageEdges& image, const SeenValve& seen, const ValveModel& model,
                      const Eigen::Vector2d& move) {
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < model.spokes; ++i)
    for (const double turn : TurnsToFurtherSpokes(model)) {
      const OutlineSupport support = image.SupportOf(
          image.Moved(seen.PiecesOfFurther(SpokeOf(model, AngleOfSpoke(model, i) + turn)), move));
      if (support.length_px >= kLeastOutline_px) best = std::max(best, support.NatsPerPixel());
    }
  return std::isfinite(best) ? best : 0.0;
}

}  // namespace

double NatsOfOutline(const ImageEdges& image, const ValveCandidate& valve) {
  const Pieces outline = Joined(PiecesOfParts(SeenValve(image, valve), valve.model));
  return image.SupportOf(image.Moved(outline, BestMove(image, outline))).nats;
}

void AddEvidenceOfOutline(const ImageEdges& image, const ValveCandidate& valve,
                          ValveEvidence& evidence) {
  const SeenValve seen(image, valve);
  const std::vector<Pieces> parts = PiecesOfParts(seen, valve.model);
  const Pieces outline = Joined(parts);
  const Eigen::Vector2d move = BestMove(image, outline);
  double weakest = std::numeric_limits<double>::infinity();
  for (const Pieces& part : parts) {
    const OutlineSupport support = image.SupportOf(image.Moved(part, move));
    if (support.length_px >= kLeastOutline_px) weakest = std::min(weakest, support.NatsPerPixel());
  }
  evidence.outline_nats_per_px = image.SupportOf(image.Moved(outline, move)).NatsPerPixel();
  evidence.weakest_outline_nats_per_px = std::isfinite(weakest) ? weakest : 0.0;
  evidence.further_outline_nats_per_px = valve.model.IsLever() || valve.model.spokes == 0
                                             ? 0.0
                                             : FurtherOutline(image, seen, valve.model, move);
}

}  // namespace foresight
