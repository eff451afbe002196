#pragma once

#include <span>
#include <vector>

#include "core/fitting/ray_columns.h"

namespace foresight {

/// What sits on a door, in plain numbers and in the object's frame: this header is read where Eigen
/// must not be.
struct PlacedDoorThing {
  struct Bar {
    double from[3] = {};
    double along[3] = {};  ///< length 1; 0 for a ball
    double length_m = 0.0;
    double radius_m = 0.0;
    double middle[3] = {};
    double bound_m = 0.0;  ///< radius of a sphere round it
  };
  struct Plate {
    double front_m = 0.0;   ///< z of its front
    double at[2] = {};      ///< its middle
    double along[2] = {};   ///< x of a rectangle, length 1
    double radius_m = 0.0;  ///< of a round one; 0 = a rectangle
    double half_m[2] = {};  ///< of a rectangle
  };

  std::vector<Bar> bars;
  std::vector<Plate> plates;
  double object_from_base[9] = {};  ///< a rotation, row by row
  double offset[3] = {};            ///< x_object = object_from_base x + offset
  double middle[3] = {};            ///< in base, of a sphere round all
  double bound_m = 0.0;             ///< ... and its radius
};

/// DoorThing::Intersect for many rays at once, as IntersectColumns has it of solids.
void IntersectColumns(const PlacedDoorThing& thing, const RayColumns& rays,
                      std::span<double> clearance_m, std::span<double> range_m);

}  // namespace foresight
