#include "hardware/head/live_view.h"

#include <algorithm>

#include "core/base/shrink_image.h"

namespace foresight {
namespace {

/// An image that takes longer will not come. A simulated one takes a second.
constexpr double kImageTimeout_s = 10.0;

/// Empty where the part lies outside of the image.
ColorImage Cut(const ColorImage& image, const PixelRegion& part) {
  const int width = std::min(part.width, image.width() - part.left);
  const int height = std::min(part.height, image.height() - part.top);
  if (width < 1 || height < 1) return {};
  ColorImage cut(width, height);
  for (int y = 0; y < height; ++y)
    std::copy_n(image.row(part.top + y) + part.left, width, cut.row(y));
  return cut;
}

}  // namespace

LiveView::LiveView(const LiveViewOptions& options, std::shared_ptr<LiveViewSink> sink)
    : options_(options), sink_(std::move(sink)) {}

void LiveView::Forget() {
  configured_ = false;
  waits_for_.reset();
}

void LiveView::Look(Camera& camera, const SensorClock& clock, double motor_angle_rad) {
  const double now_s = clock.Now();
  if (!waits_for_ && now_s >= next_s_) Trigger(camera, now_s);
  if (!waits_for_) return;
  const Result<std::optional<CameraFrame>> frame =
      camera.WaitForFrame(std::chrono::milliseconds(0));
  if (!frame) {
    Trouble(frame.error().message);
  } else if (*frame && (*frame)->seq == *waits_for_) {
    waits_for_.reset();
    HandOn(**frame, motor_angle_rad);
  } else if (now_s - triggered_s_ > kImageTimeout_s) {
    waits_for_.reset();
    Trouble(camera.Describe() + ": no image came");
  }
}

void LiveView::Trigger(Camera& camera, double now_s) {
  next_s_ = now_s + 1.0 / options_.rate_hz;
  if (!configured_) {
    const Status configured = camera.Configure({options_.exposure_s, options_.gain_db});
    if (!configured) return Trouble(configured.error().message);
    configured_ = true;
  }
  const Result<std::int64_t> seq = camera.Trigger();
  if (!seq) return Trouble(seq.error().message);
  waits_for_ = *seq;
  triggered_s_ = now_s;
}

void LiveView::HandOn(const CameraFrame& frame, double motor_angle_rad) {
  LiveImage live;
  live.full_width = frame.image.width();
  live.full_height = frame.image.height();
  live.time_s = frame.time_s;
  live.motor_angle_rad = motor_angle_rad;
  const ColorImage shown = options_.part ? Cut(frame.image, *options_.part) : frame.image;
  if (shown.empty())
    return Trouble(
        fmt::format("the asked part begins at ({}, {}), and the image has {} x {} pixels",
                    options_.part->left, options_.part->top, live.full_width, live.full_height));
  live.image = ShrinkImage(shown, options_.largest_side_px);
  told_.clear();
  sink_->OnLiveImage(live);
}

/// What goes wrong with every image is told once.
void LiveView::Trouble(const std::string& what) {
  if (what == told_) return;
  told_ = what;
  sink_->OnLiveViewTrouble(what);
}

}  // namespace foresight
