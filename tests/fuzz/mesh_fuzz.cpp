// Triangle meshes: PLY, OBJ and STL.
#include <cstdint>
#include <string_view>

#include "core/io/triangle_mesh.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string_view file(reinterpret_cast<const char*>(bytes), size);
  for (const auto& mesh :
       {DecodePlyMesh(file, "fuzz"), DecodeObj(file, "fuzz"), DecodeStl(file, "fuzz")}) {
    if (mesh) {
      Require(mesh->Check("fuzz").has_value(), "what was read is a mesh");
      Require(mesh->triangles.size() <= size, "every triangle comes from the file");
      continue;
    }
    Require(mesh.error().code == ErrorCode::kBadData, "damaged bytes are bad data");
    Require(mesh.error().message.starts_with("fuzz"), "an error names the file");
  }
  return 0;
}
