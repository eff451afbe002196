#pragma once

#include <vtkBillboardTextActor3D.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace foresight {

/// Short texts at places of a VTK scene, always facing the viewer, on a dark ground.
class LabelActors {
 public:
  explicit LabelActors(vtkRenderer* renderer) : renderer_(renderer) {}

  void Clear();
  void Add(const Eigen::Vector3d& at, const std::string& text, Rgb8 color);

 private:
  vtkRenderer* renderer_;
  std::vector<vtkSmartPointer<vtkBillboardTextActor3D>> actors_;
};

}  // namespace foresight
