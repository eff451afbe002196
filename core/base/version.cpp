#include "core/base/version.h"

namespace foresight {

const char* ProgramVersion() {
  return FORESIGHT_VERSION;
}

}  // namespace foresight
