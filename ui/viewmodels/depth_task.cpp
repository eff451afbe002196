#include "ui/viewmodels/depth_task.h"

namespace foresight {

DepthTask MakeDepthTask(std::shared_ptr<const Scan> scan,
                        std::shared_ptr<const RegisteredScan> cloud, int picture,
                        const DepthOptions& options) {
  return [scan = std::move(scan), cloud = std::move(cloud), picture,
          options](const RunContext& context) -> Result<DepthResult> {
    const CameraFrame& frame = scan->frames[static_cast<std::size_t>(picture)];
    FORESIGHT_TRY(AlignedSamples samples,
                  AlignToImage(*cloud, scan->rig, frame.motor_angle_rad, context.Part(0.0, 0.1)));
    return ComputeDepth(std::move(samples), frame.image, options, context.Part(0.1, 1.0));
  };
}

}  // namespace foresight
