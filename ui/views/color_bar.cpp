#include "ui/views/color_bar.h"

#include <vtkTextProperty.h>
#include <algorithm>

namespace foresight {

vtkSmartPointer<vtkScalarBarActor> MakeColorBar() {
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.2f");
  bar->SetUnconstrainedFontSize(true);
  bar->SetBarRatio(0.28);
  for (vtkTextProperty* text : {bar->GetLabelTextProperty(), bar->GetTitleTextProperty()}) {
    text->SetFontFamilyToArial();
    text->SetFontSize(14);
    text->SetColor(0.90, 0.92, 0.94);
    text->BoldOff();
    text->ItalicOff();
    text->ShadowOff();
  }
  return bar;
}

void PlaceColorBar(vtkScalarBarActor* bar, int canvas_width, int canvas_height) {
  constexpr int kMargin_px = 12;
  constexpr int kTallest_px = 320;
  const int height = std::clamp(canvas_height - 2 * kMargin_px, 40, kTallest_px);
  const double width_share = static_cast<double>(kColorBarWidth_px - 8) / std::max(1, canvas_width);
  const double height_share = static_cast<double>(height) / std::max(1, canvas_height);
  bar->SetPosition(1.0 - width_share, 0.5 * (1.0 - height_share));
  bar->SetWidth(width_share);
  bar->SetHeight(height_share);
}

}  // namespace foresight
