#include "core/detection/detection.h"

namespace foresight {

const char* KindOf(const Detection& detection) {
  constexpr const char* kKinds[] = {"valve", "drill", "terrain"};
  return kKinds[detection.index()];
}

const Verdict& VerdictOf(const Detection& detection) {
  return std::visit([](const auto& d) -> const Verdict& { return d.verdict; }, detection);
}

const FitOrigin& OriginOf(const Detection& detection) {
  return std::visit([](const auto& d) -> const FitOrigin& { return d.origin; }, detection);
}

}  // namespace foresight
