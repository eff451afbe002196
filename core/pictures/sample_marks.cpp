#include "core/pictures/sample_marks.h"

#include <algorithm>

#include "core/pictures/sample_picture.h"

namespace foresight {

bool SampleLayers::ShowsAny() const {
  return std::any_of(shown_.begin(), shown_.end(), [](bool shown) { return shown; });
}

std::vector<SampleMark> MarksOf(const AlignedSamples& samples, const SampleLayers& layers,
                                const ValueRange& depth_m, ColorMap map) {
  std::vector<SampleMark> marks;
  if (!layers.ShowsAny()) return marks;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const RejectReason kind = samples.reasons[i];
    if (!layers.Shows(kind)) continue;
    const AlignedSample& s = samples.samples[i];
    const Rgb8 color = kind == RejectReason::kKept
                           ? ColorOf(map, depth_m.Fraction(static_cast<double>(s.depth_m)))
                           : ColorOf(kind);
    marks.push_back({{static_cast<double>(s.u), static_cast<double>(s.v)}, kind, color});
  }
  return marks;
}

const PixelLines& StrokesOf(RejectReason kind) {
  static const PixelLines kDot;
  static const PixelLines kCross = {{{-0.8, -0.8}, {0.8, 0.8}}, {{-0.8, 0.8}, {0.8, -0.8}}};
  static const PixelLines kDiamond = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  static const PixelLines kTriangle = {{{0, -1}, {1, 0.8}, {-1, 0.8}, {0, -1}}};
  switch (kind) {
    case RejectReason::kFlying:
      return kCross;
    case RejectReason::kIsolated:
      return kDiamond;
    case RejectReason::kFlipping:
      return kTriangle;
    case RejectReason::kKept:
      break;
  }
  return kDot;
}

}  // namespace foresight
