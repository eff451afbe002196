#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/fitting/fit_origin.h"
#include "core/fitting/verdict.h"
#include "core/geometry/plane.h"
#include "core/geometry/rigid.h"
#include "core/objects/handle_model.h"

namespace foresight {

/// How well the measurements support a door handle.
struct HandleEvidence {
  int rays = 0;               ///< looked at
  int hits = 0;               ///< rays with at least half of their footprint on it
  double inlier_ratio = 0.0;  ///< of the hits, those with a range that agrees
  double see_through = 0.0;   ///< of the hits, those whose beam went on behind the handle
  double rms_m = 0.0;         ///< of the agreeing ranges
  double covered = 0.0;       ///< of the lever's length, the fraction with agreeing hits
  double beside = 0.0;        ///< fraction of the rays round it that end before the door
  /// Odds against the best lever that points the other way: 1.25 for each deviation over scan lines
  /// that it is behind, edges_nats and image_nats.
  double mirror_margin_nats = 0.0;
  double edges_nats = 0.0;           ///< what the door's edges say of the way (EdgesForWay)
  double image_nats = 0.0;           ///< what the outline in the image says of it, 4.5 at most
  double outline_nats_per_px = 0.0;  ///< how well its outline lies on edges; 0 = no image
  double length_margin_nats = 0.0;   ///< ahead of the best one that is 20 mm or more off
  double gain_nats = 0.0;            ///< ahead of the bare door
  /// Ahead of the best knob, pull bar, bow, bar on a post or box.
  double alternative_margin_nats = 0.0;
  std::string best_alternative;  ///< "knob", "pull bar", "bow", "bar on a post", "box"
};

/// One answer to "where is the handle".
struct HandleCandidate {
  Rigid<frame::Base, frame::Object> base_from_object;
  HandleModel model;
  double log_likelihood = 0.0;
};

/// A fitted door handle.
struct HandleDetection {
  HandleCandidate best;
  Eigen::Vector3d sigma_position_m = Eigen::Vector3d::Zero();  ///< along the object's axes
  double sigma_turn_rad = 0.0;                                 ///< of x about the door's normal
  double sigma_normal_rad = 0.0;                               ///< of the door's normal
  double sigma_length_m = 0.0;
  /// Of the turn as independent beams would have it: the verdict's weights were fitted to that.
  double beam_sigma_turn_rad = 0.0;
  /// Of the pivot's place as independent lines would have it, for the verdict as well.
  double line_sigma_pivot_m = 0.0;
  PoseCovariance covariance = PoseCovariance::Constant(std::nan(""));
  Plane door;  ///< in base, its normal towards the viewer
  HandleEvidence evidence;
  Verdict verdict;
  /// Best first: the lever that points the other way, and levers 20 mm (on the
  /// same bar up to 60 mm) shorter and longer.
  std::vector<HandleCandidate> alternatives;
  FitOrigin origin;
};

}  // namespace foresight
