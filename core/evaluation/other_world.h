#pragma once

#include <Eigen/Core>

#include "core/base/random.h"
#include "core/evaluation/fit_trial.h"

namespace foresight {

// The other world. The fits were made on the populations of this folder, and know their lidar's
// footprint, pulse length and noise, their materials and their regions. The scenes of other_*.h
// share none of these. THEY JUDGE ONLY: nothing, no weight, no gate, no constant and no choice
// between two ways of fitting, may ever be fitted to them or chosen by them.

/// One paint in eight is nearly black to the laser, one in eight shines, one in twelve is
/// translucent and reads up to 8 mm too long.
Material OtherMaterial(Random& random);

/// How the thing is measured: footprint (2 to 10 by 4 to 20 mrad, even or Gaussian), pulse (0.08 to
/// 1.5 m, its range between mean and leading edge), noise of 3 to 25 mm with the tails of Student's
/// t of 3 to 6 degrees of freedom, range walk of black of up to 20 mm, motor errors, a rig off by
/// up to 0.2 deg and 5 mm, one scan in eight interrupted after 55 to 90 % of its lines, regions as
/// rectangles (two in three) and tight boxes. Fills what the trial's scene says of these.
void SetOtherConditions(Random& random, FitTrialScene& trial);

/// A sweep past a thing at this elevation and of this half angle, both in radians, with a margin of
/// `least_margin_deg` to 14 degrees on both sides, at a fifth to nine tenths of a degree a line.
ScanPlan OtherPlan(double elevation_rad, double half_rad, double least_margin_deg, Random& random);

/// A mesh without vertices yet, at a pose in robot.
SceneMesh OtherMeshAt(const char* name, const Rigid<frame::Robot, frame::Object>& robot_from_object,
                      const Material& material);

/// From where the head of DefaultSensorRig looks, in robot.
Eigen::Vector3d OtherHead();

/// Every mesh of a scene from the first on: what an operator draws a region round.
void AddObjectPoints(const Scene& scene, std::size_t first_mesh, FitTrialScene& trial);

/// Cables and hands between the head and a thing of this size about a place in robot: a cable in
/// two of five scenes, a hand in one of five.
void AddOccluders(const Eigen::Vector3d& place, double radius_m, Random& random, Scene& scene);

/// A plane that fills the view behind things, and boxes and pipes on it.
void AddOtherWall(const Eigen::Vector3d& foot, const Eigen::Vector3d& normal, double clear_m,
                  Random& random, Scene& scene);

}  // namespace foresight
