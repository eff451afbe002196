#include "hardware/link/pki/certificate.h"

#include <openssl/x509_vfy.h>

#include <array>
#include <chrono>
#include <optional>

#include "hardware/link/pki/openssl_handles.h"

namespace foresight {
namespace {

using StoreHandle = std::unique_ptr<X509_STORE, FreeBy<X509_STORE_free>>;
using StoreContextHandle = std::unique_ptr<X509_STORE_CTX, FreeBy<X509_STORE_CTX_free>>;
using UsageHandle = std::unique_ptr<EXTENDED_KEY_USAGE, FreeBy<EXTENDED_KEY_USAGE_free>>;

std::string_view TextOf(const ASN1_STRING& text) {
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(&text)),
          static_cast<std::size_t>(ASN1_STRING_length(&text))};
}

/// "10.0.0.2" or "fd00:0:0:0:0:0:0:2"; empty for neither length.
std::string IpText(std::string_view bytes) {
  std::string text;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (bytes.size() == 4)
    for (std::size_t i = 0; i < 4; ++i) text += fmt::format("{}{}", i == 0 ? "" : ".", byte(i));
  if (bytes.size() == 16)
    for (std::size_t i = 0; i < 16; i += 2)
      text += fmt::format("{}{:x}", i == 0 ? "" : ":", 256 * byte(i) + byte(i + 1));
  return text;
}

struct AlternativeNames {
  std::vector<std::string> uris;
  std::vector<std::string> addresses;
};

AlternativeNames NamesOf(const X509& certificate) {
  AlternativeNames names;
  const NamesHandle list(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr)));
  for (int i = 0; i < sk_GENERAL_NAME_num(list.get()); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(list.get(), i);
    if (name->type == GEN_URI)
      names.uris.emplace_back(TextOf(*name->d.uniformResourceIdentifier));
    else if (name->type == GEN_DNS)
      names.addresses.emplace_back(TextOf(*name->d.dNSName));
    else if (name->type == GEN_IPADD)
      names.addresses.push_back(IpText(TextOf(*name->d.iPAddress)));
  }
  return names;
}

/// The only use that the certificate names; NID_undef where it names none or several.
int OnlyUseOf(const X509& certificate) {
  const UsageHandle uses(static_cast<EXTENDED_KEY_USAGE*>(
      X509_get_ext_d2i(&certificate, NID_ext_key_usage, nullptr, nullptr)));
  if (sk_ASN1_OBJECT_num(uses.get()) != 1) return NID_undef;
  return OBJ_obj2nid(sk_ASN1_OBJECT_value(uses.get(), 0));
}

Result<LinkIdentity> IdentityOf(const std::vector<std::string>& uris, std::string_view source) {
  const auto identity = uris.size() == 1 ? LinkIdentity::FromUri(uris.front()) : std::nullopt;
  if (!identity)
    return Fail(ErrorCode::kBadData,
                "{}: the certificate does not say who on the link it is of (a URI such as "
                "foresight:operator:anna)",
                source);
  return *identity;
}

Result<Validity> ValidityOf(const X509& certificate, std::string_view source) {
  const auto from = UtcSeconds(X509_get0_notBefore(&certificate));
  const auto to = UtcSeconds(X509_get0_notAfter(&certificate));
  if (!from || !to) return Fail(ErrorCode::kBadData, "{}: its dates cannot be read", source);
  return Validity{*from, *to};
}

tl::unexpected<Error> NoCertificate(std::string_view source) {
  return Fail(ErrorCode::kBadData, "{}: holds no certificate (PEM): {}", source,
              OpenSslErrors::Last());
}

/// What is wrong at that time, in words with the dates where they are the reason.
std::string ReasonOf(int error, const X509& certificate) {
  const auto validity = ValidityOf(certificate, "");
  if (error == X509_V_ERR_CERT_HAS_EXPIRED && validity)
    return fmt::format("expired on {}", DateText(validity->to_utc_s));
  if (error == X509_V_ERR_CERT_NOT_YET_VALID && validity)
    return fmt::format("not valid before {}; is this machine's clock right?",
                       DateText(validity->from_utc_s));
  if (error == X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY ||
      error == X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT)
    return "signed by another CA";
  return X509_verify_cert_error_string(error);
}

}  // namespace

Result<LinkCertificate> ReadLinkCertificate(std::string_view pem, std::string_view source) {
  const OpenSslErrors errors;
  const CertificateHandle certificate = CertificateFromPem(pem);
  if (!certificate) return NoCertificate(source);
  AlternativeNames names = NamesOf(*certificate);
  LinkCertificate result;
  FORESIGHT_TRY(result.identity, IdentityOf(names.uris, source));
  const bool head = result.identity.role == LinkRole::kHead;
  if (OnlyUseOf(*certificate) != (head ? NID_server_auth : NID_client_auth))
    return Fail(ErrorCode::kBadData, "{}: the certificate of {} is not one for a {}", source,
                result.identity.ToUri(), head ? "server" : "client");
  FORESIGHT_TRY(const Validity validity, ValidityOf(*certificate, source));
  EVP_PKEY* key = X509_get0_pubkey(certificate.get());
  if (key == nullptr)
    return Fail(ErrorCode::kBadData, "{}: its public key cannot be read: {}", source,
                OpenSslErrors::Last());
  result.addresses = std::move(names.addresses);
  result.serial = ToHex(*X509_get0_serialNumber(certificate.get()));
  result.from_utc_s = validity.from_utc_s;
  result.to_utc_s = validity.to_utc_s;
  result.public_key_pem = PublicKeyToPem(*key);
  return result;
}

Status CheckSignedBy(std::string_view ca_pem, std::string_view pem, LinkRole role,
                     std::int64_t utc_s, std::string_view source) {
  const OpenSslErrors errors;
  const CertificateHandle ca = CertificateFromPem(ca_pem);
  const CertificateHandle certificate = CertificateFromPem(pem);
  if (!ca || !certificate) return NoCertificate(source);
  const StoreHandle store(X509_STORE_new());
  const StoreContextHandle context(X509_STORE_CTX_new());
  if (!store || !context || X509_STORE_add_cert(store.get(), ca.get()) != 1 ||
      X509_STORE_CTX_init(context.get(), store.get(), certificate.get(), nullptr) != 1)
    return Fail(ErrorCode::kBadData, "{}: cannot be verified: {}", source, OpenSslErrors::Last());
  X509_VERIFY_PARAM* parameters = X509_STORE_CTX_get0_param(context.get());
  X509_VERIFY_PARAM_set_time(parameters, static_cast<std::time_t>(utc_s));
  X509_VERIFY_PARAM_set_purpose(
      parameters, role == LinkRole::kHead ? X509_PURPOSE_SSL_SERVER : X509_PURPOSE_SSL_CLIENT);
  if (X509_verify_cert(context.get()) == 1) return {};
  return Fail(ErrorCode::kBadData, "{}: {}", source,
              ReasonOf(X509_STORE_CTX_get_error(context.get()), *certificate));
}

Result<Validity> ReadCaCertificate(std::string_view pem, std::string_view source) {
  const OpenSslErrors errors;
  const CertificateHandle certificate = CertificateFromPem(pem);
  if (!certificate) return NoCertificate(source);
  if (X509_check_ca(certificate.get()) != 1 ||
      X509_verify(certificate.get(), X509_get0_pubkey(certificate.get())) != 1)
    return Fail(ErrorCode::kBadData, "{}: is not the certificate of a CA that signed itself",
                source);
  return ValidityOf(*certificate, source);
}

Status CheckKeyFits(std::string_view certificate_pem, std::string_view private_key_pem,
                    std::string_view source) {
  const OpenSslErrors errors;
  const CertificateHandle certificate = CertificateFromPem(certificate_pem);
  const KeyHandle key = PrivateKeyFromPem(private_key_pem);
  if (!key)
    return Fail(ErrorCode::kBadData, "{}: holds no private key without a passphrase (PEM): {}",
                source, OpenSslErrors::Last());
  if (!certificate || X509_check_private_key(certificate.get(), key.get()) != 1)
    return Fail(ErrorCode::kBadData, "{}: is not the key of the certificate beside it", source);
  return {};
}

std::string DateText(std::int64_t utc_s) {
  // A certificate may be dated to the year 9999, which a count of nanoseconds does not reach.
  const std::chrono::year_month_day date(
      std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(utc_s))));
  return fmt::format("{:04}-{:02}-{:02}", int{date.year()}, unsigned{date.month()},
                     unsigned{date.day()});
}

std::int64_t UtcSecondsNow() {
  return std::chrono::duration_cast<std::chrono::seconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace foresight
