#pragma once

#include <string>
#include <string_view>

#include "hardware/link/pki/certificate.h"

namespace foresight {

/// A certificate and its private key, both as PEM.
struct KeyPair {
  std::string certificate_pem;
  std::string private_key_pem;
};

/// A new private key on the curve P-256, as PEM (PKCS #8).
Result<std::string> MakePrivateKey();
Result<std::string> PublicKeyOf(std::string_view private_key_pem);

/// A new CA: its key, and its certificate that it signed itself.
Result<KeyPair> MakeCa(const Validity& validity);

/// What a certificate is to say.
struct CertificateRequest {
  LinkIdentity identity;
  std::vector<std::string> addresses;  ///< of a head: IP addresses and host names; empty for others
  Validity validity;
  std::string public_key_pem;
};

/// Signs a certificate with a random serial number. A head's is for servers only and has its stable
/// host name and its addresses; the others' are for clients only. Dates are not judged here. Fails
/// with kInvalidOptions for names and addresses that are none, with kBadData for keys.
Result<std::string> SignCertificate(const CertificateRequest& request, const KeyPair& ca);

}  // namespace foresight
