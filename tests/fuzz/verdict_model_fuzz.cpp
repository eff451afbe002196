// Weights of verdicts.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/fitting/verdict_model.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto model =
      VerdictModelFromYaml({reinterpret_cast<const char*>(bytes), size}, "fuzz.yaml");
  if (!model) {
    Require(model.error().message.starts_with("fuzz.yaml:"), "an error names file and line");
    return 0;
  }
  for (const double value : {0.0, -1e308, 1e308}) {
    const std::vector<double> values(model->features.size(), value);
    const double probability = model->Probability(values);
    Require(probability >= 0.0 && probability <= 1.0, "a probability is one");
  }
  return 0;
}
