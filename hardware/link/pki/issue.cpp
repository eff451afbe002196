#include "hardware/link/pki/issue.h"

#include <openssl/ec.h>
#include <openssl/rand.h>

#include <algorithm>

#include "core/base/printable.h"
#include "hardware/link/pki/openssl_handles.h"

namespace foresight {
namespace {

constexpr int kSerialBits = 127;  // positive, and 16 bytes: RFC 5280 allows 20

tl::unexpected<Error> CannotMake(std::string_view what) {
  return Fail(ErrorCode::kBadData, "cannot make {}: {}", what, OpenSslErrors::Last());
}

bool SetRandomSerial(X509& certificate) {
  const BigNumberHandle number(BN_new());
  return number && BN_rand(number.get(), kSerialBits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
         BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(&certificate)) != nullptr;
}

bool SetValidity(X509& certificate, const Validity& validity) {
  const TimeHandle from = TimeFromUtcSeconds(validity.from_utc_s);
  const TimeHandle to = TimeFromUtcSeconds(validity.to_utc_s);
  return from && to && X509_set1_notBefore(&certificate, from.get()) == 1 &&
         X509_set1_notAfter(&certificate, to.get()) == 1;
}

bool SetSubject(X509& certificate, const std::string& common_name, const std::string& unit) {
  X509_NAME* name = X509_get_subject_name(&certificate);
  const auto add = [&](const char* field, const std::string& text) {
    return X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8,
                                      reinterpret_cast<const unsigned char*>(text.c_str()), -1, -1,
                                      0) == 1;
  };
  return add("O", "Foresight") && add("OU", unit) && add("CN", common_name);
}

bool AddExtension(X509& certificate, X509& issuer, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &issuer, &certificate, nullptr, nullptr, 0);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
  const bool added = extension != nullptr && X509_add_ext(&certificate, extension, -1) == 1;
  X509_EXTENSION_free(extension);
  return added;
}

bool AddName(GENERAL_NAMES& names, int type, ASN1_STRING* value) {
  GENERAL_NAME* name = GENERAL_NAME_new();
  if (name == nullptr || value == nullptr) {
    GENERAL_NAME_free(name);
    ASN1_STRING_free(value);
    return false;
  }
  GENERAL_NAME_set0_value(name, type, value);
  if (sk_GENERAL_NAME_push(&names, name) > 0) return true;
  GENERAL_NAME_free(name);
  return false;
}

ASN1_IA5STRING* NewText(const std::string& text) {
  ASN1_IA5STRING* string = ASN1_IA5STRING_new();
  if (string != nullptr) ASN1_STRING_set(string, text.data(), static_cast<int>(text.size()));
  return string;
}

bool IsHostName(std::string_view text) {
  constexpr std::size_t kLongest = 253;
  const auto in_host = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.';
  };
  return !text.empty() && text.size() <= kLongest &&
         std::all_of(text.begin(), text.end(), in_host) &&
         text.find("..") == std::string_view::npos && text.front() != '.' && text.front() != '-' &&
         text.back() != '-' && text.back() != '.';
}

/// Only digits and dots, yet no IP address: 10.0.0.256.
bool LooksLikeIp(std::string_view text) {
  return text.find_first_not_of("0123456789.") == std::string_view::npos;
}

Status AddAddress(GENERAL_NAMES& names, const std::string& address) {
  if (ASN1_OCTET_STRING* ip = a2i_IPADDRESS(address.c_str())) {
    if (AddName(names, GEN_IPADD, ip)) return {};
    return CannotMake("the list of addresses");
  }
  if (!IsHostName(address) || LooksLikeIp(address))
    return Fail(ErrorCode::kInvalidOptions,
                "address {}: is neither an IP address nor a host name (no port, no brackets)",
                Printable(address));
  if (AddName(names, GEN_DNS, NewText(address))) return {};
  return CannotMake("the list of addresses");
}

Status AddAlternativeNames(X509& certificate, const CertificateRequest& request) {
  const NamesHandle names(GENERAL_NAMES_new());
  if (!names || !AddName(*names, GEN_URI, NewText(request.identity.ToUri())))
    return CannotMake("the list of names");
  if (request.identity.role == LinkRole::kHead)
    FORESIGHT_CHECK(AddAddress(*names, StableHostOfHead(request.identity.name)));
  for (const std::string& address : request.addresses) FORESIGHT_CHECK(AddAddress(*names, address));
  if (X509_add1_ext_i2d(&certificate, NID_subject_alt_name, names.get(), 0, 0) == 1) return {};
  return CannotMake("the list of names");
}

Result<CertificateHandle> NewCertificate(const Validity& validity, EVP_PKEY& public_key) {
  constexpr long kVersion3 = 2;
  CertificateHandle certificate(X509_new());
  if (!certificate || X509_set_version(certificate.get(), kVersion3) != 1 ||
      !SetRandomSerial(*certificate) || !SetValidity(*certificate, validity) ||
      X509_set_pubkey(certificate.get(), &public_key) != 1)
    return CannotMake("a certificate");
  return certificate;
}

Result<std::string> Sign(X509& certificate, EVP_PKEY& key) {
  if (X509_sign(&certificate, &key, EVP_sha256()) == 0) return CannotMake("a signature");
  return ToPem(certificate);
}

/// People tell CAs apart by a part of a random number: nothing else differs between two of them.
std::string RandomCaName() {
  unsigned char bytes[4] = {};
  RAND_bytes(bytes, sizeof bytes);
  return fmt::format("Foresight link {:02x}{:02x}{:02x}{:02x}", bytes[0], bytes[1], bytes[2],
                     bytes[3]);
}

}  // namespace

Result<std::string> MakePrivateKey() {
  const OpenSslErrors errors;
  const KeyHandle key(EVP_EC_gen("P-256"));
  if (!key) return CannotMake("a key");
  return PrivateKeyToPem(*key);
}

Result<std::string> PublicKeyOf(std::string_view private_key_pem) {
  const OpenSslErrors errors;
  const KeyHandle key = PrivateKeyFromPem(private_key_pem);
  if (!key)
    return Fail(ErrorCode::kBadData, "no private key without a passphrase (PEM): {}",
                OpenSslErrors::Last());
  return PublicKeyToPem(*key);
}

Result<KeyPair> MakeCa(const Validity& validity) {
  const OpenSslErrors errors;
  const KeyHandle key(EVP_EC_gen("P-256"));
  if (!key) return CannotMake("a key");
  FORESIGHT_TRY(const CertificateHandle ca, NewCertificate(validity, *key));
  if (!SetSubject(*ca, RandomCaName(), "CA") ||
      X509_set_issuer_name(ca.get(), X509_get_subject_name(ca.get())) != 1 ||
      !AddExtension(*ca, *ca, NID_basic_constraints, "critical,CA:TRUE,pathlen:0") ||
      !AddExtension(*ca, *ca, NID_key_usage, "critical,keyCertSign,cRLSign") ||
      !AddExtension(*ca, *ca, NID_subject_key_identifier, "hash"))
    return CannotMake("the certificate of a CA");
  FORESIGHT_TRY(std::string pem, Sign(*ca, *key));
  return KeyPair{std::move(pem), PrivateKeyToPem(*key)};
}

Result<std::string> SignCertificate(const CertificateRequest& request, const KeyPair& ca) {
  const OpenSslErrors errors;
  FORESIGHT_CHECK(CheckLinkName(request.identity.role, request.identity.name));
  const CertificateHandle issuer = CertificateFromPem(ca.certificate_pem);
  const KeyHandle issuer_key = PrivateKeyFromPem(ca.private_key_pem);
  const KeyHandle subject_key = PublicKeyFromPem(request.public_key_pem);
  if (!issuer || !issuer_key || !subject_key) return CannotMake("a certificate of these keys");
  FORESIGHT_TRY(const CertificateHandle certificate,
                NewCertificate(request.validity, *subject_key));
  const bool head = request.identity.role == LinkRole::kHead;
  if (!SetSubject(*certificate, request.identity.name, ToString(request.identity.role)) ||
      X509_set_issuer_name(certificate.get(), X509_get_subject_name(issuer.get())) != 1 ||
      !AddExtension(*certificate, *issuer, NID_basic_constraints, "critical,CA:FALSE") ||
      !AddExtension(*certificate, *issuer, NID_key_usage, "critical,digitalSignature") ||
      !AddExtension(*certificate, *issuer, NID_ext_key_usage,
                    head ? "critical,serverAuth" : "critical,clientAuth") ||
      !AddExtension(*certificate, *issuer, NID_subject_key_identifier, "hash") ||
      !AddExtension(*certificate, *issuer, NID_authority_key_identifier, "keyid:always"))
    return CannotMake("a certificate");
  FORESIGHT_CHECK(AddAlternativeNames(*certificate, request));
  return Sign(*certificate, *issuer_key);
}

}  // namespace foresight
