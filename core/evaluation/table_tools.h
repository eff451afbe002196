#pragma once

#include <span>

#include "core/base/random.h"
#include "core/simulation/scene.h"

namespace foresight {

/// Tools and household things that stand where a drill could and are none, though some have a grip,
/// a foot or a head.
enum class TableTool {
  kTriggerSprayer,  ///< a round or oval bottle under a sprayer's head and lever
  kFlashlight,      ///< upright on its end, straight or with an angled head
  kWorkLight,       ///< a round lamp on a grip and a battery: it ends as wide as it is
  kJug,             ///< a bellied body with a handle and a spout
  kHotAirTool,      ///< a heat gun or a hair dryer: a barrel that stays wide, on a grip
  kGrinder,         ///< an angle grinder on its disc, or upright on its end
};

std::span<const TableTool> TableTools();
/// "trigger sprayer".
const char* NameOf(TableTool tool);

/// Stands it at a place of a table, in robot. ToolMeasures (other_tool.h) never finds a drill in
/// it.
void AddTableTool(TableTool tool, const Rigid<frame::Robot, frame::Object>& robot_from_place,
                  const Material& material, Random& random, Scene& scene);

}  // namespace foresight
