#pragma once

#include <QObject>
#include <functional>
#include <memory>

#include "app/workstation/workbench.h"

namespace foresight {

/// Records a hundred scans of 480 lines in one sitting and expects the program to stay under
/// 800 MB, to let go of scans before the last one, and to list its mission in 0.2 s.
/// @param show makes what shows the workbench; it lives as long as the sitting
void RecordHundredScans(const std::function<std::unique_ptr<QObject>(Workbench*)>& show);

}  // namespace foresight
