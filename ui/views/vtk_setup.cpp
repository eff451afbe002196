#include "ui/views/vtk_setup.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkAutoInit.h>
#include <QSurfaceFormat>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkRenderingContextOpenGL2)
VTK_MODULE_INIT(vtkInteractionStyle)

namespace foresight {

void SetUpVtk() {
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);  // multisampling halves the frame rate where there is no graphics card
  QSurfaceFormat::setDefaultFormat(format);
}

}  // namespace foresight
