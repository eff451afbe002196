#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/simulation/scene.h"

namespace foresight {

/// A tool that stands on a table: meshes in its own frame (x = the way it points, z = up from the
/// table), and where its grip is.
struct OtherTool {
  std::string name;  ///< how it was drawn: "drill", "heat gun", "jigsaw", ...
  std::vector<SceneMesh> parts;
  /// Two points on the grip's axis, the lower first.
  Eigen::Vector3d grip_low_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d grip_high_m = Eigen::Vector3d::UnitZ();
};

/// Cordless drills and drivers: bodies of revolved outlines, grips with a curve, battery packs of
/// three kinds, guards, side handles, hooks, bits.
OtherTool DrawDrill(Random& random);
/// Tools that are meant to be no drill: a flashlight, a spray bottle, a jigsaw, a heat gun, a
/// grinder that stands on its battery, a glue gun, a radio.
OtherTool DrawOtherTool(Random& random);

/// What a tool is when it is looked at from its left (16,000 rays), whoever drew it.
struct ToolMeasures {
  double height_m = 0.0;
  double grip_m = 0.0;        ///< depth of its column at a hand's height
  double grip_width_m = 0.0;  ///< of that across
  double foot_m = 0.0;        ///< length on the table, round the grip
  double head_m = 0.0;        ///< length of the longest row above the grip
  double front_m = 0.0;       ///< of it before the grip's middle
  double back_m = 0.0;        ///< ... and behind
  double nose_ratio = 1.0;    ///< height of the head's front end against that of its middle

  /// A grip of 25 to 85 mm stands on a foot that is a seventh longer and carries a head of at least
  /// 110 mm and 1.8 grips that reaches 70 mm to the front and 20 mm to the back and ends in
  /// something at most 0.75 as high (a chuck or a bit); 170 to 330 mm high.
  bool IsDrill() const;
};
ToolMeasures MeasureTool(const OtherTool& tool);

}  // namespace foresight
