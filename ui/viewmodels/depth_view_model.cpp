#include "ui/viewmodels/depth_view_model.h"

#include "core/depth/depth_option_table.h"
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

/// Everything that a map depends on; the mask is made afterwards.
std::string MapOptions(DepthOptions options) {
  options.mask = {};
  return DepthOptionsToJson(options);
}

}  // namespace

DepthViewModel::DepthViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  connect(session_, &SessionModel::imageChanged, this,
          [this] { automatic_ ? compute() : cancel(); });
  const auto tell = [this] { session_->SetDepthComing(runner_.Busy() && !session_->Depth()); };
  connect(&runner_, &TaskRunner::changed, this, tell);
  connect(session_, &SessionModel::depthChanged, this, tell);
}

void DepthViewModel::setThreshold(double threshold) {
  if (threshold == options_.mask.threshold) return;
  options_.mask.threshold = threshold;
  Q_EMIT thresholdChanged(threshold);
  UpdateMask();
}

void DepthViewModel::UpdateMask() {
  if (!session_->Depth()) return;
  auto mask = MaskLowConfidence(session_->Depth()->dense, options_.mask);
  if (!mask)
    session_->Report(NoticeOf(tr("Masking"), mask.error()));
  else if (*mask != *session_->Mask() || options_.mask != session_->MaskOptions())
    session_->SetMask(std::make_shared<const MaskImage>(std::move(*mask)), options_.mask);
}

void DepthViewModel::setMethod(DepthMethod method) {
  if (method == options_.method) return;
  used_[options_.method] = options_;
  const auto used = used_.find(method);
  Use(used == used_.end() ? DefaultsOf(method) : used->second);
  compute();
}

void DepthViewModel::Use(const DepthOptions& options) {
  const bool keeps_passes = options_.upsample.keep_iterations;
  const bool other_method = options.method != options_.method;
  options_ = options;
  KeepPasses(keeps_passes, options_);
  if (other_method) Q_EMIT methodChanged();
  Q_EMIT optionsChanged();
  Q_EMIT thresholdChanged(options_.mask.threshold);
}

Status DepthViewModel::SetOption(const std::string& key, const OptionValue& value) {
  const Option<DepthOptions>* option = FindOption(DepthOptionTable(), key);
  FORESIGHT_EXPECTS(option != nullptr, "the table of options has the key");
  DepthOptions wanted = options_;
  FORESIGHT_CHECK(foresight::SetOption(*option, wanted, value));
  FORESIGHT_CHECK(wanted.Check());
  const bool same_map = MapOptions(wanted) == MapOptions(options_);
  Use(wanted);
  same_map ? UpdateMask() : compute();
  return {};
}

void DepthViewModel::resetOptions() {
  const DepthOptions usual = DefaultsOf(options_.method);
  const bool same_map = MapOptions(usual) == MapOptions(options_);
  Use(usual);
  same_map ? UpdateMask() : compute();
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
    ComputeOn(scan, session_->Cloud(), session_->ImageIndex());
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
        const auto placed = std::make_shared<const RegisteredScan>(std::move(*cloud));
        // First, for this thread draws the cloud next.
        ComputeOn(scan, placed, session_->ImageIndex());
        session_->SetCloud(placed, scan->rig);
      });
}

void DepthViewModel::ComputeOn(const std::shared_ptr<const Scan>& scan,
                               const std::shared_ptr<const RegisteredScan>& cloud, int image) {
  if (image < 0) {
    // Why an interrupted scan has none has been said, with what to do.
    if (scan->state == ScanState::kComplete)
      session_->Report({Notice::Level::kWarning,
                        tr("The scan holds no image, so there is no depth."),
                        tr("Scan again with an image angle within the scope."), kScanTopic});
    return;
  }
  runner_.Run<DepthResult>(tr("Computing depth"), MakeDepthTask(scan, cloud, image, options_),
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
  Q_EMIT computed();
}

void DepthViewModel::ShowAgain(std::shared_ptr<const DepthResult> depth) {
  runner_.cancel();
  session_->SetDepth(std::move(depth));
  UpdateMask();
}

void DepthViewModel::ReturnToShown() {
  if (!session_->Depth() || MapOptions(options_) == MapOptions(shown_)) return;
  // The old depth stays on the screen: what is chosen must name it.
  DepthOptions last = shown_;
  const auto used = used_.find(shown_.method);
  if (shown_.method == options_.method)
    last.mask = options_.mask;
  else if (used != used_.end())
    last.mask = used->second.mask;
  Use(last);
  UpdateMask();
}

}  // namespace foresight
