#include "ui/views/vtk_canvas.h"

#include <vtkGenericOpenGLRenderWindow.h>

namespace foresight {

VtkCanvas::VtkCanvas(QWidget* parent) : QVTKOpenGLNativeWidget(parent) {
  setRenderWindow(vtkNew<vtkGenericOpenGLRenderWindow>());
}

void VtkCanvas::SetCovered(bool covered) {
  covered_ = covered;
  if (!covered_ && outdated_) Redraw();
}

void VtkCanvas::Redraw() {
  if (pending_) return;
  pending_ = true;
  QMetaObject::invokeMethod(this, &VtkCanvas::Draw, Qt::QueuedConnection);
}

void VtkCanvas::Draw() {
  pending_ = false;
  if (!isVisible()) return;
  outdated_ = covered_ && drawn_;
  if (outdated_) return;
  Prepare();
  renderWindow()->Render();
  drawn_ = true;
}

}  // namespace foresight
