#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hardware/link/chunks/item_bytes.h"

namespace foresight {

using ValueSpans = std::vector<std::span<const std::uint16_t>>;
using ValueRows = std::vector<std::vector<std::uint16_t>>;

/// Rows of values, of the same length or not, as differences from what GridPredictor expects: their
/// noisy low bits as they are, low and high bytes of the rest compressed.
void AppendValueGrid(ItemWriter& writer, const ValueSpans& rows, int smooth);
/// The reader has failed where the bytes are no such rows. @pre the sizes are bounded by the caller
ValueRows ReadValueGrid(ItemReader& reader, const std::vector<std::size_t>& sizes, int smooth);

}  // namespace foresight
