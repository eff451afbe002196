#include "ui/views/vtk_canvas.h"

#include <vtkGenericOpenGLRenderWindow.h>

namespace foresight {

VtkCanvas::VtkCanvas(QWidget* parent) : QVTKOpenGLNativeWidget(parent) {
  setRenderWindow(vtkNew<vtkGenericOpenGLRenderWindow>());
}

void VtkCanvas::Redraw() {
  if (pending_) return;
  pending_ = true;
  QMetaObject::invokeMethod(this, &VtkCanvas::Draw, Qt::QueuedConnection);
}

void VtkCanvas::Draw() {
  pending_ = false;
  if (!isVisible()) return;
  Prepare();
  renderWindow()->Render();
}

}  // namespace foresight
