#include "ui/views/measure_overlay.h"

#include "ui/views/cloud_canvas.h"
#include "ui/views/corner_tags.h"
#include "ui/views/depth_canvas.h"
#include "ui/views/image_canvas.h"
#include "ui/views/measurement_lines.h"

namespace foresight {
namespace {

/// Calls `draw` now and whenever something that is drawn has changed.
template <class Canvas, class Draw>
void DrawOnChange(Canvas* canvas, SessionModel* session, MeasureViewModel* measure, Draw draw) {
  for (auto signal : {&SessionModel::scanChanged, &SessionModel::imageChanged})
    QObject::connect(session, signal, canvas, draw);
  QObject::connect(session->Notes(), &NotesModel::changed, canvas, draw);
  QObject::connect(measure, &MeasureViewModel::changed, canvas, draw);
  draw();
}

/// What the two canvases that show pixels have in common.
template <class Canvas>
void BindPixels(Canvas* canvas, SessionModel* session, MeasureViewModel* measure) {
  DrawOnChange(canvas, session, measure, [canvas, session, measure] {
    canvas->SetPicking(measure->On());
    canvas->SetMeasurements(MeasurementsInImage(*session, *measure));
  });
  QObject::connect(session->Notes(), &NotesModel::centreWanted, canvas,
                   [canvas, session](const Eigen::Vector3d& place, MeasureFrame frame) {
                     if (frame != MeasureFrame::kRobot) return;
                     if (const auto pixel = PixelInImage(*session, place)) canvas->CentreOn(*pixel);
                   });
}

}  // namespace

void BindMeasurements(CloudCanvas* canvas, SessionModel* session, MeasureViewModel* measure) {
  auto* tags = new CornerTags(canvas);
  DrawOnChange(canvas, session, measure, [canvas, session, measure, tags] {
    canvas->SetMeasuring(measure->On(), measure->WantsPlane());
    canvas->SetMeasurements(MeasurementsInCloud(*session, *measure));
    tags->SetTopLeft(measure->Hint());
  });
  QObject::connect(canvas, &CloudCanvas::pointClicked, measure, &MeasureViewModel::ClickInCloud);
  QObject::connect(canvas, &CloudCanvas::planeDrawn, measure, &MeasureViewModel::DrawPlane);
  QObject::connect(session->Notes(), &NotesModel::centreWanted, canvas,
                   [canvas, measure](const Eigen::Vector3d& place, MeasureFrame frame) {
                     const bool map = measure->ShownMapOrNull() != nullptr;
                     if (map == (frame == MeasureFrame::kMap)) canvas->LookAt(place);
                   });
}

void BindMeasurements(DepthCanvas* canvas, SessionModel* session, MeasureViewModel* measure) {
  BindPixels(canvas, session, measure);
  QObject::connect(canvas, &DepthCanvas::pixelClicked, measure,
                   [measure](const Eigen::Vector2d& pixel, bool in_second) {
                     in_second ? measure->ClickInSecondMap() : measure->ClickInImage(pixel);
                   });
}

void BindMeasurements(ImageCanvas* canvas, SessionModel* session, MeasureViewModel* measure) {
  BindPixels(canvas, session, measure);
  QObject::connect(canvas, &ImageCanvas::pixelClicked, measure, &MeasureViewModel::ClickInImage);
}

}  // namespace foresight
