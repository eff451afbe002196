#pragma once

#include <array>
#include <vector>

#include "core/depth/aligned_samples.h"
#include "core/pictures/color_map.h"
#include "core/pictures/projected_wireframe.h"

namespace foresight {

/// Kept samples and every reason of rejection: what can be drawn over a picture.
inline constexpr std::array<RejectReason, 4> kSampleKinds = {
    RejectReason::kKept, RejectReason::kFlying, RejectReason::kIsolated, RejectReason::kFlipping};

/// Which samples are drawn; none at first.
class SampleLayers {
 public:
  bool Shows(RejectReason kind) const { return shown_[static_cast<std::size_t>(kind)]; }
  void Show(RejectReason kind, bool shown) { shown_[static_cast<std::size_t>(kind)] = shown; }
  bool ShowsAny() const;
  bool operator==(const SampleLayers&) const = default;

 private:
  std::array<bool, kSampleKinds.size()> shown_ = {};
};

/// A sample as it is drawn: its shape says the same as its colour.
struct SampleMark {
  Eigen::Vector2d pixel;
  RejectReason kind;
  Rgb8 color;  ///< of the depth for a kept sample, else of the reason
};

/// The marks of the samples that `layers` shows, in the order of the samples.
std::vector<SampleMark> MarksOf(const AlignedSamples& samples, const SampleLayers& layers,
                                const ValueRange& depth_m, ColorMap map);

/// The symbol of a reason as lines within [-1, 1], y down: cross = flying, diamond = isolated,
/// triangle = flipping; none for a kept sample, which is a dot.
const PixelLines& StrokesOf(RejectReason kind);

}  // namespace foresight
