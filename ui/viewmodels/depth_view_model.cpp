#include "ui/viewmodels/depth_view_model.h"

namespace foresight {

struct DepthViewModel::Outcome {
  std::shared_ptr<const Scan> scan;
  int picture = 0;
  std::shared_ptr<const RegisteredScan> cloud;
  std::shared_ptr<const DepthResult> depth;
};

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
  if (!session_->CurrentScan()) return;
  const auto work = [scan = session_->CurrentScan(), picture = session_->PictureIndex(),
                     cloud = session_->Cloud(),
                     options = options_](const RunContext& context) -> Result<Outcome> {
    Outcome outcome{scan, picture, cloud, nullptr};
    if (!cloud) {
      FORESIGHT_TRY(RegisteredScan registered, RegisterScan(*scan, context.Part(0.0, 0.1)));
      outcome.cloud = std::make_shared<const RegisteredScan>(std::move(registered));
    }
    if (picture < 0) return outcome;
    const CameraFrame& frame = scan->frames[static_cast<std::size_t>(picture)];
    FORESIGHT_TRY(
        AlignedSamples samples,
        AlignToImage(*outcome.cloud, scan->rig, frame.motor_angle_rad, context.Part(0.1, 0.2)));
    FORESIGHT_TRY(DepthResult depth,
                  ComputeDepth(std::move(samples), frame.image, options, context.Part(0.2, 1.0)));
    outcome.depth = std::make_shared<const DepthResult>(std::move(depth));
    return outcome;
  };
  runner_.Run<Outcome>(tr("Computing depth"), work,
                       [this](Result<Outcome> outcome) { Accept(std::move(outcome)); });
}

void DepthViewModel::Accept(Result<Outcome> outcome) {
  if (!outcome) {
    session_->Report(NoticeOf(tr("Computing depth"), outcome.error()));
    return;
  }
  if (outcome->scan != session_->CurrentScan() || outcome->picture != session_->PictureIndex())
    return;
  if (outcome->cloud != session_->Cloud()) session_->SetCloud(outcome->cloud, outcome->scan->rig);
  if (!outcome->depth) {
    session_->Report({Notice::Level::kWarning,
                      tr("The scan holds no picture, so there is no depth."),
                      tr("Scan again with a picture angle within the scope.")});
    return;
  }
  ++computed_;
  session_->SetDepth(outcome->depth);
  // The threshold may have moved while the depth was being computed.
  auto mask = MaskLowConfidence(outcome->depth->dense, options_.mask);
  if (mask && *mask != outcome->depth->mask)
    session_->SetMask(std::make_shared<const MaskImage>(std::move(*mask)));
}

}  // namespace foresight
