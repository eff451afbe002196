#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/fitting/drill/drill_state.h"
#include "core/fitting/drill/fit_drill.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/solids/image_edges.h"

namespace foresight {

/// Counts what was measured in a region says about a drill (RaySet::Measured); the likelihoods are
/// left at 0.
DrillEvidence GatherEvidence(const RaySet& rays, const DrillCandidate& drill);

/// What Verdict::features holds, in its order.
std::vector<std::string> DrillFeatureNames();

/// What else is asked before a drill is confirmed.
struct DrillSupport {
  /// Of the yaw as independent beams would have it (SetSigmas): the weights were fitted to that.
  double beam_sigma_yaw_rad = 0.0;
  /// Log likelihood, without priors, ahead of the drill turned by 180 deg with any proportions.
  double any_flip_margin_nats = 0.0;
  /// The same of two drills of any proportions, the one that points its way and the turned one.
  double any_way_margin_nats = 0.0;
  /// Ahead of that drill in deviations, when scan lines and not beams are independent.
  double flip_line_sigmas = 0.0;
  /// Ahead of a head that stays as wide to its end, and of the drill without its chuck; 0 for a
  /// kind without chuck.
  double blunt_margin_nats = 0.0;
  double chuck_nats = 0.0;
  /// Ahead of the same drill whose feet are no larger than its grip is thick, and stand under it;
  /// infinite for a kind without feet.
  double foot_nats = std::numeric_limits<double>::infinity();
  /// Log of the prior's density: how usual a drill of this place, size and build is.
  double proportions_nats = 0.0;
  /// What the image says of its outline, and how far that is ahead of the drill turned by 180 deg;
  /// 0 without an image.
  OutlineSupport outline = {};
  double image_flip_nats = 0.0;
};

/// How far an operator may trust a detection whose evidence, sigmas and candidates are filled in.
/// The probability is the shipped model's (resources/verdicts/drill_*), below LIKELY where
/// a box or a cylinder is 150 : 1 likelier; hard gates
/// keep what no probability should: a confirmed drill stands on a table near the region's centre,
/// has enough measurements on it, is not seen through, shows its head and its chuck, explains the
/// rays better than a box and a cylinder, a tool without a foot, without a chuck or with a nozzle,
/// is built as drills are, lies within the region, has no second direction close behind and no
/// parameter at a bound. `rays` are those of the `region` that it was fitted to.
Verdict AssessDrill(const RaySet& rays, const RaySet& region, const DrillDetection& detection,
                    const DrillState& drill, const DrillPrior& prior, const DrillSupport& support);

}  // namespace foresight
