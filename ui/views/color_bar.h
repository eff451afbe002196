#pragma once

#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>

namespace foresight {

/// Room to the right of a canvas that a colour bar takes, logical pixels.
constexpr int kColorBarWidth_px = 92;

/// A colour bar in the type of the panes.
vtkSmartPointer<vtkScalarBarActor> MakeColorBar();

/// Puts it at the right edge of a canvas of this size.
void PlaceColorBar(vtkScalarBarActor* bar, int canvas_width, int canvas_height);

}  // namespace foresight
