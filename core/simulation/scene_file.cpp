#include <algorithm>
#include <map>

#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/io/triangle_mesh.h"
#include "core/io/yaml_reader.h"
#include "core/simulation/board_stand.h"
#include "core/simulation/scene.h"
#include "core/simulation/scene_objects.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;

constexpr int kFormatVersion = 1;

/// Of sizes and places: float rays are good to a tenth of a millimetre there, and not beyond.
constexpr double kFarthest_m = 1000.0;
/// Of lights and of what glows: 1 is a well lit room.
constexpr double kBrightest = 1e6;
constexpr std::size_t kMostPlaces = 1000;

/// A number in (0, kFarthest_m]: lengths, and factors that make lengths.
double Positive(YamlMap& map, const std::string& key) {
  const double value = map.Number(key);
  if (!(value > 0.0)) map.Fault(map.Node(key), "'" + key + "' is not positive");
  if (!(value <= kFarthest_m))
    map.Fault(map.Node(key), fmt::format("'{}' is {}, more than {}", key, value, kFarthest_m));
  return value;
}

double Positive(YamlMap& map, const std::string& key, double fallback) {
  return map.Has(key) ? Positive(map, key) : map.Number(key, fallback);
}

double Brightness(YamlMap& map, const std::string& key, double fallback) {
  const double value = map.Number(key, fallback);
  if (!(value >= 0.0 && value <= kBrightest))
    map.Fault(map.Node(key), fmt::format("'{}' is {}, not 0 to {}", key, value, kBrightest));
  return value;
}

/// A place in robot, metres.
Eigen::Vector3d Place(YamlMap& map, const std::string& key) {
  const Eigen::Vector3d value = map.Vector(key);
  if (!(value.array().abs() <= kFarthest_m).all())
    map.Fault(map.Node(key), fmt::format("'{}' is further than {} m away", key, kFarthest_m));
  return value;
}

double ReadFraction(YamlMap& map, const std::string& key, double fallback) {
  const double value = map.Number(key, fallback);
  if (!(value >= 0.0 && value <= 1.0))
    map.Fault(map.Node(key), "'" + key + "' is not between 0 and 1");
  return value;
}

Eigen::Vector3d Size(YamlMap& map, const std::string& key, const Eigen::Vector3d& fallback) {
  const Eigen::Vector3d value = map.Vector(key, fallback);
  if (!(value.minCoeff() > 0.0)) map.Fault(map.Node(key), "'" + key + "' is not positive");
  if (!(value.maxCoeff() <= kFarthest_m))
    map.Fault(map.Node(key), fmt::format("'{}' has a side of {} m; {} m is the most", key,
                                         value.maxCoeff(), kFarthest_m));
  return value;
}

Eigen::Vector3d Color(YamlMap& map, const std::string& key, const Eigen::Vector3d& fallback) {
  const Eigen::Vector3d value = map.Vector(key, fallback);
  if (!(value.minCoeff() >= 0.0 && value.maxCoeff() <= 1.0))
    map.Fault(map.Node(key), "'" + key + "' is not a colour of values between 0 and 1");
  return value;
}

Eigen::Quaterniond RotationOf(YamlMap& map) {
  const Eigen::Vector3d rpy_deg = map.Vector("rpy_deg", Eigen::Vector3d::Zero());
  return Eigen::AngleAxisd(RadiansFromDegrees(rpy_deg.z()), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(RadiansFromDegrees(rpy_deg.y()), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(RadiansFromDegrees(rpy_deg.x()), Eigen::Vector3d::UnitX());
}

Pose PoseOf(YamlMap& map) {
  const Eigen::Vector3d position = map.Has("position_m")
                                       ? Place(map, "position_m")
                                       : map.Vector("position_m", Eigen::Vector3d::Zero());
  return {RotationOf(map), position};
}

/// `quaternion_wxyz` and `translation_m`.
template <class To, class From>
Rigid<To, From> RigidOf(YamlMap map) {
  const std::vector<double> q = map.Numbers("quaternion_wxyz", 4);
  const Eigen::Vector3d t = Place(map, "translation_m");
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (!(std::abs(rotation.norm() - 1.0) <= 1e-3))
    map.Fault(map.Node("quaternion_wxyz"), "'quaternion_wxyz' does not have length 1");
  map.Finish();
  return {rotation.normalized(), t};
}

PrintErrors PrintOf(YamlMap map) {
  PrintErrors errors;
  const auto two = [&](const char* key, const Eigen::Vector2d& fallback) {
    if (!map.Has(key)) return fallback;
    const std::vector<double> values = map.Numbers(key, 2);
    return Eigen::Vector2d(values[0], values[1]);
  };
  errors.scale = two("scale", errors.scale);
  errors.corner_jitter_m = 1e-3 * map.Number("corner_jitter_mm", 0.0);
  errors.seed = static_cast<std::uint64_t>(std::max(0, map.Integer("seed", 1)));
  const Eigen::Vector2d warp_m = 1e-3 * two("warp_mm", Eigen::Vector2d::Zero());
  errors.warp = {warp_m.x(), warp_m.y()};
  map.Finish();
  return errors;
}

/// By the stand's middle and how it is turned, or as a pose of its first board.
Rigid<frame::Robot, frame::Pattern> StandPoseOf(YamlMap& map, const BoardStand& stand) {
  if (map.Has("robot_from_stand"))
    return RigidOf<frame::Robot, frame::Pattern>(map.Map("robot_from_stand"));
  const Eigen::Vector3d position_m = Place(map, "position_m");
  return StandPose(stand, position_m, RotationOf(map));
}

Material::Pattern PatternOf(YamlMap& map) {
  static const std::map<std::string, Material::Pattern> kPatterns = {
      {"plain", Material::Pattern::kPlain},
      {"checker", Material::Pattern::kChecker},
      {"stripes", Material::Pattern::kStripes},
      {"noise", Material::Pattern::kNoise},
      {"brick", Material::Pattern::kBrick}};
  const std::string name = map.Text("pattern", "plain");
  const auto found = kPatterns.find(name);
  if (found == kPatterns.end())
    map.Fault(map.Node("pattern"),
              "pattern '" + name + "' is not plain, checker, stripes, noise or brick");
  return found->second;
}

Material MaterialOf(YamlMap map) {
  Material material;
  material.color = Color(map, "color", material.color);
  material.pattern = PatternOf(map);
  material.color2 = Color(map, "color2", material.color2);
  material.pattern_size_m = Positive(map, "pattern_size_m", material.pattern_size_m);
  material.lidar_reflectance = ReadFraction(map, "lidar_reflectance", material.lidar_reflectance);
  material.specular = ReadFraction(map, "specular", material.specular);
  material.emission = Brightness(map, "emission", material.emission);
  material.translucency = ReadFraction(map, "translucency", material.translucency);
  material.penetration_m = ReadFraction(map, "penetration_m", material.penetration_m);
  map.Finish();
  return material;
}

Light LightOf(YamlMap& map) {
  Light light;
  light.position_m = Place(map, "position_m");
  light.intensity = Brightness(map, "intensity", light.intensity);
  map.Finish();
  return light;
}

/// Reads the parts of one scene file that name materials.
class SceneReader {
 public:
  /// `folder`: where the scene's meshes are; nullptr = it comes from no file.
  SceneReader(YamlMap& map, const std::filesystem::path* folder) : map_(map), folder_(folder) {}

  Scene Read() {
    const int version = map_.Integer("foresight_scene");
    if (version != kFormatVersion)
      map_.Fault(fmt::format("scene format {} is not known; this program reads {}", version,
                             kFormatVersion));
    scene_.name = map_.Text("name");
    scene_.ambient = Brightness(map_, "ambient", scene_.ambient);
    for (YamlMap& entry : map_.List("lights")) scene_.lights.push_back(LightOf(entry));
    ReadMaterials();
    for (YamlMap& entry : map_.List("solids")) ReadSolid(entry);
    for (YamlMap& entry : map_.List("objects")) ReadObject(entry);
    for (YamlMap& entry : map_.List("stands")) {
      scene_.stands.push_back(StandOf(entry));
      entry.Finish();
    }
    for (YamlMap& entry : map_.List("places")) ReadPlace(entry);
    map_.Finish();
    return std::move(scene_);
  }

 private:
  void ReadMaterials() {
    const YAML::Node node = map_.Node("materials");
    if (!node.IsDefined()) return;
    if (!node.IsMap()) map_.Fault(node, "'materials' is not a mapping of names");
    for (const auto& entry : node)
      materials_[entry.first.Scalar()] = MaterialOf({entry.second, map_.source()});
  }

  Material Named(YamlMap& map, const std::string& key) const {
    const std::string name = map.Text(key);
    const auto found = materials_.find(name);
    if (found == materials_.end())
      map.Fault(map.Node(key), "material '" + name + "' is not among the materials");
    return found->second;
  }
  Material Named(YamlMap& map, const std::string& key, const Material& fallback) const {
    return map.Has(key) ? Named(map, key) : fallback;
  }

  void ReadSolid(YamlMap& map);
  Shape ShapeOf(YamlMap& map, const std::string& kind, Pose& pose) const;
  Shape MeshOf(YamlMap& map) const;
  double LengthOrEnds(YamlMap& map, Pose& pose) const;
  void ReadObject(YamlMap& map);
  void ReadValve(YamlMap& map);
  void ReadDrill(YamlMap& map);
  void ReadBlock(YamlMap& map);
  void ReadHandle(YamlMap& map);
  BoardObject BoardOf(YamlMap& map, const std::string& key) const;
  BoardStand StandOf(YamlMap& map) const;
  void ReadPlace(YamlMap& map);

  YamlMap& map_;
  const std::filesystem::path* folder_;
  Scene scene_;
  std::map<std::string, Material> materials_;
};

/// A long solid's length: given, or by the two ends of its axis, which are its pose as well.
double SceneReader::LengthOrEnds(YamlMap& map, Pose& pose) const {
  if (!map.Has("from_m") && !map.Has("to_m")) {
    pose = PoseOf(map);
    return Positive(map, "length_m");
  }
  const Eigen::Vector3d from = Place(map, "from_m");
  const Eigen::Vector3d to = Place(map, "to_m");
  if (!((to - from).norm() > 1e-6)) map.Fault("'from_m' and 'to_m' are the same point");
  pose = Pose() * PoseAlong(from, to);
  return (to - from).norm();
}

Shape SceneReader::ShapeOf(YamlMap& map, const std::string& kind, Pose& pose) const {
  if (kind == "cylinder" || kind == "capsule") {
    const double length = LengthOrEnds(map, pose);
    const double radius = Positive(map, "radius_m");
    return kind == "cylinder" ? CylinderShape(radius, length) : CapsuleShape(radius, length);
  }
  pose = PoseOf(map);
  if (kind == "box") {
    map.Vector("size_m");  // has no default
    return BoxShape(Size(map, "size_m", Eigen::Vector3d::Zero()));
  }
  if (kind == "plane") {
    const std::vector<double> size = map.Numbers("size_m", 2);
    if (!(size[0] > 0.0 && size[1] > 0.0))
      map.Fault(map.Node("size_m"), "'size_m' is not positive");
    if (!(size[0] <= kFarthest_m && size[1] <= kFarthest_m))
      map.Fault(map.Node("size_m"), fmt::format("'size_m' has a side beyond {} m", kFarthest_m));
    return RectangleShape(size[0], size[1]);
  }
  if (kind == "mesh") return MeshOf(map);
  if (kind == "sphere") return SphereShape(Positive(map, "radius_m"));
  if (kind == "torus") {
    const double radius = Positive(map, "radius_m");
    const double tube = Positive(map, "tube_radius_m");
    if (tube >= radius)
      map.Fault(map.Node("tube_radius_m"), "'tube_radius_m' is not below 'radius_m'");
    return TorusShape(radius, tube);
  }
  map.Fault(map.Node("shape"),
            "shape '" + kind + "' is not box, plane, cylinder, capsule, sphere, torus or mesh");
}

Shape SceneReader::MeshOf(YamlMap& map) const {
  const std::string file = map.Text("file");
  const double scale = Positive(map, "scale", 1.0);
  if (folder_ == nullptr)
    map.Fault(map.Node("file"), "a scene that comes from no file has no meshes beside it");
  const auto mesh = ReadTriangleMesh(*folder_ / file);
  if (!mesh) map.Fault(map.Node("file"), mesh.error().message);
  Shape shape;
  for (const Eigen::Vector3d& vertex : mesh->vertices) {
    if (!((scale * vertex).cwiseAbs().maxCoeff() <= kFarthest_m))
      map.Fault(map.Node("file"),
                fmt::format("'{}' reaches beyond {} m: is 'scale' right?", file, kFarthest_m));
    shape.vertices.push_back((scale * vertex).cast<float>());
  }
  shape.triangles = mesh->triangles;
  return shape;
}

void SceneReader::ReadSolid(YamlMap& map) {
  const std::string kind = map.Text("shape");
  SceneMesh mesh;
  mesh.name = map.Text("name", kind);
  mesh.material = Named(map, "material");
  const Shape shape = ShapeOf(map, kind, mesh.robot_from_object);
  AppendShape(shape, mesh.robot_from_object, mesh);
  map.Finish();
  scene_.meshes.push_back(std::move(mesh));
}

void SceneReader::ReadObject(YamlMap& map) {
  const std::string kind = map.Text("kind");
  if (kind == "valve") {
    ReadValve(map);
  } else if (kind == "drill") {
    ReadDrill(map);
  } else if (kind == "block") {
    ReadBlock(map);
  } else if (kind == "handle") {
    ReadHandle(map);
  } else if (kind == "stand") {
    const BoardStand stand = StandOf(map);
    const Rigid<frame::Robot, frame::Pattern> pose = StandPoseOf(map, stand);
    map.Finish();
    AddStand(stand, pose, scene_);
  } else {
    map.Fault(map.Node("kind"),
              "object '" + kind + "' is not valve, drill, block, handle or stand");
  }
}

void SceneReader::ReadValve(YamlMap& map) {
  ValveObject valve;
  valve.name = map.Text("name", "valve");
  const Eigen::Vector3d axis = map.Vector("axis", -Eigen::Vector3d::UnitX());
  if (!(std::abs(axis.z()) < 0.99 * axis.norm()))
    map.Fault(map.Node("axis"), "'axis' is zero or vertical");
  valve.robot_from_object =
      ValvePose(Place(map, "position_m"), axis, RadiansFromDegrees(map.Number("phase_deg", 0.0)));
  valve.model.rim_radius_m = map.Number("rim_radius_m", valve.model.rim_radius_m);
  valve.model.tube_radius_m = map.Number("tube_radius_m", valve.model.tube_radius_m);
  valve.model.spokes = map.Integer("spokes", valve.model.spokes);
  valve.model.spoke_radius_m = map.Number("spoke_radius_m", valve.model.spoke_radius_m);
  valve.model.hub_radius_m = map.Number("hub_radius_m", valve.model.hub_radius_m);
  valve.model.dish_m = map.Number("dish_m", valve.model.dish_m);
  valve.model.rim_depth_ratio = map.Number("rim_depth_ratio", valve.model.rim_depth_ratio);
  valve.model.spoke_depth_ratio = map.Number("spoke_depth_ratio", valve.model.spoke_depth_ratio);
  if (const Status status = valve.model.Check(); !status) map.Fault(status.error().message);
  for (const double size :
       {valve.model.rim_radius_m, valve.model.hub_radius_m, valve.model.spoke_radius_m,
        std::abs(valve.model.dish_m), valve.model.RimDepth(), valve.model.SpokeDepth()})
    if (!(size <= kFarthest_m))
      map.Fault(fmt::format("a valve with a radius or a dish of {} m; {} m is the most", size,
                            kFarthest_m));
  valve.stem_length_m = Positive(map, "stem_length_m", valve.stem_length_m);
  valve.stem_radius_m = Positive(map, "stem_radius_m", valve.stem_radius_m);
  valve.flange_radius_m = Positive(map, "flange_radius_m", valve.flange_radius_m);
  valve.wheel_material = Named(map, "material");
  valve.body_material = Named(map, "body_material", valve.wheel_material);
  map.Finish();
  AddValve(valve, scene_);
}

void SceneReader::ReadDrill(YamlMap& map) {
  DrillObject drill;
  drill.name = map.Text("name", "drill");
  drill.robot_from_object = PoseOf(map);
  drill.scale = Positive(map, "scale", drill.scale);
  drill.shell_material = Named(map, "material");
  drill.grip_material = Named(map, "grip_material", drill.shell_material);
  drill.metal_material = Named(map, "metal_material", drill.grip_material);
  map.Finish();
  AddDrill(drill, scene_);
}

void SceneReader::ReadBlock(YamlMap& map) {
  BlockObject block;
  block.name = map.Text("name", "block");
  block.robot_from_object = PoseOf(map);
  block.size_m = Size(map, "size_m", block.size_m);
  block.material = Named(map, "material");
  map.Finish();
  AddBlock(block, scene_);
}

void SceneReader::ReadHandle(YamlMap& map) {
  HandleObject handle;
  handle.name = map.Text("name", "handle");
  handle.robot_from_object = PoseOf(map);
  HandleModel& model = handle.model;
  model.length_m = map.Number("length_m", model.length_m);
  model.behind_m = map.Number("behind_m", model.behind_m);
  model.bow_m = map.Number("bow_m", model.bow_m);
  model.lift_m = map.Number("lift_m", model.lift_m);
  model.radius_m = map.Number("radius_m", model.radius_m);
  model.standoff_m = map.Number("standoff_m", model.standoff_m);
  model.returned = map.Flag("returned", model.returned);
  const std::string plate = map.Text("plate", ToString(model.plate));
  if (plate != ToString(HandleModel::Plate::kLong) && plate != ToString(model.plate))
    map.Fault(map.Node("plate"), "plate '" + plate + "' is neither rosette nor long");
  if (plate == ToString(HandleModel::Plate::kLong)) model.plate = HandleModel::Plate::kLong;
  if (const Status status = model.Check(); !status) map.Fault(status.error().message);
  handle.lever_material = Named(map, "material");
  handle.plate_material = Named(map, "plate_material", handle.lever_material);
  map.Finish();
  AddHandle(handle, scene_);
}

BoardObject SceneReader::BoardOf(YamlMap& map, const std::string& key) const {
  BoardObject object;
  const auto board = CalibrationBoardFromText(map.Text(key));
  if (!board) map.Fault(map.Node(key), board.error().message);
  object.board = *board;
  if (map.Has(key + "_print")) object.errors = PrintOf(map.Map(key + "_print"));
  object.margin_m = 1e-3 * map.Number("margin_mm", 1e3 * object.margin_m);
  object.material = Named(map, "material");
  if (const Status status = object.Check(); !status)
    map.Fault(map.Node(key), status.error().message);
  return object;
}

BoardStand SceneReader::StandOf(YamlMap& map) const {
  BoardStand stand;
  stand.name = map.Text("name", "stand");
  stand.a = BoardOf(map, "a");
  if (!map.Has("b")) return stand;
  stand.b = BoardOf(map, "b");
  if (map.Has("a_from_b"))
    stand.a_from_b = RigidOf<frame::Pattern, frame::Pattern>(map.Map("a_from_b"));
  else
    stand.a_from_b =
        HingedMount(stand.a.board, stand.b->board, 1e-3 * map.Number("hinge_mm", 1e3 * kHinge_m))
            .a_from_b;
  if (!(stand.a_from_b.translation().norm() <= 10.0)) map.Fault("the boards are over 10 m apart");
  return stand;
}

void SceneReader::ReadPlace(YamlMap& map) {
  StandPlace place;
  place.name = map.Text("name", fmt::format("place {}", scene_.places.size() + 1));
  const std::string name = map.Text("stand");
  const auto found = std::find_if(scene_.stands.begin(), scene_.stands.end(),
                                  [&](const BoardStand& stand) { return stand.name == name; });
  if (found == scene_.stands.end())
    map.Fault(map.Node("stand"), "stand '" + name + "' is not among the stands");
  place.stand = static_cast<int>(found - scene_.stands.begin());
  place.robot_from_stand = StandPoseOf(map, *found);
  map.Finish();
  if (scene_.places.size() == kMostPlaces)
    map.Fault(fmt::format("more than {} places", kMostPlaces));
  scene_.places.push_back(std::move(place));
}

}  // namespace

namespace {

Result<Scene> SceneFrom(const std::string& yaml, const std::string& source,
                        const std::filesystem::path* folder) {
  Scene scene;
  FORESIGHT_CHECK(
      ParseYaml(yaml, source, [&](YamlMap& map) { scene = SceneReader(map, folder).Read(); }));
  return scene;
}

}  // namespace

Result<Scene> SceneFromYaml(const std::string& yaml, const std::string& source) {
  return SceneFrom(yaml, source, nullptr);
}

Result<Scene> LoadScene(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string yaml, ReadFile(path, 1 << 20));
  const std::filesystem::path folder = path.parent_path();
  return SceneFrom(yaml, path.string(), &folder);
}

}  // namespace foresight
