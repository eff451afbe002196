#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "ui/render/vtk_data.h"
#include "ui/views/outlines.h"

namespace foresight {

/// Outlines in VTK, each on a dark rim so that it is seen on any ground.
class OutlineActors {
 public:
  OutlineActors(vtkRenderer* renderer, double z) : renderer_(renderer), z_(z) {}

  void Clear();
  void Add(const Polylines& lines, const OutlineStyle& style);

 private:
  void AddActor(const Polylines& lines, Rgb8 color, float width_px, double z);

  vtkRenderer* renderer_;
  double z_;  ///< in front of an image; 0 where lines have a depth of their own
  std::vector<vtkSmartPointer<vtkActor>> actors_;
};

}  // namespace foresight
