// Lists of revoked certificates: files that are copied onto a head.
#include <cstdint>
#include <string>

#include "hardware/link/pki/revocation_list.h"
#include "tests/fuzz/pem.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  // Of the corpus's CA, which made the lists there.
  constexpr std::string_view kCa = R"(-----BEGIN CERTIFICATE-----
MIIByTCCAW+gAwIBAgIQTUw2b7CzknqKFEFpBnneezAKBggqhkjOPQQDAjBDMRIw
EAYDVQQKDAlGb3Jlc2lnaHQxCzAJBgNVBAsMAkNBMSAwHgYDVQQDDBdGb3Jlc2ln
aHQgbGluayAzZjNmYTU1YTAeFw0yNjExMjIwNjU3NDlaFw0zNjExMjAwNjU3NDla
MEMxEjAQBgNVBAoMCUZvcmVzaWdodDELMAkGA1UECwwCQ0ExIDAeBgNVBAMMF0Zv
cmVzaWdodCBsaW5rIDNmM2ZhNTVhMFkwEwYHKoZIzj0CAQYIKoZIzj0DAQcDQgAE
ACJunVjREjesojrtN7jj7lVRj01Dx4gTA2olxivL2IpTTidHt50qLA93kTo4rwLU
4PgzGhkLYrriRTUkLzW3WqNFMEMwEgYDVR0TAQH/BAgwBgEB/wIBADAOBgNVHQ8B
Af8EBAMCAQYwHQYDVR0OBBYEFJPwmoo0Ztg1KMw/81oiAOcqaYWfMAoGCCqGSM49
BAMCA0gAMEUCIQDwt9FZd0KkBwwLaHQEZ7najpKWCoTTrI4dpxaTZrLogQIgbEiD
1A5PLo+jTH9lNpmDPKgkg1+/uS51TC1NiiCvWFs=
-----END CERTIFICATE-----
)";
  const auto list = ReadRevocationList(
      ToPemBlock({reinterpret_cast<const char*>(bytes), size}, "X509 CRL"), kCa, "fuzz.crl");
  if (!list) return 0;
  Require(list->number >= 0, "a list that was accepted has a number");
  for (const std::string& serial : list->serials)
    Require(list->Contains(serial), "a list contains what it revokes");
  return 0;
}
