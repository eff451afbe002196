#include "ui/viewmodels/depth_task.h"

namespace foresight {

DepthTask MakeDepthTask(std::shared_ptr<const Scan> scan,
                        std::shared_ptr<const RegisteredScan> cloud, int image,
                        const DepthOptions& options) {
  return [scan = std::move(scan), cloud = std::move(cloud), image,
          options](const RunContext& context) -> Result<DepthResult> {
    return ComputeDepthInFrame(*cloud, scan->rig, scan->frames[static_cast<std::size_t>(image)],
                               options, context);
  };
}

}  // namespace foresight
