#include "core/calibration/chain_angles.h"

#include <cmath>

#include "core/base/contract.h"

namespace foresight {
namespace {

AngleCorrection CorrectionOf(const ChainState& state) {
  std::vector<AngleCorrection::Knot> knots;
  for (std::size_t stop = 0; stop < state.motor_rad.size(); ++stop)
    knots.push_back({state.motor_rad[stop], state.plate_rad[stop]});
  auto correction = AngleCorrection::FromKnots(std::move(knots));
  FORESIGHT_EXPECTS(correction.has_value(), "stops increase");
  return *correction;
}

}  // namespace

PlateAngles::PlateAngles(const ChainData& data, const ChainState& state)
    : data_(data), state_(state), correction_(CorrectionOf(state)) {}

double PlateAngles::At(int pose, int stop, int visit, double time_s) const {
  if (stop != BoardHits::kNone)
    return state_.plate_rad[static_cast<std::size_t>(stop)] +
           (visit == BoardHits::kNone ? 0.0 : state_.jitter_rad[static_cast<std::size_t>(visit)]);
  const MotorTrack& track = data_.tracks[static_cast<std::size_t>(pose)];
  const double motor_rad = track.AngleAt(time_s + state_.stamp_offset_s);
  return std::isfinite(motor_rad) ? correction_.PlateAngle(motor_rad) : motor_rad;
}

}  // namespace foresight
