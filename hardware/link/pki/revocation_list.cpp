#include "hardware/link/pki/revocation_list.h"

#include "hardware/link/pki/openssl_handles.h"

namespace foresight {
namespace {

using RevokedHandle = std::unique_ptr<X509_REVOKED, FreeBy<X509_REVOKED_free>>;

tl::unexpected<Error> CannotMake() {
  return Fail(ErrorCode::kBadData, "cannot make a revocation list: {}", OpenSslErrors::Last());
}

Result<std::int64_t> NumberOf(X509_CRL& list, std::string_view source) {
  const IntegerHandle number(
      static_cast<ASN1_INTEGER*>(X509_CRL_get_ext_d2i(&list, NID_crl_number, nullptr, nullptr)));
  std::int64_t value = 0;
  if (!number || ASN1_INTEGER_get_int64(&value, number.get()) != 1 || value < 0)
    return Fail(ErrorCode::kBadData, "{}: the revocation list has no number", source);
  return value;
}

bool AddSerial(X509_CRL& list, const std::string& serial, const ASN1_TIME& since) {
  const IntegerHandle number = IntegerFromHex(serial);
  RevokedHandle revoked(X509_REVOKED_new());
  if (!number || !revoked || X509_REVOKED_set_serialNumber(revoked.get(), number.get()) != 1 ||
      X509_REVOKED_set_revocationDate(revoked.get(), const_cast<ASN1_TIME*>(&since)) != 1 ||
      X509_CRL_add0_revoked(&list, revoked.get()) != 1)
    return false;
  (void)revoked.release();
  return true;
}

bool AddExtensions(X509_CRL& list, X509& issuer, std::int64_t number) {
  const IntegerHandle value(ASN1_INTEGER_new());
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &issuer, nullptr, nullptr, &list, 0);
  X509_EXTENSION* key =
      X509V3_EXT_conf_nid(nullptr, &context, NID_authority_key_identifier, "keyid:always");
  const bool added = value && ASN1_INTEGER_set_int64(value.get(), number) == 1 && key != nullptr &&
                     X509_CRL_add_ext(&list, key, -1) == 1 &&
                     X509_CRL_add1_ext_i2d(&list, NID_crl_number, value.get(), 0, 0) == 1;
  X509_EXTENSION_free(key);
  return added;
}

}  // namespace

Result<RevocationList> ReadRevocationList(std::string_view pem, std::string_view ca_pem,
                                          std::string_view source) {
  const OpenSslErrors errors;
  const CertificateHandle ca = CertificateFromPem(ca_pem);
  const CrlHandle list = CrlFromPem(pem);
  if (!ca || !list)
    return Fail(ErrorCode::kBadData, "{}: holds no revocation list (PEM): {}", source,
                OpenSslErrors::Last());
  if (X509_NAME_cmp(X509_CRL_get_issuer(list.get()), X509_get_subject_name(ca.get())) != 0 ||
      X509_CRL_verify(list.get(), X509_get0_pubkey(ca.get())) != 1)
    return Fail(ErrorCode::kBadData, "{}: the revocation list was not signed by this CA", source);
  RevocationList result;
  FORESIGHT_TRY(result.number, NumberOf(*list, source));
  const auto from = UtcSeconds(X509_CRL_get0_lastUpdate(list.get()));
  const auto due = UtcSeconds(X509_CRL_get0_nextUpdate(list.get()));
  if (!from || !due)
    return Fail(ErrorCode::kBadData, "{}: the list's dates cannot be read", source);
  result.from_utc_s = *from;
  result.due_utc_s = *due;
  const STACK_OF(X509_REVOKED)* revoked = X509_CRL_get_REVOKED(list.get());
  for (int i = 0; i < sk_X509_REVOKED_num(revoked); ++i)
    result.serials.insert(
        ToHex(*X509_REVOKED_get0_serialNumber(sk_X509_REVOKED_value(revoked, i))));
  return result;
}

Result<std::string> SignRevocationList(const RevocationList& list, const KeyPair& ca) {
  const OpenSslErrors errors;
  constexpr long kVersion2 = 1;
  const CertificateHandle issuer = CertificateFromPem(ca.certificate_pem);
  const KeyHandle key = PrivateKeyFromPem(ca.private_key_pem);
  const CrlHandle crl(X509_CRL_new());
  const TimeHandle from = TimeFromUtcSeconds(list.from_utc_s);
  const TimeHandle due = TimeFromUtcSeconds(list.due_utc_s);
  if (!issuer || !key || !crl || !from || !due || X509_CRL_set_version(crl.get(), kVersion2) != 1 ||
      X509_CRL_set_issuer_name(crl.get(), X509_get_subject_name(issuer.get())) != 1 ||
      X509_CRL_set1_lastUpdate(crl.get(), from.get()) != 1 ||
      X509_CRL_set1_nextUpdate(crl.get(), due.get()) != 1)
    return CannotMake();
  for (const std::string& serial : list.serials)
    if (!AddSerial(*crl, serial, *from)) return CannotMake();
  if (!AddExtensions(*crl, *issuer, list.number) || X509_CRL_sort(crl.get()) != 1 ||
      X509_CRL_sign(crl.get(), key.get(), EVP_sha256()) == 0)
    return CannotMake();
  return ToPem(*crl);
}

}  // namespace foresight
