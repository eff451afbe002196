#pragma once

#include <vtkActor.h>
#include <vtkImageActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "core/base/image.h"

namespace foresight {

/// A second picture of the same size, shown right of a line that parts it from the first.
class WipeActors {
 public:
  explicit WipeActors(vtkRenderer* renderer);

  /// nullptr = no second picture.
  void SetPicture(const ColorImage* picture);
  void SetShare(double share);
  bool Shown() const { return width_ > 0; }
  double Share() const { return share_; }
  /// The line in pixels of the picture.
  double Column() const { return share_ * width_ - 0.5; }

 private:
  void Place();

  vtkSmartPointer<vtkImageActor> picture_;
  vtkSmartPointer<vtkActor> rim_;
  vtkSmartPointer<vtkActor> line_;
  int width_ = 0;
  int height_ = 0;
  double share_ = 0.5;
};

}  // namespace foresight
