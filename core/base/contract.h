#pragma once

#include <stdexcept>
#include <string>

namespace foresight {

/// Thrown where our own code broke a promise. Never abort(): a motor may be turning.
class ContractViolation : public std::logic_error {
 public:
  ContractViolation(const char* condition, const std::string& why, const char* file, int line);
};

}  // namespace foresight

/// A precondition that a caller of ours must have ensured.
#define FORESIGHT_EXPECTS(condition, why)                                                          \
  do {                                                                                             \
    if (!(condition)) throw ::foresight::ContractViolation(#condition, (why), __FILE__, __LINE__); \
  } while (false)
