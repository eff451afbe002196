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
  // From far below to far above every picture, so that only its place changes.
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
    : picture_(vtkSmartPointer<vtkImageActor>::New()),
      rim_(UprightLine(0.0, 6.0f, 1.5)),
      line_(UprightLine(1.0, 2.0f, 1.6)) {
  picture_->GetMapper()->SetInputData(VtkImageOf(ColorImage(1, 1)));
  picture_->SetPosition(0.0, 0.0, 0.5);  // between the first picture and what is drawn over both
  picture_->VisibilityOff();
  renderer->AddActor(picture_);
  renderer->AddActor(rim_);
  renderer->AddActor(line_);
}

void WipeActors::SetPicture(const ColorImage* picture) {
  width_ = picture != nullptr ? picture->width() : 0;
  height_ = picture != nullptr ? picture->height() : 0;
  if (picture != nullptr) picture_->GetMapper()->SetInputData(VtkImageOf(*picture));
  Place();
}

void WipeActors::SetShare(double share) {
  share_ = share;
  Place();
}

void WipeActors::Place() {
  const int first = static_cast<int>(std::ceil(Column()));
  for (auto* line : {rim_.Get(), line_.Get()}) {
    line->SetVisibility(Shown());
    line->SetPosition(Column(), 0.0, line->GetPosition()[2]);
  }
  picture_->SetVisibility(Shown() && first < width_);
  if (Shown())
    picture_->SetDisplayExtent(std::clamp(first, 0, width_ - 1), width_ - 1, 0, height_ - 1, 0, 0);
}

}  // namespace foresight
