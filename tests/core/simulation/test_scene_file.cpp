#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "core/simulation/ray_caster.h"
#include "core/simulation/scene.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

std::string SceneWithSolid(const std::string& solid) {
  return "foresight_scene: 1\n"
         "name: test\n"
         "materials:\n"
         "  grey: {color: [0.5, 0.5, 0.5]}\n"
         "solids:\n"
         "  - {shape: sphere, radius_m: 1, material: grey}\n"
         "  - " +
         solid + "\n";
}

std::string ErrorOf(const std::string& yaml) {
  const auto scene = SceneFromYaml(yaml, "test.yaml");
  return scene ? "no error" : scene.error().message;
}

TEST(SceneFile, NamesATypoWithItsLine) {
  EXPECT_THAT(
      ErrorOf(SceneWithSolid("{shape: sphere, radius_m: 1, materail: grey, material: grey}")),
      testing::AllOf(HasSubstr("test.yaml:7"), HasSubstr("'materail'")));
}

TEST(SceneFile, NamesAnUnknownMaterialWithItsLine) {
  EXPECT_THAT(ErrorOf(SceneWithSolid("{shape: sphere, radius_m: 1, material: gray}")),
              testing::AllOf(HasSubstr("test.yaml:7"), HasSubstr("'gray'")));
}

TEST(SceneFile, NamesAMissingKeyWithItsLine) {
  EXPECT_THAT(ErrorOf(SceneWithSolid("{shape: box, material: grey}")),
              testing::AllOf(HasSubstr("test.yaml:7"), HasSubstr("'size_m'")));
}

TEST(SceneFile, NamesAnUnknownShape) {
  EXPECT_THAT(ErrorOf(SceneWithSolid("{shape: cone, material: grey}")), HasSubstr("'cone'"));
}

TEST(SceneFile, RefusesANegativeRadius) {
  EXPECT_THAT(ErrorOf(SceneWithSolid("{shape: sphere, radius_m: -1, material: grey}")),
              testing::AllOf(HasSubstr("test.yaml:7"), HasSubstr("'radius_m' is not positive")));
}

TEST(SceneFile, RefusesWhatReachesBeyondAKilometre) {
  for (const char* solid :
       {"{shape: box, size_m: [1.0e9, 1, 1], material: grey}",
        "{shape: plane, size_m: [1, 1.0e308], material: grey}",
        "{shape: sphere, radius_m: 1.0e9, material: grey}",
        "{shape: sphere, radius_m: 1, position_m: [0, 1.0e308, 0], material: grey}",
        "{shape: cylinder, from_m: [0, 0, 0], to_m: [0, 0, 1.0e9], radius_m: 1, "
        "material: grey}"})
    EXPECT_THAT(ErrorOf(SceneWithSolid(solid)),
                testing::AllOf(HasSubstr("test.yaml:7"), HasSubstr("1000")))
        << solid;
}

TEST(SceneFile, RefusesALightThatIsNone) {
  for (const char* light :
       {"{position_m: [0, 0, 1.0e308]}", "{position_m: [0, 0, 2], intensity: 1.0e308}",
        "{position_m: [0, 0, 2], intensity: -1}"})
    EXPECT_THAT(ErrorOf("foresight_scene: 1\nname: x\nlights:\n  - " + std::string(light) + "\n"),
                HasSubstr("test.yaml:4"))
        << light;
}

TEST(SceneFile, RefusesAColourAboveOne) {
  EXPECT_THAT(ErrorOf("foresight_scene: 1\nname: x\nmaterials:\n  a: {color: [255, 0, 0]}\n"),
              testing::AllOf(HasSubstr("test.yaml:4"), HasSubstr("'color'")));
}

TEST(SceneFile, RefusesAValveThatIsNoWheel) {
  EXPECT_THAT(ErrorOf("foresight_scene: 1\nname: x\nmaterials: {a: {}}\nobjects:\n"
                      "  - {kind: valve, position_m: [1, 0, 1], spokes: 9, material: a}\n"),
              testing::AllOf(HasSubstr("test.yaml:5"), HasSubstr("spokes 9")));
}

TEST(SceneFile, RefusesAnotherFormatVersion) {
  EXPECT_THAT(ErrorOf("foresight_scene: 2\nname: x\n"), HasSubstr("scene format 2 is not known"));
}

TEST(SceneFile, ReportsAFileThatIsNotThere) {
  const auto scene = LoadScene("/nonexistent/scene.yaml");
  ASSERT_FALSE(scene.has_value());
  EXPECT_EQ(scene.error().code, ErrorCode::kIo);
}

TEST(SceneFile, APipeReachesBothOfItsPoints) {
  const auto scene = SceneFromYaml(
      SceneWithSolid("{shape: cylinder, radius_m: 0.1, from_m: [1, 2, 3], to_m: [1, 2, 5], "
                     "material: grey}"),
      "test.yaml");
  ASSERT_TRUE(scene.has_value()) << scene.error().message;
  float low = 100.0f;
  float high = -100.0f;
  for (const Eigen::Vector3f& vertex : scene->meshes.back().vertices) {
    low = std::min(low, vertex.z());
    high = std::max(high, vertex.z());
  }
  EXPECT_NEAR(low, 3.0, 1e-5);
  EXPECT_NEAR(high, 5.0, 1e-5);
}

/// A cube of 20 units as an OBJ file, beside a scene that has it in millimetres.
class SceneWithMesh : public testing::Test {
 protected:
  SceneWithMesh() {
    std::string obj;
    for (int i = 0; i < 8; ++i)
      obj += fmt::format("v {} {} {}\n", i & 1 ? 10 : -10, i & 2 ? 10 : -10, i & 4 ? 10 : -10);
    obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    EXPECT_TRUE(WriteFileAtomically(folder_ / "cube.obj", obj));
  }
  Result<Scene> Load(const std::string& solid) const {
    EXPECT_TRUE(WriteFileAtomically(folder_ / "scene.yaml", SceneWithSolid(solid)));
    return LoadScene(folder_ / "scene.yaml");
  }

  TemporaryFolder folder_;
};

TEST_F(SceneWithMesh, StandsWhereItsPoseSaysInTheUnitOfItsScale) {
  const auto scene =
      Load("{shape: mesh, file: cube.obj, scale: 0.001, position_m: [2, 0, 1], material: grey}");
  ASSERT_TRUE(scene) << scene.error().message;
  const RayCaster caster(std::make_shared<const Scene>(*scene));
  // 10 mm before and above the middle; what lies nearer, the other solid of 1 m, is behind us.
  EXPECT_NEAR(caster.Cast({{1.5f, 0.0f, 1.005f}, {1.0f, 0.0f, 0.0f}}).distance_m, 0.49, 1e-5);
  EXPECT_EQ(caster.Cast({{1.5f, 0.0f, 1.011f}, {1.0f, 0.0f, 0.0f}}).mesh, -1);
}

TEST_F(SceneWithMesh, NamesTheLineOfAMeshThatIsNotThereOrTooLarge) {
  const auto missing = Load("{shape: mesh, file: wheel.stl, material: grey}");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message,
              testing::AllOf(HasSubstr("scene.yaml:7"), HasSubstr("wheel.stl")));
  const auto large = Load("{shape: mesh, file: cube.obj, scale: 500, material: grey}");
  ASSERT_FALSE(large);
  EXPECT_THAT(large.error().message, HasSubstr("'scale'"));
}

TEST(SceneFile, WhatComesFromNoFileHasNoMeshBesideIt) {
  EXPECT_THAT(ErrorOf(SceneWithSolid("{shape: mesh, file: /etc/passwd, material: grey}")),
              testing::AllOf(HasSubstr("test.yaml:7"), HasSubstr("no file")));
}

TEST(SceneFile, TurnsRollPitchYawAboutFixedAxesInThisOrder) {
  // Roll takes y to z, pitch leaves x in z's plane: [90, 0, 90] takes the box's x to robot y.
  const auto scene = SceneFromYaml(
      SceneWithSolid("{shape: box, size_m: [3, 1, 2], rpy_deg: [90, 0, 90], material: grey}"),
      "test.yaml");
  ASSERT_TRUE(scene.has_value()) << scene.error().message;
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& vertex : scene->meshes.back().vertices) high = high.cwiseMax(vertex);
  EXPECT_LT((high - Eigen::Vector3f(1.0f, 1.5f, 0.5f)).norm(), 1e-5f);
}

}  // namespace
}  // namespace foresight
