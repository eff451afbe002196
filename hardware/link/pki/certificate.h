#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hardware/link/pki/link_role.h"

namespace foresight {

/// What a certificate of the link says of its owner.
struct LinkCertificate {
  LinkIdentity identity;
  std::vector<std::string>
      addresses;       ///< of a head: host names and IP addresses, the stable one first
  std::string serial;  ///< hexadecimal
  std::int64_t from_utc_s = 0;
  std::int64_t to_utc_s = 0;
  std::string public_key_pem;
};

/// Reads what CertificateAuthority writes; whether the CA signed it is CheckSignedBy's question.
/// @param source what errors call it, e.g. its file.
/// Fails with kBadData, also for a certificate that says no role, several, or one that its extended
/// key usage does not go with.
Result<LinkCertificate> ReadLinkCertificate(std::string_view pem, std::string_view source);

/// Whether the CA signed the certificate for this use (a head's for a server, the others' for a
/// client) and its dates hold at `utc_s`. Fails with kBadData; what was revoked is not known here.
Status CheckSignedBy(std::string_view ca_pem, std::string_view pem, LinkRole role,
                     std::int64_t utc_s, std::string_view source);

/// The dates between which the certificate of a CA holds. Fails with kBadData, also where it is no
/// CA.
struct Validity {
  std::int64_t from_utc_s = 0;
  std::int64_t to_utc_s = 0;
};
Result<Validity> ReadCaCertificate(std::string_view pem, std::string_view source);

/// Fails with kBadData where the private key is damaged, encrypted, or that of another certificate.
Status CheckKeyFits(std::string_view certificate_pem, std::string_view private_key_pem,
                    std::string_view source);

/// "2028-11-22" of seconds since 1970.
std::string DateText(std::int64_t utc_s);

std::int64_t UtcSecondsNow();

}  // namespace foresight
