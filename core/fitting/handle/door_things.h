#pragma once

#include <optional>
#include <vector>

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/handle/door_columns.h"
#include "core/fitting/sampled_coverage.h"
#include "core/fitting/solids/image_edges.h"
#include "core/objects/handle_model.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// What may sit on a door: round bars, balls (bars without a length) and thin plates on the door,
/// made ready for many rays by closed forms. All a beam's likelihood has to know of a door handle
/// and of its alternatives.
class DoorThing {
 public:
  /// A plate in the object's frame, facing z.
  struct Plate {
    double front_m = 0.0;                              ///< z of its front
    Eigen::Vector2d at = Eigen::Vector2d::Zero();      ///< its middle
    double turn_rad = 0.0;                             ///< of a rectangle about z
    double radius_m = 0.0;                             ///< of a round one; 0 = a rectangle
    Eigen::Vector2d half_m = Eigen::Vector2d::Zero();  ///< of a rectangle
  };

  DoorThing(const std::vector<HandleBar>& bars, const std::vector<Plate>& plates,
            const Rigid<frame::Base, frame::Object>& base_from_object);

  /// What the ray enters first, else what it passes by least.
  std::optional<BeamIntersection> Intersect(const RangeRay& ray, double reach_m) const;
  /// For IntersectColumns, which does the same.
  PlacedDoorThing Placed() const;
  /// The same as solids, for its outline in an image: bars with round ends.
  std::vector<SolidPart> Parts() const;
  const Rigid<frame::Base, frame::Object>& base_from_object() const { return base_from_object_; }

 private:
  struct LocalRay {
    Eigen::Vector3d origin, direction;
  };
  struct Bar {
    Eigen::Vector3d from, along;  ///< along: length 1; 0 for a ball
    double length_m, radius_m;
    Eigen::Vector3d middle;
    double bound_m;  ///< of a sphere round it
  };

  struct TurnedPlate {
    Plate plate;
    Eigen::Vector2d along;  ///< of its own x, length 1
  };

  /// nullopt where the ray stays further than `reach_m` from it.
  static std::optional<BeamIntersection> IntersectBar(const LocalRay& ray, const Bar& bar,
                                                      double reach_m);
  static std::optional<BeamIntersection> IntersectPlate(const LocalRay& ray,
                                                        const TurnedPlate& turned);

  Rigid<frame::Base, frame::Object> base_from_object_;
  std::vector<Bar> bars_;
  std::vector<TurnedPlate> plates_;
  Eigen::Matrix3d object_from_base_;
  Eigen::Vector3d position_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< in base, of a sphere round all
  double bound_m_ = 0.0;                              ///< ... and its radius
};

/// What a handle stands on, in a frame whose origin is that far off the door.
DoorThing::Plate PlateOf(HandleModel::Plate kind, double standoff_m);

/// A handle at a place.
DoorThing ThingOf(const HandleModel& model,
                  const Rigid<frame::Base, frame::Object>& base_from_object);

CoverBeam CoverBy(DoorThing thing);
/// The same of all rays at once, which takes a fraction of the time.
CoverBeams CoverAllBy(const DoorThing& thing);

/// What the image says of its outline; nothing where there is none.
OutlineSupport OfImage(const DoorThing& thing, const RaySet& rays);

/// Log likelihood of all rays, and of the image, with that thing on the door.
double LogLikelihoodOf(const DoorThing& thing, const BeamLikelihood& likelihood);

}  // namespace foresight
