#include "ui/viewmodels/depth_view_model.h"

namespace foresight {

DepthViewModel::DepthViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  connect(session_, &SessionModel::pictureChanged, this, &DepthViewModel::compute);
}

void DepthViewModel::setThreshold(double threshold) {
  if (threshold == options_.mask.threshold) return;
  options_.mask.threshold = threshold;
  Q_EMIT thresholdChanged(threshold);
  if (!session_->Depth()) return;
  auto mask = MaskLowConfidence(session_->Depth()->dense, options_.mask);
  if (!mask)
    session_->Report(NoticeOf(tr("Masking"), mask.error()));
  else
    session_->SetMask(std::make_shared<const MaskImage>(std::move(*mask)));
}

void DepthViewModel::compute() {
  runner_.cancel();
  const auto scan = session_->CurrentScan();
  if (!scan) return;
  if (session_->Cloud()) {
    ComputeOn(scan, session_->PictureIndex());
    return;
  }
  runner_.Run<RegisteredScan>(
      tr("Placing points"),
      [scan](const RunContext& context) { return RegisterScan(*scan, context); },
      [this, scan](Result<RegisteredScan> cloud) {
        if (scan != session_->CurrentScan()) return;
        if (!cloud) {
          session_->Report(NoticeOf(tr("Placing points"), cloud.error()));
          return;
        }
        session_->SetCloud(std::make_shared<const RegisteredScan>(std::move(*cloud)), scan->rig);
        ComputeOn(scan, session_->PictureIndex());
      });
}

void DepthViewModel::ComputeOn(const std::shared_ptr<const Scan>& scan, int picture) {
  if (picture < 0) {
    session_->Report({Notice::Level::kWarning,
                      tr("The scan holds no picture, so there is no depth."),
                      tr("Scan again with a picture angle within the scope.")});
    return;
  }
  const auto work = [scan, picture, cloud = session_->Cloud(),
                     options = options_](const RunContext& context) -> Result<DepthResult> {
    const CameraFrame& frame = scan->frames[static_cast<std::size_t>(picture)];
    FORESIGHT_TRY(AlignedSamples samples,
                  AlignToImage(*cloud, scan->rig, frame.motor_angle_rad, context.Part(0.0, 0.1)));
    return ComputeDepth(std::move(samples), frame.image, options, context.Part(0.1, 1.0));
  };
  runner_.Run<DepthResult>(
      tr("Computing depth"), work, [this, scan, picture](Result<DepthResult> depth) {
        if (scan != session_->CurrentScan() || picture != session_->PictureIndex()) return;
        Accept(std::move(depth));
      });
}

void DepthViewModel::Accept(Result<DepthResult> depth) {
  if (!depth) {
    session_->Report(NoticeOf(tr("Computing depth"), depth.error()));
    return;
  }
  ++computed_;
  session_->SetDepth(std::make_shared<const DepthResult>(std::move(*depth)));
  // The threshold may have moved while the depth was being computed.
  auto mask = MaskLowConfidence(session_->Depth()->dense, options_.mask);
  if (mask && *mask != session_->Depth()->mask)
    session_->SetMask(std::make_shared<const MaskImage>(std::move(*mask)));
}

}  // namespace foresight
