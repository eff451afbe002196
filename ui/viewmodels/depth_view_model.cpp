#include "ui/viewmodels/depth_view_model.h"

#include "ui/viewmodels/depth_task.h"

namespace foresight {
namespace {

void KeepPasses(bool keep, DepthOptions& options) {
  options.upsample.keep_iterations = keep;
  options.local_plane.keep_iterations = keep;
}

bool HasPasses(const DepthOptions& options) {
  switch (options.method) {
    case DepthMethod::kForesight:
      return options.local_plane.iterations > 0;
    case DepthMethod::kPaper:
    case DepthMethod::kJointBilateral:
      return options.upsample.iterations > 0;
    case DepthMethod::kTgv:
    case DepthMethod::kNonlocal:
      break;
  }
  return false;
}

}  // namespace

DepthViewModel::DepthViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  connect(session_, &SessionModel::imageChanged, this, &DepthViewModel::compute);
}

void DepthViewModel::setThreshold(double threshold) {
  if (threshold == options_.mask.threshold) return;
  options_.mask.threshold = threshold;
  thresholds_[options_.method] = threshold;
  Q_EMIT thresholdChanged(threshold);
  UpdateMask();
}

void DepthViewModel::UpdateMask() {
  if (!session_->Depth()) return;
  auto mask = MaskLowConfidence(session_->Depth()->dense, options_.mask);
  if (!mask)
    session_->Report(NoticeOf(tr("Masking"), mask.error()));
  else if (*mask != *session_->Mask())
    session_->SetMask(std::make_shared<const MaskImage>(std::move(*mask)));
}

void DepthViewModel::setMethod(DepthMethod method) {
  if (method == options_.method) return;
  const bool keeps_passes = options_.upsample.keep_iterations;
  options_ = DefaultsOf(method);
  KeepPasses(keeps_passes, options_);
  if (const auto used = thresholds_.find(method); used != thresholds_.end())
    options_.mask.threshold = used->second;
  Q_EMIT methodChanged();
  Q_EMIT thresholdChanged(options_.mask.threshold);
  compute();
}

void DepthViewModel::setKeepIterations(bool keep) {
  if (keep == options_.upsample.keep_iterations) return;
  KeepPasses(keep, options_);
  if (!keep || !HasPasses(options_)) return;
  const auto& depth = session_->Depth();
  if (runner_.Busy() || (depth && depth->dense.iterations.empty())) compute();
}

void DepthViewModel::compute() {
  runner_.cancel();
  const auto scan = session_->CurrentScan();
  if (!scan) return;
  if (session_->Cloud()) {
    ComputeOn(scan, session_->ImageIndex());
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
        ComputeOn(scan, session_->ImageIndex());
      });
}

void DepthViewModel::ComputeOn(const std::shared_ptr<const Scan>& scan, int image) {
  if (image < 0) {
    session_->Report({Notice::Level::kWarning, tr("The scan holds no image, so there is no depth."),
                      tr("Scan again with an image angle within the scope.")});
    return;
  }
  runner_.Run<DepthResult>(tr("Computing depth"),
                           MakeDepthTask(scan, session_->Cloud(), image, options_),
                           [this, scan, image, used = options_](Result<DepthResult> depth) {
                             if (scan != session_->CurrentScan() || image != session_->ImageIndex())
                               return;
                             Accept(used, std::move(depth));
                           });
}

void DepthViewModel::Accept(const DepthOptions& used, Result<DepthResult> depth) {
  if (!depth) {
    session_->Report(NoticeOf(tr("Computing depth"), depth.error()));
    ReturnToShown();
    return;
  }
  ++computed_;
  shown_ = used;
  session_->SetDepth(std::make_shared<const DepthResult>(std::move(*depth)));
  UpdateMask();  // the threshold may have moved while the depth was being computed
}

void DepthViewModel::ReturnToShown() {
  if (!session_->Depth() || options_.method == shown_.method) return;
  // The old depth stays on the screen: what is chosen must name it.
  options_ = shown_;
  if (const auto last = thresholds_.find(options_.method); last != thresholds_.end())
    options_.mask.threshold = last->second;
  Q_EMIT methodChanged();
  Q_EMIT thresholdChanged(options_.mask.threshold);
  UpdateMask();
}

}  // namespace foresight
