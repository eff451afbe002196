#pragma once

#include <Eigen/Core>

namespace foresight {

/// The rotation R that makes trace(R^T matrix) largest: the nearest to the matrix in the Frobenius
/// norm and, for the sum of to * from^T over pairs of vectors, the one that brings `from` to `to`
/// with least squares (Kabsch 1976, Umeyama 1991). Never a reflection.
///
/// Compiled once: every file that decomposes by itself compiles a singular value decomposition.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix);

}  // namespace foresight
