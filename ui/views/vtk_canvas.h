#pragma once

#include <QVTKOpenGLNativeWidget.h>

namespace foresight {

/// A VTK widget that draws at most once a turn of the event loop, however many things changed:
/// without a graphics card one drawing takes tens of milliseconds.
class VtkCanvas : public QVTKOpenGLNativeWidget {
  Q_OBJECT

 public:
  explicit VtkCanvas(QWidget* parent = nullptr);

  /// While something hides all of it nothing is drawn but once, which warms OpenGL up; what was to
  /// be drawn is drawn when it is seen again.
  void SetCovered(bool covered);

 protected:
  /// Draws soon. QWidget::update() would only show the last frame again.
  void Redraw();
  /// Called before each drawing.
  virtual void Prepare() {}

 private:
  void Draw();

  bool pending_ = false;
  bool covered_ = false;
  bool drawn_ = false;
  bool outdated_ = false;
};

}  // namespace foresight
