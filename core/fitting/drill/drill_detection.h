#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/fitting/fit_origin.h"
#include "core/fitting/verdict.h"
#include "core/geometry/plane.h"
#include "core/objects/drill_model.h"

namespace foresight {

/// How well the measurements support a drill.
struct DrillEvidence {
  int rays = 0;                   ///< looked at
  int hits = 0;                   ///< rays that intersect the template
  double inlier_ratio = 0.0;      ///< of the hits, those with a range that agrees
  double see_through = 0.0;       ///< of the hits, those whose beam went on behind the template
  double rms_m = 0.0;             ///< of the agreeing ranges
  double yaw_margin_nats = 0.0;   ///< ahead of the best answer that points elsewhere (> 0.5 rad)
  double flip_margin_nats = 0.0;  ///< ahead of the same drill turned by 180 deg
  double head_nats = 0.0;         ///< ahead of body and foot alone: is a head seen at all?
  double gain_nats = 0.0;         ///< ahead of no drill at all
  double alternative_margin_nats = 0.0;  ///< ahead of the best free box, cylinder, or both
  std::string best_alternative;          ///< "box", "cylinder", "box and cylinder"
  /// Ahead of the best tool of any proportions that stands on the end of its grip; none for a kind
  /// without feet, and in files of earlier programs.
  std::optional<double> no_foot_margin_nats = {};
  /// Ahead of the same drill with a nozzle, longer than any chuck, in place of chuck and bit; none
  /// for a kind without chuck, and in files of earlier programs.
  std::optional<double> nozzle_margin_nats = {};
  /// Ahead of the best tool of any proportions whose head goes on, as thick as it is, where a drill
  /// has its chuck; none for a kind without a chuck that points ahead, and in files of earlier
  /// programs.
  std::optional<double> no_chuck_margin_nats = {};
  /// How much likelier a drill of any proportions is in its place when unusual proportions cost
  /// nothing; high for what is no drill. None in files of earlier programs.
  std::optional<double> unusual_nats = {};
};

/// One answer to "where is the drill".
struct DrillCandidate {
  Rigid<frame::Base, frame::Object> base_from_object;
  DrillModel model;
  double log_likelihood = 0.0;
};

/// A fitted drill.
struct DrillDetection {
  DrillCandidate best;
  Eigen::Vector3d sigma_position_m = Eigen::Vector3d::Zero();  ///< along the object's axes
  double sigma_yaw_rad = 0.0;
  double sigma_axis_rad = 0.0;  ///< of the body's axis, where it is known worst
  PoseCovariance covariance = PoseCovariance::Constant(std::nan(""));
  std::optional<Plane> table;  ///< in base, normal up; what it was found to stand on
  DrillEvidence evidence;
  Verdict verdict;
  std::vector<DrillCandidate> alternatives;  ///< best first; other directions and templates
  FitOrigin origin;
};

}  // namespace foresight
