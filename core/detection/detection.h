#pragma once

#include <array>
#include <string>
#include <variant>

#include "core/base/result.h"
#include "core/fitting/cylinder/cylinder_detection.h"
#include "core/fitting/drill/drill_detection.h"
#include "core/fitting/handle/handle_detection.h"
#include "core/fitting/terrain/terrain_detection.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

/// What was found in a region: one of the known objects.
using Detection = std::variant<ValveDetection, DrillDetection, TerrainDetection, HandleDetection,
                               CylinderDetection>;

/// The known objects, in the order of Detection's alternatives.
enum class ObjectKind { kValve, kDrill, kTerrain, kHandle, kCylinder };
inline constexpr std::array kObjectKinds = {ObjectKind::kValve, ObjectKind::kDrill,
                                            ObjectKind::kTerrain, ObjectKind::kHandle,
                                            ObjectKind::kCylinder};
/// "valve", "drill", "terrain", "handle", "cylinder": the kind in files and on command lines.
const char* ToString(ObjectKind kind);
/// The reverse; fails with kBadData.
Result<ObjectKind> ObjectKindFromString(const std::string& name);

ObjectKind ObjectKindOf(const Detection& detection);
const char* KindOf(const Detection& detection);
const Verdict& VerdictOf(const Detection& detection);
const FitOrigin& OriginOf(const Detection& detection);
FitOrigin& OriginOf(Detection& detection);

}  // namespace foresight
