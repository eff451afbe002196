#pragma once

#include <string>

namespace foresight {

/// The GenICam description that an emulated camera keeps in its memory: which feature is where in
/// its registers, under the names of the Standard Features Naming Convention.
std::string CameraXml();

}  // namespace foresight
