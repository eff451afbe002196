#include "hardware/link/burst/burst_key.h"

#include <algorithm>

#include "hardware/link/pki/random_bytes.h"

namespace foresight {

Result<BurstKey> BurstKey::Make() {
  BurstKey key;
  std::array<std::uint8_t, sizeof key.id> id{};
  while (key.id == 0) {
    FORESIGHT_CHECK(FillRandom(id));
    for (const std::uint8_t byte : id) key.id = key.id << 8 | byte;
  }
  FORESIGHT_CHECK(FillSecret(key.secret));
  return key;
}

Result<BurstKey> BurstKey::FromBytes(std::uint32_t id, std::string_view secret) {
  if (id == 0 || secret.size() != kSecretBytes)
    return Fail(ErrorCode::kBadData, "key {} of a burst path: {} bytes and not {}", id,
                secret.size(), kSecretBytes);
  BurstKey key;
  key.id = id;
  std::copy(secret.begin(), secret.end(), key.secret.begin());
  return key;
}

}  // namespace foresight
