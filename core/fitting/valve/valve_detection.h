#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "core/fitting/fit_origin.h"
#include "core/fitting/verdict.h"
#include "core/geometry/rigid.h"
#include "core/objects/valve_model.h"

namespace foresight {

/// How well the measurements support a fit.
struct ValveEvidence {
  int rays = 0;               ///< looked at
  int hits = 0;               ///< rays that intersect the template
  double inlier_ratio = 0.0;  ///< of the hits, those with a range that agrees
  double see_through = 0.0;   ///< of the hits, those whose beam went on behind the template
  double blocked_gaps = 0.0;  ///< of the rays between the spokes, those that did not get through
  double rms_m = 0.0;         ///< of the agreeing ranges
  double arc_coverage = 0.0;  ///< fraction of the rim's circle, or of a lever, with support
  double margin_nats = 0.0;   ///< log likelihood ahead of the next number of spokes or kind
  double gain_nats = 0.0;     ///< log likelihood ahead of no valve at all
  /// Of the rays on the spoke that is seen worst, those with a range that agrees; 1 without spokes.
  double weakest_spoke = 1.0;
  /// Of margin_nats, in deviations, when scan lines and not beams are independent.
  double margin_line_sigmas = 0.0;
  /// How much the beams on the spoke that is seen worst speak for it, against no valve; 0 where no
  /// beam is on it, and without spokes.
  double weakest_spoke_nats = 0.0;
  /// The same of the beams on and beside the middle half of a spoke.
  double weakest_spoke_middle_nats = 0.0;
  /// How much the beams between the spokes speak for one more, at the angle where they speak for it
  /// most; 0 without spokes.
  double further_spoke_nats = 0.0;
  /// How much the beams on and beside the rim speak for it; 0 for a lever.
  double rim_nats = 0.0;
  /// The same of the eighth and of the quarter of the rim that they speak for least.
  double weakest_arc_nats = 0.0;
  double weakest_quarter_nats = 0.0;
  /// Log likelihood ahead of the rim before a pipe that looks like the spokes; nullopt but for two
  /// spokes.
  std::optional<double> pipe_margin_nats = std::nullopt;
  /// How well the outline of rim and spokes lies on the image's edges, nats a pixel: all of it, and
  /// the part that does worst. 0 without an image.
  double outline_nats_per_px = 0.0;
  double weakest_outline_nats_per_px = 0.0;
  /// The same of one more spoke, at the angle between the spokes where the image shows it best; 0
  /// without spokes.
  double further_outline_nats_per_px = 0.0;
};

/// One answer to "where is the valve": the best one, or an alternative.
struct ValveCandidate {
  Rigid<frame::Base, frame::Object> base_from_object;
  ValveModel model;
  double log_likelihood = 0.0;  ///< of the rays, and of the image where it was asked (image_nats)
  /// How strongly the valve returns light compared with the wall: a beam on both reads a range
  /// nearer to the brighter one.
  double brightness = 1.0;
  double image_nats = 0.0;  ///< of log_likelihood, what an image says of its outline
};

/// A fitted valve.
struct ValveDetection {
  ValveCandidate best;
  bool phase_observable = true;  ///< false: the direction of x means nothing (a disc)
  Eigen::Vector3d sigma_position_m = Eigen::Vector3d::Zero();  ///< along the object's axes
  double sigma_axis_rad = 0.0;
  double sigma_phase_rad = 0.0;
  ValveEvidence evidence;
  Verdict verdict;
  std::vector<ValveCandidate> alternatives;  ///< best first
  /// Of best; about the object's axes. The centre along the axis (2, 2) trades with the dish and is
  /// known worse than across. NaN where a disc has no phase.
  PoseCovariance covariance = PoseCovariance::Constant(std::nan(""));
  FitOrigin origin;
};

}  // namespace foresight
