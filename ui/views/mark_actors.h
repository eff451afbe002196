#pragma once

#include <vtkActor.h>
#include <vtkPlane.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

#include "core/pictures/sample_marks.h"

namespace foresight {

/// Sample marks over an image: dots and symbols, each on a dark rim. They can be cut at a column,
/// where a wipe parts two images with marks of their own. Pixel (u, v) lies at
/// (u, image_height - 1 - v).
class MarkActors {
 public:
  explicit MarkActors(vtkRenderer* renderer);

  void Set(std::vector<SampleMark> marks, int image_height);
  /// Symbols keep their size on the screen: `scale` pixels of the image lie in one of the widget.
  void SetScale(double scale);
  void ShowEverywhere();
  void ShowLeftOf(double column);
  void ShowRightOf(double column);
  void Hide();

 private:
  void DrawSymbols();
  void ShowBeside(double column, double normal_x);
  std::array<vtkActor*, 4> All() const { return {dot_rims_, dots_, symbol_rims_, symbols_}; }

  std::vector<SampleMark> marks_;
  int image_height_ = 1;
  double scale_ = 1.0;
  vtkSmartPointer<vtkActor> dot_rims_;
  vtkSmartPointer<vtkActor> dots_;
  vtkSmartPointer<vtkActor> symbol_rims_;
  vtkSmartPointer<vtkActor> symbols_;
  vtkSmartPointer<vtkPlane> cut_;
};

}  // namespace foresight
