#include "ui/viewmodels/live_depth_view_model.h"

namespace foresight {

LiveDepthViewModel::LiveDepthViewModel(HeadViewModel* head, SessionModel* session, QObject* parent)
    : LiveDepthViewModel(
          {[head] { return head->Scanning(); }, [head] { return head->Plan().ToPlan(); }}, session,
          parent) {
  connect(head, &HeadViewModel::scanStarted, this, &LiveDepthViewModel::clear);
  connect(head, &HeadViewModel::scanEnded, this, &LiveDepthViewModel::clear);
}

LiveDepthViewModel::LiveDepthViewModel(SweepSource sweep, SessionModel* session, QObject* parent)
    : QObject(parent), sweep_(std::move(sweep)), session_(session) {
  connect(session_, &SessionModel::scanChanged, this, &LiveDepthViewModel::RememberScan);
  connect(session_, &SessionModel::cloudChanged, this, &LiveDepthViewModel::Grow);
}

void LiveDepthViewModel::RememberScan() {
  const auto& scan = session_->CurrentScan();
  if (scan && !scan->frames.empty()) last_scan_ = scan;
}

std::shared_ptr<const CameraFrame> LiveDepthViewModel::ImageToUse() {
  if (!own_image_ && session_->CurrentImage() != nullptr)
    own_image_ = std::make_shared<const CameraFrame>(*session_->CurrentImage());
  if (own_image_) return own_image_;
  if (!last_scan_) return nullptr;
  // In a replay the last one may be this very scan, whose image has not been taken yet.
  if (session_->Mode() == SessionMode::kReplay) return nullptr;
  if (last_scan_->plan.image_angles_rad != sweep_.plan().image_angles_rad) return nullptr;
  return image_ ? image_ : std::make_shared<const CameraFrame>(last_scan_->frames.front());
}

void LiveDepthViewModel::Grow() {
  if (!sweep_.running() || !session_->Cloud() || runner_.Busy()) return;
  const auto image = ImageToUse();
  if (!image) return;
  if (!live_ || image != image_) Begin(image);
  if (!live_) return;
  const auto work = [cloud = session_->Cloud(), live = live_](const RunContext& context) {
    RunContext modest = context;
    modest.threads = 1;  // recording the sweep comes first
    return live->Update(*cloud, modest);
  };
  runner_.Run<DepthResult>(
      tr("Previewing the depth"), work,
      [this, live = live_, lines = session_->Cloud()->lines](Result<DepthResult> depth) {
        // Too few points yet, or the scan has ended meanwhile.
        if (!depth || live != live_) return;
        if (session_->Tasks() != nullptr) session_->Tasks()->Discard(std::move(depth_));
        depth_ = std::make_shared<const DepthResult>(std::move(*depth));
        lines_ = lines;
        Q_EMIT changed();
      });
}

void LiveDepthViewModel::Begin(std::shared_ptr<const CameraFrame> image) {
  const auto options = FixedForPlan(DefaultsOf(Method()), sweep_.plan(), session_->Rig());
  if (!options) return;  // a plan that cannot be executed has no preview
  image_ = std::move(image);
  live_ = std::make_shared<LiveDepth>(session_->Rig(), *image_, *options);
}

void LiveDepthViewModel::clear() {
  runner_.cancel();
  live_.reset();  // a task that still runs holds on to its own
  own_image_.reset();
  image_.reset();
  if (!depth_) return;
  depth_.reset();
  Q_EMIT changed();
}

}  // namespace foresight
