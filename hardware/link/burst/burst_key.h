#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

/// Of one burst path between a head and a station: made anew by the head each time, and handed over
/// inside TLS.
struct BurstKey {
  static constexpr std::size_t kSecretBytes = 32;

  std::uint32_t id = 0;  ///< stands openly in each datagram; never 0
  std::array<unsigned char, kSecretBytes> secret{};

  /// Of the system's random numbers. Fails with kDevice where they give none.
  static Result<BurstKey> Make();
  /// Of what came over the link. Fails with kBadData.
  static Result<BurstKey> FromBytes(std::uint32_t id, std::string_view secret);
  std::string SecretBytes() const { return {secret.begin(), secret.end()}; }
};

}  // namespace foresight
