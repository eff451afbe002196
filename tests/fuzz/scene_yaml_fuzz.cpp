// Scenes of the simulation.
#include <cstdint>
#include <string>

#include "core/simulation/scene.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto scene = SceneFromYaml({reinterpret_cast<const char*>(bytes), size}, "fuzz.yaml");
  if (!scene) return 0;
  for (const SceneMesh& mesh : scene->meshes) {
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      Require(vertex.allFinite(), "a scene that was accepted has its corners somewhere");
    for (const Eigen::Vector3i& triangle : mesh.triangles)
      Require(
          triangle.minCoeff() >= 0 && triangle.maxCoeff() < static_cast<int>(mesh.vertices.size()),
          "triangles have corners");
  }
  return 0;
}
