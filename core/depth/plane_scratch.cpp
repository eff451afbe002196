#include "core/depth/plane_scratch.h"

namespace foresight {

PlaneFilterScratch& PlaneScratchOfThisThread() {
  thread_local PlaneFilterScratch scratch;
  return scratch;
}

}  // namespace foresight
