#include "core/detection/detection.h"

namespace foresight {

const char* ToString(ObjectKind kind) {
  constexpr const char* kKinds[] = {"valve", "drill", "terrain", "handle", "cylinder"};
  return kKinds[static_cast<std::size_t>(kind)];
}

Result<ObjectKind> ObjectKindFromString(const std::string& name) {
  for (const ObjectKind kind : kObjectKinds)
    if (name == ToString(kind)) return kind;
  return Fail(ErrorCode::kBadData, "object '{}' is not known", name);
}

ObjectKind ObjectKindOf(const Detection& detection) {
  return kObjectKinds[detection.index()];
}

const char* KindOf(const Detection& detection) {
  return ToString(ObjectKindOf(detection));
}

const Verdict& VerdictOf(const Detection& detection) {
  return std::visit([](const auto& d) -> const Verdict& { return d.verdict; }, detection);
}

const FitOrigin& OriginOf(const Detection& detection) {
  return std::visit([](const auto& d) -> const FitOrigin& { return d.origin; }, detection);
}

FitOrigin& OriginOf(Detection& detection) {
  return std::visit([](auto& d) -> FitOrigin& { return d.origin; }, detection);
}

}  // namespace foresight
