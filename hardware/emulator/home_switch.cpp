#include "hardware/emulator/home_switch.h"

namespace foresight {
namespace {

constexpr std::uint64_t kSwitchStream = 0x686f6d65;  // "home"

}  // namespace

HomeSwitch::HomeSwitch(const HomeSwitchOptions& options, std::uint64_t seed, double angle_rad)
    : options_(options), random_(seed, kSwitchStream), on_(angle_rad > options.edge_rad) {
  DrawNextEdge();
}

void HomeSwitch::DrawNextEdge() {
  next_edge_rad_ = options_.edge_rad - (on_ ? options_.hysteresis_rad : 0.0) +
                   options_.repeatability_rad * random_.Normal();
}

void HomeSwitch::Update(double angle_rad) {
  const bool crossed = on_ ? angle_rad < next_edge_rad_ : angle_rad > next_edge_rad_;
  if (!crossed) return;
  on_ = !on_;
  DrawNextEdge();
}

}  // namespace foresight
