#pragma once

#include <vector>

#include "core/geometry/rigid.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {

/// The mean of rotations that lie close together, and of their translations.
template <class To, class From>
Rigid<To, From> MeanOf(const std::vector<Rigid<To, From>>& all) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  for (const auto& one : all) {
    sum += one.rotation().coeffs() * one.rotation().coeffs().transpose();
    translation += one.translation();
  }
  return {Eigen::Quaterniond(Eigen::Vector4d(EigenOf(sum).vectors.col(3))),
          translation / static_cast<double>(all.size())};
}

}  // namespace foresight
