#include "hardware/link/pki/random_bytes.h"

#include <openssl/rand.h>

#include "hardware/link/pki/openssl_handles.h"

namespace foresight {
namespace {

Status Checked(int made) {
  if (made == 1) return {};
  return Fail(ErrorCode::kDevice, "no random numbers: {}", OpenSslErrors::Last());
}

}  // namespace

Status FillRandom(std::span<std::uint8_t> bytes) {
  const OpenSslErrors errors;
  return Checked(RAND_bytes(bytes.data(), static_cast<int>(bytes.size())));
}

Status FillSecret(std::span<std::uint8_t> bytes) {
  const OpenSslErrors errors;
  return Checked(RAND_priv_bytes(bytes.data(), static_cast<int>(bytes.size())));
}

}  // namespace foresight
