#include "hardware/link/burst/sealed_datagram.h"

#include <algorithm>
#include <array>

#include "hardware/link/pki/openssl_handles.h"

namespace foresight {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic = {'F', 'S', 'B', '1'};
constexpr std::size_t kNumberAt = 8;
constexpr std::size_t kNonceBytes = 12;

using Nonce = std::array<std::uint8_t, kNonceBytes>;

template <class Number>
void Put(Number number, std::uint8_t* to) {
  for (std::size_t i = 0; i < sizeof number; ++i)
    to[i] = static_cast<std::uint8_t>(number >> (8 * i));
}

template <class Number>
Number Get(const std::uint8_t* from) {
  Number number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i) number |= static_cast<Number>(from[i]) << (8 * i);
  return number;
}

/// The number, behind zeros: there is one sender a key.
Nonce NonceOf(std::uint64_t number) {
  Nonce nonce{};
  Put(number, nonce.data() + kNonceBytes - sizeof number);
  return nonce;
}

Result<CipherContext> MakeContext(const BurstKey& key, bool seals) {
  const OpenSslErrors errors;
  CipherContext context(EVP_CIPHER_CTX_new());
  if (!context || EVP_CipherInit_ex(context.get(), EVP_aes_256_gcm(), nullptr, key.secret.data(),
                                    nullptr, seals ? 1 : 0) != 1)
    return Fail(ErrorCode::kDevice, "burst path: OpenSSL gives no AES-256-GCM: {}",
                OpenSslErrors::Last());
  return context;
}

}  // namespace

void FreeCipher::operator()(evp_cipher_ctx_st* context) const {
  EVP_CIPHER_CTX_free(context);
}

Result<DatagramSealer> DatagramSealer::Make(const BurstKey& key) {
  FORESIGHT_TRY(CipherContext context, MakeContext(key, true));
  return DatagramSealer(key, std::move(context));
}

Status DatagramSealer::Seal(std::span<const std::uint8_t> content,
                            std::vector<std::uint8_t>& sealed) {
  if (number_ >= kMostDatagrams)
    return Fail(ErrorCode::kState, "burst path: key {:08x} is used up: open the path anew",
                key_id_);
  const OpenSslErrors errors;
  sealed.resize(content.size() + kDatagramSealBytes);
  std::copy(kMagic.begin(), kMagic.end(), sealed.begin());
  Put(key_id_, sealed.data() + kMagic.size());
  Put(number_, sealed.data() + kNumberAt);
  const Nonce nonce = NonceOf(number_++);
  int size = 0;
  const bool good =
      EVP_EncryptInit_ex(context_.get(), nullptr, nullptr, nullptr, nonce.data()) == 1 &&
      EVP_EncryptUpdate(context_.get(), nullptr, &size, sealed.data(), kDatagramHeadBytes) == 1 &&
      EVP_EncryptUpdate(context_.get(), sealed.data() + kDatagramHeadBytes, &size, content.data(),
                        static_cast<int>(content.size())) == 1 &&
      EVP_EncryptFinal_ex(context_.get(), sealed.data() + sealed.size(), &size) == 1 &&
      EVP_CIPHER_CTX_ctrl(context_.get(), EVP_CTRL_GCM_GET_TAG, kDatagramTagBytes,
                          sealed.data() + sealed.size() - kDatagramTagBytes) == 1;
  if (good) return {};
  return Fail(ErrorCode::kDevice, "burst path: a datagram was not sealed: {}",
              OpenSslErrors::Last());
}

Result<DatagramOpener> DatagramOpener::Make(const BurstKey& key) {
  FORESIGHT_TRY(CipherContext context, MakeContext(key, false));
  return DatagramOpener(key, std::move(context));
}

DatagramVerdict DatagramOpener::Open(std::span<const std::uint8_t> datagram,
                                     std::vector<std::uint8_t>& content) {
  if (datagram.size() < kDatagramSealBytes || datagram.size() > kMostDatagramBytes ||
      !std::equal(kMagic.begin(), kMagic.end(), datagram.begin()))
    return DatagramVerdict::kNoDatagram;
  if (Get<std::uint32_t>(datagram.data() + kMagic.size()) != key_id_)
    return DatagramVerdict::kForeignKey;
  const auto number = Get<std::uint64_t>(datagram.data() + kNumberAt);
  // A number of a forged datagram must not move the window: it is used below, when the tag is good.
  if (!window_.IsNew(number)) return DatagramVerdict::kReplayed;
  if (number >= DatagramSealer::kMostDatagrams) return DatagramVerdict::kForged;
  const OpenSslErrors errors;
  const std::size_t content_bytes = datagram.size() - kDatagramSealBytes;
  std::array<std::uint8_t, kDatagramTagBytes> tag{};
  std::copy(datagram.end() - kDatagramTagBytes, datagram.end(), tag.begin());
  const Nonce nonce = NonceOf(number);
  content.resize(content_bytes + 1);  // never of no bytes: OpenSSL takes null for "authenticate"
  int size = 0;
  const bool good =
      EVP_DecryptInit_ex(context_.get(), nullptr, nullptr, nullptr, nonce.data()) == 1 &&
      EVP_DecryptUpdate(context_.get(), nullptr, &size, datagram.data(), kDatagramHeadBytes) == 1 &&
      EVP_DecryptUpdate(context_.get(), content.data(), &size, datagram.data() + kDatagramHeadBytes,
                        static_cast<int>(content_bytes)) == 1 &&
      EVP_CIPHER_CTX_ctrl(context_.get(), EVP_CTRL_GCM_SET_TAG, kDatagramTagBytes, tag.data()) ==
          1 &&
      EVP_DecryptFinal_ex(context_.get(), content.data() + content_bytes, &size) == 1;
  content.resize(good ? content_bytes : 0);
  if (!good) return DatagramVerdict::kForged;
  window_.Use(number);
  return DatagramVerdict::kGood;
}

}  // namespace foresight
