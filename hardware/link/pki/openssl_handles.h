#pragma once

// OpenSSL's objects with owners, for the .cpp files of this folder.
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

template <auto function>
struct FreeBy {
  template <class T>
  void operator()(T* object) const {
    function(object);
  }
};

using BigNumberHandle = std::unique_ptr<BIGNUM, FreeBy<BN_free>>;
using BioHandle = std::unique_ptr<BIO, FreeBy<BIO_free>>;
using CertificateHandle = std::unique_ptr<X509, FreeBy<X509_free>>;
using CrlHandle = std::unique_ptr<X509_CRL, FreeBy<X509_CRL_free>>;
using KeyHandle = std::unique_ptr<EVP_PKEY, FreeBy<EVP_PKEY_free>>;
using IntegerHandle = std::unique_ptr<ASN1_INTEGER, FreeBy<ASN1_INTEGER_free>>;
using TimeHandle = std::unique_ptr<ASN1_TIME, FreeBy<ASN1_TIME_free>>;
using NamesHandle = std::unique_ptr<GENERAL_NAMES, FreeBy<GENERAL_NAMES_free>>;

/// Errors that OpenSSL notes on this thread while this exists are gone with it: gRPC uses OpenSSL
/// on the same threads and takes a note of ours for one of its own.
class OpenSslErrors {
 public:
  OpenSslErrors() { ERR_set_mark(); }
  ~OpenSslErrors() { ERR_pop_to_mark(); }
  OpenSslErrors(const OpenSslErrors&) = delete;
  OpenSslErrors& operator=(const OpenSslErrors&) = delete;

  /// The reason of the last one.
  static std::string Last();
};

/// The first of its kind in the text; null where there is none.
CertificateHandle CertificateFromPem(std::string_view pem);
CrlHandle CrlFromPem(std::string_view pem);
/// A key that is encrypted is none: nobody is asked for its passphrase.
KeyHandle PrivateKeyFromPem(std::string_view pem);
KeyHandle PublicKeyFromPem(std::string_view pem);

std::string ToPem(X509& certificate);
std::string ToPem(X509_CRL& list);
std::string PrivateKeyToPem(EVP_PKEY& key);
std::string PublicKeyToPem(EVP_PKEY& key);

/// Seconds since 1970. Fails with kBadData.
Result<std::int64_t> UtcSeconds(const ASN1_TIME* time);
TimeHandle TimeFromUtcSeconds(std::int64_t utc_s);

/// Upper-case hexadecimal digits, as `openssl x509 -serial` prints them.
std::string ToHex(const ASN1_INTEGER& number);
IntegerHandle IntegerFromHex(const std::string& hex);

}  // namespace foresight
