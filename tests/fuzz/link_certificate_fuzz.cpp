// Certificates of the link: files, and what a peer shows at a handshake.
#include <cstdint>
#include <string>

#include "hardware/link/pki/certificate.h"
#include "tests/fuzz/pem.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string pem = ToPemBlock({reinterpret_cast<const char*>(bytes), size}, "CERTIFICATE");
  (void)ReadCaCertificate(pem, "fuzz.crt");
  (void)CheckKeyFits(pem, pem, "fuzz.key");
  for (const LinkRole role : {LinkRole::kHead, LinkRole::kOperator})
    (void)CheckSignedBy(pem, pem, role, 1'790'000'000, "fuzz.crt");
  const auto certificate = ReadLinkCertificate(pem, "fuzz.crt");
  if (!certificate) return 0;
  (void)DateText(certificate->to_utc_s);
  const LinkIdentity& identity = certificate->identity;
  Require(CheckLinkName(identity.role, identity.name).has_value(), "a name that is read is valid");
  Require(LinkIdentity::FromUri(identity.ToUri()) == identity, "a URI survives the round trip");
  Require(!certificate->public_key_pem.empty(), "a certificate that was accepted has a key");
  return 0;
}
