#pragma once

#include <vtkActor.h>
#include <vtkImageActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "core/base/image.h"

namespace foresight {

/// A second image of the same size, shown right of a line that parts it from the first.
class WipeActors {
 public:
  explicit WipeActors(vtkRenderer* renderer);

  /// nullptr = no second image.
  void SetImage(const ColorImage* image);
  void SetFraction(double fraction);
  bool Shown() const { return width_ > 0; }
  double Fraction() const { return fraction_; }
  /// The line in pixels of the image.
  double Column() const { return fraction_ * width_ - 0.5; }

 private:
  void Place();

  vtkSmartPointer<vtkImageActor> image_;
  vtkSmartPointer<vtkActor> rim_;
  vtkSmartPointer<vtkActor> line_;
  int width_ = 0;
  int height_ = 0;
  double fraction_ = 0.5;
};

}  // namespace foresight
