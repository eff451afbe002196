#include "core/depth/supporters.h"

#include <algorithm>

// Compiled once per instruction set, as row_filter.cpp is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/depth/supporters.cpp"
#include "core/base/highway_targets.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One sample, dy rows below the pixels.
HWY_INLINE void AddSupporter(const SupportModel& model, int dy, std::size_t sample,
                             RowSupport& row) {
  const hn::ScalableTag<float> f;
  const hn::RebindToSigned<decltype(f)> i;
  const SamplePlane& place = model.places[sample];
  const auto x = hn::Set(f, place.x);
  const auto y = hn::Set(f, place.y);
  const auto depth_m = hn::Set(f, model.samples.depths_m()[sample]);
  const auto one = hn::Set(f, 1.0f);
  const auto agreement = hn::Set(f, static_cast<float>(model.agreement_m));
  const int from = model.samples.columns()[sample] - model.tables.half_width();
  const float* HWY_RESTRICT cells = model.tables.Cells(dy);
  const std::int32_t* HWY_RESTRICT sides = model.tables.Sides(dy);
  const float* HWY_RESTRICT at_origin = row.AtOrigin() + from;
  const float* HWY_RESTRICT slope_x = row.SlopeX() + from;
  const float* HWY_RESTRICT slope_y = row.SlopeY() + from;
  float* HWY_RESTRICT nearest = row.Nearest() + from;
  std::int32_t* HWY_RESTRICT found = row.Sides() + from;
  for (int at = 0; at < model.tables.stride(); at += static_cast<int>(hn::Lanes(f))) {
    const auto predicted =
        hn::MulAdd(hn::LoadU(f, slope_y + at), y,
                   hn::MulAdd(hn::LoadU(f, slope_x + at), x, hn::LoadU(f, at_origin + at)));
    // |R - 1 / rho| <= agreement, times rho; false for a NaN and for rho <= 0.
    const auto agrees =
        hn::Le(hn::Abs(hn::MulSub(depth_m, predicted, one)), hn::Mul(agreement, predicted));
    const auto before = hn::LoadU(f, nearest + at);
    const auto closer = hn::Min(hn::LoadU(f, cells + at), before);
    hn::StoreU(hn::IfThenElse(agrees, closer, before), f, nearest + at);
    const auto added = hn::IfThenElseZero(hn::RebindMask(i, agrees), hn::LoadU(i, sides + at));
    hn::StoreU(hn::Or(added, hn::LoadU(i, found + at)), i, found + at);
  }
}

void FindSupportersHere(const SupportModel& model, int y, RowSupport& row) {
  const int reach = model.tables.reach();
  const int top = std::max(-reach, -y);
  const int bottom = std::min(reach, model.samples.height() - 1 - y);
  for (int dy = top; dy <= bottom; ++dy)
    for (std::int32_t s = model.samples.First(y + dy); s < model.samples.First(y + dy + 1); ++s)
      AddSupporter(model, dy, static_cast<std::size_t>(s), row);
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foresight {

HWY_EXPORT(FindSupportersHere);

void FindSupporters(const SupportModel& model, int y, RowSupport& row) {
  HWY_DYNAMIC_DISPATCH(FindSupportersHere)(model, y, row);
}

}  // namespace foresight
#endif
