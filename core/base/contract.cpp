#include "core/base/contract.h"

#include <fmt/format.h>

namespace foresight {

ContractViolation::ContractViolation(const char* condition, const std::string& why,
                                     const char* file, int line)
    : std::logic_error(fmt::format("{}:{}: expected {}: {}", file, line, condition, why)) {}

}  // namespace foresight
