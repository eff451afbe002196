#pragma once

#include <vtkActor.h>
#include <vtkImageActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "core/base/image.h"
#include "core/fitting/roi.h"
#include "ui/render/vtk_data.h"
#include "ui/viewmodels/region_gesture.h"
#include "ui/views/label_actors.h"
#include "ui/views/mark_actors.h"
#include "ui/views/measurement_lines.h"
#include "ui/views/outline_actors.h"
#include "ui/views/vtk_canvas.h"
#include "ui/views/wipe_actors.h"

namespace foresight {

/// A painted depth map in VTK with regions and templates over it. The world is the image:
/// x = u, y = height - 1 - v. Wheel zooms, dragging pans or, in drawing mode, draws a region. With
/// a second image a line parts the two: it is dragged, or moved by the arrow keys.
class DepthCanvas : public VtkCanvas {
  Q_OBJECT

 public:
  explicit DepthCanvas(QWidget* parent = nullptr);

  void SetImage(const ColorImage& image);
  /// Right of the line; of the size of the image, or nullptr.
  void SetSecond(const ColorImage* image);
  void SetWipe(double fraction);
  void SetMarks(std::vector<SampleMark> marks);
  /// The marks right of the line; nullopt = the first ones go on there.
  void SetSecondMarks(std::optional<std::vector<SampleMark>> marks);
  void SetRegion(const PixelLines& lines);
  void SetOutlines(const std::vector<PixelOutline>& outlines);
  void SetDrawing(bool drawing, RegionShape shape);
  /// A click on a pixel is told; dragging pans as ever.
  void SetPicking(bool picking);
  void SetMeasurements(const std::vector<PixelMeasurement>& measurements);
  void CentreOn(const Eigen::Vector2d& pixel);
  void ShowAll();
  /// Where a pixel of the image is on this widget.
  QPoint WidgetFromPixel(const Eigen::Vector2d& pixel) const;

 Q_SIGNALS:
  void regionDrawn(const std::vector<Eigen::Vector2d>& points);
  /// `in_second` = right of the line, on the second image.
  void pixelClicked(const Eigen::Vector2d& pixel, bool in_second);
  void pixelPointedAt(const Eigen::Vector2d& pixel);
  /// The operator moves the line there.
  void wiped(double fraction);

 protected:
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  bool OnPress(const QMouseEvent& event);
  bool OnMove(const QMouseEvent& event);
  bool OnKey(const QKeyEvent& event);
  bool OnWipeLine(const QPointF& position) const;
  void WipeTo(const QPointF& position);
  void ShowCursor(const QPointF& position);
  bool OnRelease(const QMouseEvent& event);
  void OnWheel(const QWheelEvent& event);
  Eigen::Vector2d PixelAt(const QPointF& position) const;
  /// World units (pixels of the image) in a pixel of the widget.
  double Scale() const;
  /// Lines of the image in the canvas' world.
  Polylines InWorld(const PixelLines& lines) const;
  void PlaceCamera();
  void Finish(const std::optional<RegionGesture::Points>& points);
  void DrawGesture();
  void PartMarks();

  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkImageActor> image_;
  WipeActors wipe_;
  MarkActors marks_;
  MarkActors second_marks_;
  bool second_has_marks_ = false;
  OutlineActors outlines_;
  OutlineActors measurements_;
  LabelActors labels_;
  vtkSmartPointer<vtkActor> region_;
  vtkSmartPointer<vtkActor> gesture_actor_;
  RegionGesture gesture_;
  QPointF pan_from_;
  QPointF pressed_at_;
  bool picking_ = false;
  bool panning_ = false;
  bool wiping_ = false;
  bool drawing_ = false;
  bool shows_all_ = true;
  int image_width_ = 1;
  int image_height_ = 1;
  Eigen::Vector2d center_ = Eigen::Vector2d::Zero();  ///< world point in the widget's middle
  double half_height_ = 1.0;                          ///< world units from there to the top
};

}  // namespace foresight
