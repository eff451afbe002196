#pragma once

#include <QVTKOpenGLNativeWidget.h>

namespace foresight {

/// A VTK widget that draws at most once a turn of the event loop, however many things changed:
/// without a graphics card one drawing takes tens of milliseconds.
class VtkCanvas : public QVTKOpenGLNativeWidget {
  Q_OBJECT

 public:
  explicit VtkCanvas(QWidget* parent = nullptr);

 protected:
  /// Draws soon. QWidget::update() would only show the last frame again.
  void Redraw();
  /// Called before each drawing.
  virtual void Prepare() {}

 private:
  void Draw();

  bool pending_ = false;
};

}  // namespace foresight
