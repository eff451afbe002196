#include "core/io/json_numbers.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace foresight {

nlohmann::ordered_json FiniteOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace foresight
