#include "hardware/link/burst/burst_key.h"

#include <openssl/rand.h>

#include <algorithm>

#include "hardware/link/pki/openssl_handles.h"

namespace foresight {

Result<BurstKey> BurstKey::Make() {
  const OpenSslErrors errors;
  BurstKey key;
  std::array<unsigned char, sizeof key.id> id{};
  while (key.id == 0) {
    if (RAND_bytes(id.data(), static_cast<int>(id.size())) != 1 ||
        RAND_priv_bytes(key.secret.data(), static_cast<int>(key.secret.size())) != 1)
      return Fail(ErrorCode::kDevice, "key of a burst path: no random numbers: {}",
                  OpenSslErrors::Last());
    for (const unsigned char byte : id) key.id = key.id << 8 | byte;
  }
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
