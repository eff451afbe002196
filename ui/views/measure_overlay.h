#pragma once

#include "ui/viewmodels/measure_view_model.h"

namespace foresight {

class CloudCanvas;
class DepthCanvas;
class ImageCanvas;

// Bind the measuring tool and the measurements of a document to a canvas: clicks go to the tool,
// what was measured is drawn with its values, and one that is chosen in the list is centred.
// Session and tool outlive the canvas.

void BindMeasurements(CloudCanvas* canvas, SessionModel* session, MeasureViewModel* measure);
void BindMeasurements(DepthCanvas* canvas, SessionModel* session, MeasureViewModel* measure);
void BindMeasurements(ImageCanvas* canvas, SessionModel* session, MeasureViewModel* measure);

}  // namespace foresight
