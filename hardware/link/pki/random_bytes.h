#pragma once

#include <cstdint>
#include <span>

#include "core/base/result.h"

namespace foresight {

/// Fills `bytes` with random numbers that may be public, as the number of a key. Fails with kDevice
/// when the system has none.
Status FillRandom(std::span<std::uint8_t> bytes);

/// The same for secrets: out of a generator of their own (RAND_priv_bytes of OpenSSL).
Status FillSecret(std::span<std::uint8_t> bytes);

}  // namespace foresight
