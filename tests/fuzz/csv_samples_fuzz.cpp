// CSV of samples, and their way into the pipeline.
#include <cmath>
#include <cstdint>

#include "core/depth/imported_samples.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto rows = ParseCsvSamples({reinterpret_cast<const char*>(bytes), size}, "fuzz.csv");
  if (!rows) {
    Require(!rows.error().message.empty(), "an error has a message");
    return 0;
  }
  for (const CsvSample& row : *rows)
    Require(row.line >= 0 && row.beam >= 0 && std::isfinite(row.u) && std::isfinite(row.v) &&
                std::isfinite(row.depth_mm) && row.depth_mm >= 0.0,
            "a row that was accepted holds numbers");
  // A grid of the 100 million places that are allowed takes longer to make than all the rest.
  for (const CsvSample& row : *rows)
    if (row.line > 1000 || row.beam > 1000) return 0;
  int outside = 0;
  (void)ImportSamples(*rows, 64, 48, nullptr, "fuzz.csv", &outside);
  return 0;
}
