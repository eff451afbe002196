#pragma once

#include <functional>
#include <memory>

#include "core/depth/pipeline.h"
#include "core/sensor/scan.h"

namespace foresight {

using DepthTask = std::function<Result<DepthResult>(const RunContext&)>;

/// The work from a registered scan to the depth of one of its images, for a task runner. Owns
/// what it uses.
DepthTask MakeDepthTask(std::shared_ptr<const Scan> scan,
                        std::shared_ptr<const RegisteredScan> cloud, int image,
                        const DepthOptions& options);

}  // namespace foresight
