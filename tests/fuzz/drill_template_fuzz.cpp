// Templates of drills, and the drills that are made of them.
#include <cstdint>
#include <string>

#include "core/objects/drill_template.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto kind =
      DrillTemplateFromYaml({reinterpret_cast<const char*>(bytes), size}, "fuzz.yaml");
  if (!kind) {
    Require(kind.error().message.starts_with("fuzz.yaml:"), "an error names file and line");
    return 0;
  }
  Require(kind->Check().has_value(), "a template that was accepted is usable");
  const DrillModel drill = kind->Make(kind->max_scale, {0.1, -0.1}, kind->max_bit_length_m);
  Require(drill.Check().has_value(), "its drills are usable");
  for (const SolidPart& part : drill.parts)
    for (const auto& line : WireframeOf(part))
      for (const Eigen::Vector3d& point : line)
        Require(point.norm() < 100.0, "its drills are of a hand's size");
  return 0;
}
