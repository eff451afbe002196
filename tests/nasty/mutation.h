#pragma once

#include <string>

#include "core/base/random.h"

namespace foresight::nasty {

/// The file with one to four faults: cut, bits flipped, pieces missing or twice, bytes from
/// nowhere.
std::string MutatedBytes(const std::string& bytes, Random& random);

/// The same for files that people write: a number that is NaN, infinite or absurd, a word that is
/// another, a line missing or twice, a byte that is no UTF-8, lists without end.
std::string MutatedText(const std::string& text, Random& random);

}  // namespace foresight::nasty
