#pragma once

#include <nlohmann/json_fwd.hpp>

namespace foresight {

/// A number as JSON has it: null for NaN and infinity, which JSON cannot say.
nlohmann::ordered_json FiniteOrNull(double value);

}  // namespace foresight
