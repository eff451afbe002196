#include "core/mission/scan_workbench.h"

#include "core/base/contract.h"
#include "core/depth/depth_option_table.h"
#include "core/registration/register_scan.h"
#include "core/sensor/rig_id.h"

namespace foresight {

Status ScanWorkbench::Take(std::shared_ptr<const Scan> scan, const RunContext& context) {
  FORESIGHT_EXPECTS(scan != nullptr, "a scan");
  scan_.reset();
  depth_image_ = -1;
  FORESIGHT_TRY(cloud_, RegisterScan(*scan, context));
  scan_ = std::move(scan);
  return {};
}

Status ScanWorkbench::CheckRig(const Provenance& provenance) const {
  FORESIGHT_EXPECTS(scan_ != nullptr, "a scan was taken");
  const std::string rig_id = RigId(scan_->rig);
  if (rig_id == provenance.rig_id) return {};
  return Fail(ErrorCode::kInvalidInput, "made with the rig {}, but the scan has the rig {}",
              provenance.rig_id, rig_id);
}

Result<const DepthResult*> ScanWorkbench::Depth(const Provenance& provenance,
                                                const RunContext& context) {
  FORESIGHT_CHECK(CheckRig(provenance));
  if (!provenance.depth) return Fail(ErrorCode::kBadData, "its provenance names no depth map");
  const auto& frames = scan_->frames;
  if (provenance.image_position < 0 ||
      provenance.image_position >= static_cast<std::int64_t>(frames.size()))
    return Fail(ErrorCode::kInvalidInput, "made on image {}, but the scan has {} images",
                provenance.image_position, frames.size());
  const std::string options = DepthOptionsToJson(*provenance.depth);
  if (depth_image_ == provenance.image_position && depth_options_ == options) return &depth_;
  const CameraFrame& frame = frames[static_cast<std::size_t>(provenance.image_position)];
  depth_image_ = -1;
  FORESIGHT_TRY(depth_, ComputeDepthInFrame(cloud_, scan_->rig, frame, *provenance.depth, context));
  depth_image_ = provenance.image_position;
  depth_options_ = options;
  return &depth_;
}

Result<Detection> ScanWorkbench::Fit(const Provenance& provenance, const RunContext& context) {
  if (!provenance.fit || !provenance.roi)
    return Fail(ErrorCode::kBadData, "its provenance names no fit");
  FORESIGHT_CHECK(CheckRig(provenance));
  FORESIGHT_TRY(const NamedSource source, FitSourceFromName(provenance.source));
  const DepthResult* depth = nullptr;
  if (provenance.depth) {
    FORESIGHT_TRY(depth, Depth(provenance, context.Part(0.0, 0.5)));
  }
  if (!provenance.part)
    return FitInScan({scan_->rig, cloud_, scan_->frames, depth}, source.source, *provenance.roi,
                     *provenance.fit, context.Part(0.5, 1.0));
  FORESIGHT_TRY(const Scan part, TakePart(*scan_, *provenance.part));
  FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(part, context.Part(0.5, 0.55)));
  return FitInScan({scan_->rig, cloud, part.frames, depth}, source.source, *provenance.roi,
                   *provenance.fit, context.Part(0.55, 1.0));
}

}  // namespace foresight
