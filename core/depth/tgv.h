#pragma once

#include "core/depth/upsample.h"

namespace foresight {

/// Ferstl et al., "Image guided depth upsampling using anisotropic total generalized variation",
/// ICCV 2013. Weights as in their code; the depth is scaled to [0, 1] by its range, the guide's
/// intensity to [0, 1].
struct TgvOptions {
  double smoothness = 1.2;      ///< alpha_1, of |T (grad u - v)|: how much u may leave its slope v
  double straightness = 17.0;   ///< alpha_0, of |grad v|: how much the slope may change
  double edge_steepness = 9.0;  ///< beta of T, how soon an edge of the guide frees the depth
  double edge_power = 0.85;     ///< gamma of T
  double data_weight = 400.0;   ///< lambda, of the squared distance to the samples
  int iterations = 600;         ///< primal-dual steps

  Status Check() const;
};

/// The depth u and its slope v that minimise
///   lambda / 2 sum_samples (u - R)^2 + alpha_1 sum |T (grad u - v)| + alpha_0 sum |grad v|,
///   T = exp(-beta |grad I|^gamma) n n^T + n' n'^T,  n along grad I, n' across it:
/// piecewise planes that may break where the guide has an edge. Preconditioned primal-dual steps
/// from a smooth fill, a fixed number of them. Every pixel gets a depth, however far from a sample;
/// the method does not know how good it is: confidence and max_confidence are 1. Fails with
/// kInvalidInput when the guide has another size than the samples' image, kTooFewPoints when no
/// sample is kept, kCancelled. O(pixels * iterations).
Result<DenseDepth> UpsampleTgv(const AlignedSamples& samples, const ColorImage& guide,
                               const TgvOptions& options, const RunContext& context);

}  // namespace foresight
