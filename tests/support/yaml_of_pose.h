#pragma once

#include <fmt/format.h>

#include <string>

#include "core/geometry/rigid.h"

namespace foresight {

/// A pose as files have it.
template <class To, class From>
std::string Yaml(const Rigid<To, From>& pose) {
  const Eigen::Quaterniond& q = pose.rotation();
  const Eigen::Vector3d& t = pose.translation();
  return fmt::format("{{quaternion_wxyz: [{}, {}, {}, {}], translation_m: [{}, {}, {}]}}", q.w(),
                     q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
}

}  // namespace foresight
