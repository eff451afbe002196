#include "ui/viewmodels/live_depth_view_model.h"

namespace foresight {
namespace {

constexpr qint64 kInterval_ms = 1000;

}  // namespace

LiveDepthViewModel::LiveDepthViewModel(HeadViewModel* head, SessionModel* session, QObject* parent)
    : QObject(parent), head_(head), session_(session) {
  connect(session_, &SessionModel::scanChanged, this, &LiveDepthViewModel::RememberScan);
  connect(session_, &SessionModel::cloudChanged, this, &LiveDepthViewModel::Grow);
  connect(head_, &HeadViewModel::scanStarted, this, &LiveDepthViewModel::Clear);
  connect(head_, &HeadViewModel::scanEnded, this, &LiveDepthViewModel::Clear);
}

void LiveDepthViewModel::RememberScan() {
  const auto& scan = session_->CurrentScan();
  if (scan && !scan->frames.empty()) last_scan_ = scan;
}

void LiveDepthViewModel::Grow() {
  const bool due = !since_last_.isValid() || since_last_.elapsed() >= kInterval_ms;
  if (!head_->Scanning() || !session_->Cloud() || !last_scan_ || runner_.Busy() || !due) return;
  if (last_scan_->plan.image_angles_rad != head_->Plan().ToPlan().image_angles_rad) return;
  since_last_.start();
  const auto work = [cloud = session_->Cloud(), rig = session_->Rig(),
                     seen = last_scan_](const RunContext& context) -> Result<DepthResult> {
    RunContext modest = context;
    modest.threads = 1;  // recording the sweep comes first
    return ComputeDepthInFrame(*cloud, rig, seen->frames.front(), DefaultsOf(Method()), modest);
  };
  runner_.Run<DepthResult>(tr("Previewing the depth"), work,
                           [this, lines = session_->Cloud()->lines](Result<DepthResult> depth) {
                             // Too few points yet, or the scan has ended meanwhile.
                             if (!depth || !head_->Scanning()) return;
                             depth_ = std::make_shared<const DepthResult>(std::move(*depth));
                             lines_ = lines;
                             Q_EMIT changed();
                           });
}

void LiveDepthViewModel::Clear() {
  runner_.cancel();
  since_last_.invalidate();
  if (!depth_) return;
  depth_.reset();
  Q_EMIT changed();
}

}  // namespace foresight
