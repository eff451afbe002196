#pragma once

#include <Eigen/Core>

#include "core/base/run_context.h"
#include "core/selfcheck/depth_edges.h"

namespace foresight {

struct CameraCheckOptions {
  DepthEdgeOptions edges;
  double reach_px = 12.0;        ///< how far off the camera is looked for
  double most_outward_px = 4.0;  ///< of the footprint's half width
  int least_edges = 80;
  double least_far_sigmas = 3.0;  ///< a place farther off must fit better by so many deviations
  int groups = 12;                ///< of edges, for the deviations
  /// Between surfaces nearer to each other than this a beam's echoes merge, and edges lie where its
  /// middle passes; beyond, the near surface reaches half a beam outwards.
  double merge_m = 0.45;
  /// Of one edge, for what the directions of all edges leave open; neighbours are off alike.
  double edge_sigma_px = 4.0;
  double outward_sigma_px = 3.0;
};

/// How the depth edges of one scan lie on the edges of its images.
struct CameraCheck {
  /// Turn of the lidar's points in camera that puts them on the image's edges, rad: how far the
  /// lidar turned against the camera since the calibration, about the camera's axes.
  Eigen::Vector3d turn_rad;
  Eigen::Matrix3d covariance;  ///< by leaving out groups of neighbouring edges, and what their
                               ///< directions leave open
  double score = 0.0;          ///< mean edge strength at the depth edges, 0 to 1, after the turn
  double score_before = 0.0;   ///< with the rig as it is
  double score_aside = 0.0;    ///< mean where the edges are put somewhere else
  /// How sure it is that the turn fits better than none: the gain by its own deviation.
  double gain_sigmas = 0.0;
  /// How far upright edges lie outwards, before near and before far surfaces.
  Eigen::Vector2d outward_px = Eigen::Vector2d::Zero();
  int edges = 0;
  int images = 0;
  int scans = 1;  ///< that were gathered

  double Sigma(int axis) const { return std::sqrt(covariance(axis, axis)); }
  /// How much of what the edges' strength stands out by the turn gains.
  double GainOfContrast() const { return (score - score_before) / (score - score_aside); }
};

/// Fails with kTooFewPoints where the scan has no image, or too few depth edges in its images.
Result<CameraCheck> CheckCamera(const Scan& scan, const RegisteredScan& cloud,
                                const CameraCheckOptions& options, const RunContext& context);

}  // namespace foresight
