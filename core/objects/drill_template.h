#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/objects/drill_model.h"

namespace foresight {

/// What drills of one kind differ in beside their size.
struct DrillProportions {
  double head_up_m = 0.0;  ///< of the head, the body that much longer; at most half of it shorter
  double front_m = 0.0;    ///< how much further the head's front, chuck and bit are in front
  double back_m = 0.0;     ///< how much further the head's rear end is behind
  double nose_fraction = 1.0;   ///< of the radius of the gear case
  double chuck_fraction = 1.0;  ///< of the chuck's radius
  double chuck_longer_m = 0.0;
  double foot_fraction = 1.0;         ///< of the foot's length and width
  double foot_height_fraction = 1.0;  ///< of what stands on the table, from the table up
  double grip_fraction = 1.0;         ///< of the body's width and depth
  double head_fraction = 1.0;         ///< of the head's width and height
  double foot_forward_m = 0.0;        ///< how much further the foot is in front of the body's axis
  double rake_rad = 0.0;  ///< of the grip under a level head: positive = its top is in front
};

/// A kind of drill, read from a data file (resources/templates, docs/templates.md): the parts at
/// scale 1 without lean, and how far a drill of this kind may differ from them.
struct DrillTemplate {
  static constexpr const char* kBody = "body";          ///< the part that a hand goes round
  static constexpr const char* kFoot = "battery foot";  ///< parts that do not lean with the body
  static constexpr const char* kTrigger = "trigger";
  static constexpr const char* kGearCase = "gear case";
  static constexpr const char* kHead = "head";
  static constexpr const char* kChuck = "chuck";
  static constexpr const char* kBit = "bit";  ///< no template has one: a fit adds it

  std::string name;
  /// Foot, body, head, chuck, trigger... The body's axis is z; parts named "battery foot" do not
  /// lean with it. No bit: that is free.
  std::vector<SolidPart> parts;
  double min_scale = 0.8;
  double max_scale = 1.25;
  double log_prior = 0.0;  ///< in nats, 0 or less: how seldom this kind is met beside the others
  /// How far a grip of this kind usually leans under its head beyond what its parts do, as
  /// DrillProportions::rake_rad; within 0.4.
  double usual_rake_rad = 0.0;
  double bit_radius_m = 0.004;
  double max_bit_length_m = 0.15;  ///< from the chuck's face
  /// Where a bit begins, and the way it points there: x, or z of a tool that works upwards.
  Eigen::Vector3d chuck_face_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d bit_direction = Eigen::Vector3d::UnitX();
  Rigid<frame::Object, frame::Object> object_from_grasp;
  Eigen::Vector3d trigger_m = Eigen::Vector3d::Zero();
  std::string yaml;  ///< the text that it was read from

  /// Fails with kInvalidOptions, naming the part or member at fault.
  Status Check() const;
  /// The first part named "body". Check() has passed.
  const SolidPart& Body() const;
  /// `proportions` come after the scale. The head is what lies above the grasp point and is not the
  /// body; a part named "trigger" goes up with it, not forward.
  DrillModel Make(double scale, const Eigen::Vector2d& body_tilt_rad, double bit_length_m,
                  const DrillProportions& proportions = {}) const;
};

/// Fails with kBadData, naming `source` and the line at fault; an unknown key is an error.
Result<DrillTemplate> DrillTemplateFromYaml(const std::string& yaml, const std::string& source);
Result<DrillTemplate> LoadDrillTemplate(const std::filesystem::path& path);

/// resources/templates/drill_*.yaml as they were when the program was built.
std::vector<DrillTemplate> ShippedDrillTemplates();

}  // namespace foresight
