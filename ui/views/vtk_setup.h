#pragma once

namespace foresight {

/// Asks Qt for the OpenGL surface that VTK needs and registers VTK's parts. Call before the
/// QApplication is made; without it VTK's panes stay empty and nothing says why.
void SetUpVtk();

}  // namespace foresight
