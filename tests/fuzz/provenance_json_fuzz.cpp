// What a fit on the head is to be made of, and what a mission says of one.
#include <cstdint>
#include <string>

#include "core/mission/provenance.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string json(reinterpret_cast<const char*>(bytes), size);
  const auto provenance = ProvenanceFromJson(json, "fuzz");
  if (!provenance) {
    Require(!provenance.error().message.empty(), "an error says what");
    return 0;
  }
  const auto again = ProvenanceFromJson(ProvenanceToJson(*provenance), "fuzz");
  Require(again.has_value(), "what was read can be written and read again");
  Require(ProvenanceToJson(*again) == ProvenanceToJson(*provenance), "and is the same");
  return 0;
}
