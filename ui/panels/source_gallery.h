#pragma once

#include <vector>

#include "ui/viewmodels/source_gallery_model.h"

class QWidget;

namespace foresight {

/// A window that sets the answers side by side, three in a row: a picture with the outline, the
/// verdict with its icon, the answer in words. It does not hold up the main window.
QWidget* ShowSourceGallery(const std::vector<SourceAnswer>& answers, QWidget* parent);

}  // namespace foresight
