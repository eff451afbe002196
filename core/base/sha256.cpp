#include "core/base/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include "core/base/contract.h"

namespace foresight {

struct Sha256::Impl {
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context{EVP_MD_CTX_new()};
  bool ended = false;
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) {
  const int begun = EVP_DigestInit_ex(impl_->context.get(), EVP_sha256(), nullptr);
  FORESIGHT_EXPECTS(begun == 1, "libcrypto has SHA-256");
}

Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

Sha256& Sha256::Add(std::string_view bytes) {
  FORESIGHT_EXPECTS(!impl_->ended, "nothing is added to a digest that was read");
  EVP_DigestUpdate(impl_->context.get(), bytes.data(), bytes.size());
  return *this;
}

std::string Sha256::Hex() {
  FORESIGHT_EXPECTS(!impl_->ended, "a digest is read once");
  impl_->ended = true;
  unsigned char digest[EVP_MAX_MD_SIZE] = {};
  unsigned int size = 0;
  EVP_DigestFinal_ex(impl_->context.get(), digest, &size);
  std::string hex;
  for (unsigned int i = 0; i < size; ++i)
    fmt::format_to(std::back_inserter(hex), "{:02x}", digest[i]);
  return hex;
}

std::string Sha256Hex(std::string_view bytes) {
  return Sha256().Add(bytes).Hex();
}

}  // namespace foresight
