#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/run_context.h"
#include "core/depth/pipeline.h"
#include "core/mission/provenance.h"
#include "core/sensor/scan.h"

namespace foresight {

/// One scan and what was made of it: makes what a provenance describes, for whoever makes a record
/// again and for a head that fits for a station. Cloud and last depth map are kept, so fits that
/// follow each other cost the scan's registration once. Not for several threads.
class ScanWorkbench {
 public:
  /// In place of the scan before; registers it. Fails as RegisterScan does: then nothing is taken.
  Status Take(std::shared_ptr<const Scan> scan, const RunContext& context);
  /// nullptr = none was taken.
  const std::shared_ptr<const Scan>& scan() const { return scan_; }

  /// The detection that the provenance describes, by the functions that every program calls. Fails
  /// with kInvalidInput where the provenance's rig, image or lines are not the scan's, kBadData
  /// where it names no fit, and as FitInScan does. @pre scan()
  Result<Detection> Fit(const Provenance& provenance, const RunContext& context);
  /// The depth map likewise; it lives until the next call of Take, Fit or Depth.
  Result<const DepthResult*> Depth(const Provenance& provenance, const RunContext& context);

 private:
  Status CheckRig(const Provenance& provenance) const;

  std::shared_ptr<const Scan> scan_;
  RegisteredScan cloud_;
  std::int64_t depth_image_ = -1;  ///< position that depth_ is of; -1 = there is none
  std::string depth_options_;
  DepthResult depth_;
};

}  // namespace foresight
