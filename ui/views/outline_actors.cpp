#include "ui/views/outline_actors.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace foresight {

void OutlineActors::Clear() {
  for (const auto& actor : actors_) renderer_->RemoveActor(actor);
  actors_.clear();
}

void OutlineActors::Add(const Polylines& lines, const OutlineStyle& style) {
  if (lines.empty()) return;
  constexpr Rgb8 kRim = {12, 14, 18};
  AddActor(lines, kRim, style.width_px + 2.0f, z_);
  AddActor(lines, style.color, style.width_px, z_ > 0.0 ? z_ + 0.02 : 0.0);
}

void OutlineActors::AddActor(const Polylines& lines, Rgb8 color, float width_px, double z) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(VtkLinesOf(lines));
  // Lines in space lie in one place with their rim: what is added later is drawn over it.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(
      0.0, -2.0 * static_cast<double>(actors_.size() % 2));
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.r / 255.0, color.g / 255.0, color.b / 255.0);
  actor->GetProperty()->SetLineWidth(width_px);
  actor->GetProperty()->LightingOff();
  actor->SetPosition(0.0, 0.0, z);
  renderer_->AddActor(actor);
  actors_.push_back(actor);
}

}  // namespace foresight
