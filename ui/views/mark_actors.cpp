#include "ui/views/mark_actors.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "ui/render/paint_mark.h"
#include "ui/render/vtk_data.h"
#include "ui/render/vtk_marks.h"

namespace foresight {
namespace {

/// Marks with their own colours, or the dark rim below them.
vtkSmartPointer<vtkActor> MarkActor(bool rim, double z) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(VtkLinesOf({}));
  mapper->SetScalarVisibility(!rim);
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  actor->GetProperty()->SetOpacity(rim ? 0.7 : 1.0);
  actor->GetProperty()->LightingOff();
  actor->SetPosition(0.0, 0.0, z);
  return actor;
}

void SetData(vtkActor* actor, vtkPolyData* data) {
  static_cast<vtkPolyDataMapper*>(actor->GetMapper())->SetInputData(data);
}

}  // namespace

MarkActors::MarkActors(vtkRenderer* renderer)
    : dot_rims_(MarkActor(true, 0.80)),
      dots_(MarkActor(false, 0.82)),
      symbol_rims_(MarkActor(true, 0.84)),
      symbols_(MarkActor(false, 0.86)),
      cut_(vtkSmartPointer<vtkPlane>::New()) {
  for (vtkActor* actor : All()) renderer->AddActor(actor);
}

void MarkActors::Set(std::vector<SampleMark> marks, int image_height) {
  marks_ = std::move(marks);
  image_height_ = image_height;
  const auto dots = VtkDotsOf(marks_, image_height_);
  for (vtkActor* actor : {dot_rims_.Get(), dots_.Get()}) SetData(actor, dots);
  DrawSymbols();
}

void MarkActors::SetScale(double scale) {
  if (scale == scale_) return;
  scale_ = scale;
  if (!marks_.empty()) DrawSymbols();
}

void MarkActors::DrawSymbols() {
  const MarkSize size = MarkSizeAt(1.0 / scale_);
  const auto symbols = VtkSymbolsOf(marks_, image_height_, size.half_px * scale_);
  for (vtkActor* actor : {symbol_rims_.Get(), symbols_.Get()}) SetData(actor, symbols);
  symbols_->GetProperty()->SetLineWidth(static_cast<float>(size.line_px));
  symbol_rims_->GetProperty()->SetLineWidth(static_cast<float>(size.rim_px));
  dots_->GetProperty()->SetPointSize(static_cast<float>(size.line_px + 0.8));
  dot_rims_->GetProperty()->SetPointSize(static_cast<float>(size.line_px + 2.2));
}

void MarkActors::ShowEverywhere() {
  for (vtkActor* actor : All()) {
    actor->GetMapper()->RemoveAllClippingPlanes();
    actor->VisibilityOn();
  }
}

void MarkActors::ShowLeftOf(double column) {
  ShowBeside(column, -1.0);
}

void MarkActors::ShowRightOf(double column) {
  ShowBeside(column, 1.0);
}

void MarkActors::ShowBeside(double column, double normal_x) {
  cut_->SetOrigin(column, 0.0, 0.0);
  cut_->SetNormal(normal_x, 0.0, 0.0);
  for (vtkActor* actor : All()) {
    actor->GetMapper()->RemoveAllClippingPlanes();
    actor->GetMapper()->AddClippingPlane(cut_);
    actor->VisibilityOn();
  }
}

void MarkActors::Hide() {
  for (vtkActor* actor : All()) actor->VisibilityOff();
}

}  // namespace foresight
