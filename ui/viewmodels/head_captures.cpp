#include "ui/viewmodels/head_captures.h"

#include <mutex>

namespace foresight {

/// Hands over what the head's thread brings.
class HeadCaptures::Relay : public StopSink,
                            public ScanSink,
                            public std::enable_shared_from_this<HeadCaptures::Relay> {
 public:
  explicit Relay(HeadCaptures* target) : target_(target) {}

  void Disconnect() {
    const std::lock_guard lock(mutex_);
    target_ = nullptr;
  }

  void OnStop(const StopCapture& capture) override {
    Post([copy = std::make_shared<const StopCapture>(capture)](HeadCaptures* target) {
      Q_EMIT target->captured(copy);
    });
  }
  void OnStopsEnded(ScanState state, const std::string& reason) override {
    Post([complete = state == ScanState::kComplete,
          text = QString::fromStdString(reason)](HeadCaptures* target) {
      target->relay_.reset();
      Q_EMIT target->stopsEnded(complete, text);
      Q_EMIT target->changed();
    });
  }

  void OnScanStarted(const Scan& header) override { sweep_.OnScanStarted(header); }
  void OnLine(const LidarLine& line) override { sweep_.OnLine(line); }
  void OnMotorSamples(std::span<const MotorSample> samples) override {
    sweep_.OnMotorSamples(samples);
  }
  void OnFrame(const CameraFrame& frame) override { sweep_.OnFrame(frame); }
  void OnScanEnded(ScanState state, const std::string& reason) override {
    sweep_.OnScanEnded(state, reason);
    Post([scan = sweep_.Snapshot()](HeadCaptures* target) {
      target->relay_.reset();
      Q_EMIT target->sweepEnded(scan);
      Q_EMIT target->changed();
    });
  }

 private:
  template <class Delivery>
  void Post(Delivery delivery) {
    const std::lock_guard lock(mutex_);
    if (target_ == nullptr) return;
    HeadCaptures* target = target_;
    QMetaObject::invokeMethod(
        target,
        [self = shared_from_this(), target, delivery = std::move(delivery)] {
          if (target->relay_ == self) delivery(target);  // it was not dropped meanwhile
        },
        Qt::QueuedConnection);
  }

  std::mutex mutex_;
  HeadCaptures* target_;
  ScanAssembler sweep_;
};

HeadCaptures::HeadCaptures(HeadViewModel* head, QObject* parent) : QObject(parent), head_(head) {
  connect(head_, &HeadViewModel::statusChanged, this, &HeadCaptures::changed);
}

HeadCaptures::~HeadCaptures() {
  Drop();
}

void HeadCaptures::Drop() {
  if (!relay_) return;
  relay_->Disconnect();
  relay_.reset();
  head_->abort();
}

QString HeadCaptures::WhyNot() const {
  return Running() ? tr("The head is capturing.") : head_->WhyNoCapture();
}

bool HeadCaptures::HeadMoves() const {
  const HeadState state = head_->LastStatus().state;
  return state == HeadState::kSweeping || state == HeadState::kStopping ||
         state == HeadState::kHoming;
}

Status HeadCaptures::StartStops(const StopPlan& plan) {
  if (Running()) return Fail(ErrorCode::kState, "the head is capturing");
  auto relay = std::make_shared<Relay>(this);
  FORESIGHT_CHECK(head_->StartStops(plan, relay));
  relay_ = std::move(relay);
  Q_EMIT changed();
  return {};
}

Status HeadCaptures::StartImage() {
  StopPlan plan;
  plan.angles_rad = {head_->LastStatus().angle_rad};
  plan.lines = 0;
  plan.exposure_s = 1e-3 * head_->Plan().exposure_ms;
  return StartStops(plan);
}

Status HeadCaptures::StartSweep(const ScanPlan& plan) {
  if (Running()) return Fail(ErrorCode::kState, "the head is capturing");
  auto relay = std::make_shared<Relay>(this);
  FORESIGHT_CHECK(head_->StartUnrecordedScan(plan, relay));
  relay_ = std::move(relay);
  Q_EMIT changed();
  return {};
}

void HeadCaptures::end() {
  if (Running()) head_->abort();
}

}  // namespace foresight
