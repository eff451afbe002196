#include "hardware/link/pki/openssl_handles.h"

#include <openssl/crypto.h>

#include <climits>
#include <ctime>

namespace foresight {
namespace {

BioHandle Reader(std::string_view text) {
  if (text.size() > INT_MAX) return nullptr;
  return BioHandle(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

int NoPassphrase(char*, int, int, void*) {
  return 0;
}

template <class Write>
std::string PemOf(const Write& write) {
  const BioHandle bio(BIO_new(BIO_s_mem()));
  if (!bio || write(bio.get()) != 1) return "";
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &bytes);
  return size > 0 ? std::string(bytes, static_cast<std::size_t>(size)) : "";
}

template <class Handle, class Read>
Handle FromPem(std::string_view pem, const Read& read) {
  const BioHandle bio = Reader(pem);
  return Handle(bio ? read(bio.get(), nullptr, NoPassphrase, nullptr) : nullptr);
}

}  // namespace

std::string OpenSslErrors::Last() {
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  return reason == nullptr ? "unknown reason" : reason;
}

CertificateHandle CertificateFromPem(std::string_view pem) {
  return FromPem<CertificateHandle>(pem, PEM_read_bio_X509);
}

CrlHandle CrlFromPem(std::string_view pem) {
  return FromPem<CrlHandle>(pem, PEM_read_bio_X509_CRL);
}

KeyHandle PrivateKeyFromPem(std::string_view pem) {
  return FromPem<KeyHandle>(pem, PEM_read_bio_PrivateKey);
}

KeyHandle PublicKeyFromPem(std::string_view pem) {
  return FromPem<KeyHandle>(pem, PEM_read_bio_PUBKEY);
}

std::string ToPem(X509& certificate) {
  return PemOf([&](BIO* bio) { return PEM_write_bio_X509(bio, &certificate); });
}

std::string ToPem(X509_CRL& list) {
  return PemOf([&](BIO* bio) { return PEM_write_bio_X509_CRL(bio, &list); });
}

std::string PrivateKeyToPem(EVP_PKEY& key) {
  return PemOf([&](BIO* bio) {
    return PEM_write_bio_PKCS8PrivateKey(bio, &key, nullptr, nullptr, 0, nullptr, nullptr);
  });
}

std::string PublicKeyToPem(EVP_PKEY& key) {
  return PemOf([&](BIO* bio) { return PEM_write_bio_PUBKEY(bio, &key); });
}

Result<std::int64_t> UtcSeconds(const ASN1_TIME* time) {
  std::tm parts{};
  if (time == nullptr || ASN1_TIME_to_tm(time, &parts) != 1)
    return Fail(ErrorCode::kBadData, "a date in it cannot be read");
  return static_cast<std::int64_t>(timegm(&parts));
}

TimeHandle TimeFromUtcSeconds(std::int64_t utc_s) {
  return TimeHandle(ASN1_TIME_set(nullptr, static_cast<std::time_t>(utc_s)));
}

std::string ToHex(const ASN1_INTEGER& number) {
  const BigNumberHandle big(ASN1_INTEGER_to_BN(&number, nullptr));
  char* text = big ? BN_bn2hex(big.get()) : nullptr;
  if (text == nullptr) return "";
  std::string hex = text;
  OPENSSL_free(text);
  return hex;
}

IntegerHandle IntegerFromHex(const std::string& hex) {
  BIGNUM* number = nullptr;
  const int digits = BN_hex2bn(&number, hex.c_str());
  const BigNumberHandle owner(number);
  if (digits == 0 || static_cast<std::size_t>(digits) != hex.size()) return nullptr;
  return IntegerHandle(BN_to_ASN1_INTEGER(number, nullptr));
}

}  // namespace foresight
