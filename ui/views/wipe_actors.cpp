#include "ui/views/wipe_actors.h"

#include <vtkImageMapper3D.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "ui/render/vtk_data.h"

namespace foresight {
namespace {

vtkSmartPointer<vtkActor> UprightLine(double gray, float width, double z) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  // From far below to far above every image, so that only its place changes.
  mapper->SetInputData(VtkLinesOf({{{0.0, -1e5, 0.0}, {0.0, 1e5, 0.0}}}));
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(gray, gray, gray);
  actor->GetProperty()->SetLineWidth(width);
  actor->GetProperty()->LightingOff();
  actor->SetPosition(0.0, 0.0, z);
  actor->VisibilityOff();
  return actor;
}

}  // namespace

WipeActors::WipeActors(vtkRenderer* renderer)
    : image_(vtkSmartPointer<vtkImageActor>::New()),
      rim_(UprightLine(0.0, 6.0f, 1.5)),
      line_(UprightLine(1.0, 2.0f, 1.6)) {
  image_->GetMapper()->SetInputData(VtkImageOf(ColorImage(1, 1)));
  image_->SetPosition(0.0, 0.0, 0.5);  // between the first image and what is drawn over both
  image_->VisibilityOff();
  renderer->AddActor(image_);
  renderer->AddActor(rim_);
  renderer->AddActor(line_);
}

void WipeActors::SetImage(const ColorImage* image) {
  width_ = image != nullptr ? image->width() : 0;
  height_ = image != nullptr ? image->height() : 0;
  if (image != nullptr) image_->GetMapper()->SetInputData(VtkImageOf(*image));
  Place();
}

void WipeActors::SetFraction(double fraction) {
  fraction_ = fraction;
  Place();
}

void WipeActors::Place() {
  const int first = static_cast<int>(std::ceil(Column()));
  for (auto* line : {rim_.Get(), line_.Get()}) {
    line->SetVisibility(Shown());
    line->SetPosition(Column(), 0.0, line->GetPosition()[2]);
  }
  image_->SetVisibility(Shown() && first < width_);
  if (Shown())
    image_->SetDisplayExtent(std::clamp(first, 0, width_ - 1), width_ - 1, 0, height_ - 1, 0, 0);
}

}  // namespace foresight
