#include "hardware/head/sweep_images.h"

#include <cmath>

#include "core/base/log.h"
#include "core/geometry/angles.h"

namespace foresight {

SweepImages::SweepImages(Camera& camera, const SensorClock& clock, std::vector<double> angles_rad)
    : camera_(camera), clock_(clock) {
  for (const double angle : angles_rad) wanted_.push_back({angle, false});
}

bool SweepImages::Trigger(std::size_t image) {
  last_news_s_ = clock_.Now();
  const Result<std::int64_t> seq = camera_.Trigger();
  if (!seq) {
    trouble_ = seq.error().message;
    return false;
  }
  triggered_[*seq] = image;
  pending_.insert(*seq);
  return true;
}

void SweepImages::Receive(std::chrono::milliseconds timeout) {
  Result<std::optional<CameraFrame>> frame = camera_.WaitForFrame(timeout);
  if (!frame) {
    ++given_up_;
    trouble_ = frame.error().message;
    last_news_s_ = clock_.Now();
    return;
  }
  if (!*frame) return;
  last_news_s_ = clock_.Now();
  const auto trigger = triggered_.find((*frame)->seq);
  if (trigger == triggered_.end()) {
    LogWarning("{}: image {} belongs to no trigger of this scan", camera_.Describe(),
               (*frame)->seq);
    return;
  }
  Wanted& wanted = wanted_[trigger->second];
  pending_.erase((*frame)->seq);
  triggered_.erase(trigger);
  if (wanted.came) return;  // the second one of an angle whose first one was only late
  wanted.came = true;
  (*frame)->target_angle_rad = wanted.angle_rad;
  frames_.push_back(std::move(**frame));
}

void SweepImages::StopWaiting() {
  if (Waiting() && trouble_.empty()) trouble_ = fmt::format("{}: is silent", camera_.Describe());
  pending_.clear();
  given_up_ = 0;
}

int SweepImages::HandOn(const MotorTrack& track, ScanSink& sink, bool all) {
  int handed_on = 0;
  while (!frames_.empty()) {
    CameraFrame& frame = frames_.front();
    const bool covered =
        !track.empty() && track.samples().back().time_s >= frame.time_s + MotorTrack::kWindow_s;
    if (!covered && !all) break;
    frame.motor_angle_rad = track.AngleAt(frame.time_s);
    if (std::isfinite(frame.motor_angle_rad)) {
      sink.OnFrame(frame);
      ++handed_on;
    } else {
      LogWarning("{}: dropped an image taken while the motor's angle was not known",
                 camera_.Describe());
    }
    frames_.erase(frames_.begin());
  }
  return handed_on;
}

std::vector<std::size_t> SweepImages::Missing() const {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    if (!wanted_[i].came) missing.push_back(i);
  return missing;
}

std::string SweepImages::DescribeMissing() const {
  const std::vector<std::size_t> missing = Missing();
  if (missing.empty()) return "";
  std::string angles;
  for (const std::size_t image : missing)
    angles += fmt::format("{}{:.2f}", angles.empty() ? "" : ", ",
                          DegreesFromRadians(wanted_[image].angle_rad));
  return fmt::format("the {} at {} deg did not come{}{}", missing.size() == 1 ? "image" : "images",
                     angles, trouble_.empty() ? "" : ": ", trouble_);
}

}  // namespace foresight
