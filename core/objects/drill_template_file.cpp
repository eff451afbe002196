#include <map>

#include "core/base/atomic_file.h"
#include "core/base/contract.h"
#include "core/base/embedded_files.h"
#include "core/geometry/angles.h"
#include "core/geometry/rotation_between.h"
#include "core/io/yaml_reader.h"
#include "core/objects/drill_template.h"

namespace foresight {

std::span<const EmbeddedFile> DrillTemplateFiles();  // resources/templates, made by CMake

namespace {

constexpr int kFormatVersion = 1;
constexpr std::size_t kLargestFile = 1 << 20;

double Positive(YamlMap& map, const std::string& key) {
  const double value = map.Number(key);
  if (!(value > 0.0)) map.Fault(map.Node(key), "'" + key + "' is not positive");
  return value;
}

double Positive(YamlMap& map, const std::string& key, double fallback) {
  return map.Has(key) ? Positive(map, key) : map.Number(key, fallback);
}

SolidPart::Shape ShapeNamed(YamlMap& map) {
  static const std::map<std::string, SolidPart::Shape> kShapes = {
      {"box", SolidPart::Shape::kBox},
      {"cylinder", SolidPart::Shape::kCylinder},
      {"capsule", SolidPart::Shape::kCapsule}};
  const std::string name = map.Text("shape");
  const auto found = kShapes.find(name);
  if (found == kShapes.end())
    map.Fault(map.Node("shape"), "shape '" + name + "' is not box, cylinder or capsule");
  return found->second;
}

/// A box by its middle, size and roll, pitch and yaw.
void ReadBox(YamlMap& map, SolidPart& part) {
  part.size_m = map.Vector("size_m");
  if (!(part.size_m.minCoeff() > 0.0)) map.Fault(map.Node("size_m"), "'size_m' is not positive");
  const Eigen::Vector3d rpy_deg = map.Vector("rpy_deg", Eigen::Vector3d::Zero());
  const Eigen::Quaterniond turn =
      Eigen::AngleAxisd(RadiansFromDegrees(rpy_deg.z()), Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(RadiansFromDegrees(rpy_deg.y()), Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(RadiansFromDegrees(rpy_deg.x()), Eigen::Vector3d::UnitX());
  part.object_from_part = {turn, map.Vector("middle_m")};
}

/// A cylinder or capsule by the two ends of its axis and its radius.
void ReadRound(YamlMap& map, SolidPart& part) {
  const Eigen::Vector3d from = map.Vector("from_m");
  const Eigen::Vector3d to = map.Vector("to_m");
  const double length = (to - from).norm();
  if (!(length > 1e-6)) map.Fault("'from_m' and 'to_m' are the same point");
  const double diameter = 2.0 * Positive(map, "radius_m");
  part.size_m = {diameter, diameter, length};
  part.object_from_part = {RotationBetween(Eigen::Vector3d::UnitZ(), to - from), 0.5 * (from + to)};
}

SolidPart PartOf(YamlMap& map) {
  SolidPart part;
  part.name = map.Text("name");
  part.shape = ShapeNamed(map);
  if (part.shape == SolidPart::Shape::kBox)
    ReadBox(map, part);
  else
    ReadRound(map, part);
  map.Finish();
  return part;
}

void ReadBit(YamlMap map, DrillTemplate& drill) {
  drill.chuck_face_m = map.Vector("from_m");
  const Eigen::Vector3d direction = map.Vector("direction", Eigen::Vector3d::UnitX());
  if (!(direction.norm() > 1e-6)) map.Fault(map.Node("direction"), "'direction' is zero");
  drill.bit_direction = direction.normalized();
  drill.bit_radius_m = Positive(map, "radius_m", drill.bit_radius_m);
  drill.max_bit_length_m = Positive(map, "max_length_m", drill.max_bit_length_m);
  map.Finish();
}

DrillTemplate TemplateFrom(YamlMap& map) {
  if (map.Integer("foresight_template") != kFormatVersion)
    map.Fault(map.Node("foresight_template"), "this version cannot be read");
  if (const std::string object = map.Text("object"); object != "drill")
    map.Fault(map.Node("object"), "object '" + object + "' is not drill");
  DrillTemplate drill;
  drill.name = map.Text("name");
  drill.min_scale = Positive(map, "min_scale", drill.min_scale);
  drill.max_scale = Positive(map, "max_scale", drill.max_scale);
  drill.log_prior = map.Number("log_prior", drill.log_prior);
  drill.usual_rake_rad = RadiansFromDegrees(map.Number("usual_rake_deg", 0.0));
  for (YamlMap& entry : map.List("parts")) drill.parts.push_back(PartOf(entry));
  ReadBit(map.Map("bit"), drill);
  drill.object_from_grasp = {Eigen::Quaterniond::Identity(), map.Vector("grasp_m")};
  drill.trigger_m = map.Vector("trigger_m");
  if (const Status status = drill.Check(); !status) map.Fault(status.error().message);
  return drill;
}

}  // namespace

Result<DrillTemplate> DrillTemplateFromYaml(const std::string& yaml, const std::string& source) {
  DrillTemplate drill;
  FORESIGHT_CHECK(ParseYaml(yaml, source, [&drill](YamlMap& map) {
    drill = TemplateFrom(map);
    map.Finish();
  }));
  drill.yaml = yaml;
  return drill;
}

Result<DrillTemplate> LoadDrillTemplate(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string yaml, ReadFile(path, kLargestFile));
  return DrillTemplateFromYaml(yaml, path.string());
}

std::vector<DrillTemplate> ShippedDrillTemplates() {
  static const std::vector<DrillTemplate> shipped = [] {
    std::vector<DrillTemplate> templates;
    for (const EmbeddedFile& file : DrillTemplateFiles()) {
      auto drill = DrillTemplateFromYaml(std::string(file.text), std::string(file.name));
      FORESIGHT_EXPECTS(drill.has_value(), "a shipped drill template can be read");
      templates.push_back(std::move(*drill));
    }
    return templates;
  }();
  return shipped;
}

}  // namespace foresight
