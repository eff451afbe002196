#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>

#include "core/fitting/fit_origin.h"
#include "core/fitting/verdict.h"
#include "core/geometry/rigid.h"
#include "core/objects/cylinder_model.h"

namespace foresight {

/// How well the measurements support a cylinder.
struct CylinderEvidence {
  int rays = 0;               ///< looked at
  int hits = 0;               ///< rays that intersect the cylinder
  double inlier_ratio = 0.0;  ///< of the hits, those with a range that agrees
  double see_through = 0.0;   ///< of the hits, those whose beam went on behind it
  /// Median of |measured - predicted range| over the hits within 0.15 m.
  double residual_mad_m = 0.0;
  double range_sigma_m = 0.0;    ///< deviation of a range, found from those
  double seen_arc_rad = 0.0;     ///< of the circle that its agreeing hits span
  double box_margin_nats = 0.0;  ///< ahead of the best box in its place, parameters paid for
  /// Fraction of the agreeing hits that end in the box that the operator drew; none where the
  /// region is another one, and in files of earlier programs.
  std::optional<double> in_drawn_box = {};
};

/// A fitted cylinder. There is no calibrated probability for it, so it is never CONFIRMED.
struct CylinderDetection {
  /// The origin is the middle of the seen part, z its axis, upwards. In base.
  Rigid<frame::Base, frame::Object> base_from_object;
  CylinderModel model;
  double sigma_radius_m = std::nan("");
  double sigma_across_m = std::nan("");  ///< of the axis' place, the larger of both ways
  double sigma_axis_rad = std::nan("");  ///< of its direction, likewise
  /// Across and about the axis' two sides; along z, where it may go on, and about it NaN.
  PoseCovariance covariance = PoseCovariance::Constant(std::nan(""));
  CylinderEvidence evidence;
  /// UNSURE or LIKELY; its probability is NaN.
  Verdict verdict;
  FitOrigin origin;
};

}  // namespace foresight
