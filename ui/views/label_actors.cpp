#include "ui/views/label_actors.h"

#include <vtkTextProperty.h>

namespace foresight {

void LabelActors::Clear() {
  for (const auto& actor : actors_) renderer_->RemoveActor(actor);
  actors_.clear();
}

void LabelActors::Add(const Eigen::Vector3d& at, const std::string& text, Rgb8 color) {
  auto actor = vtkSmartPointer<vtkBillboardTextActor3D>::New();
  actor->SetInput(text.c_str());
  actor->SetPosition(at.x(), at.y(), at.z());
  actor->SetDisplayOffset(8, 8);
  vtkTextProperty* style = actor->GetTextProperty();
  style->SetFontSize(14);
  style->SetColor(color.r / 255.0, color.g / 255.0, color.b / 255.0);
  style->SetBackgroundColor(0.05, 0.055, 0.07);
  style->SetBackgroundOpacity(0.75);
  renderer_->AddActor(actor);
  actors_.push_back(actor);
}

}  // namespace foresight
