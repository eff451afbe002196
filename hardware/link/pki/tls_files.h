#pragma once

#include <filesystem>
#include <string>

#include "hardware/link/pki/certificate.h"

namespace foresight {

/// Names of the files in a folder of keys, the same on each machine (docs/formats.md).
inline constexpr const char* kCaFile = "ca.crt";                        ///< the CA's certificate
inline constexpr const char* kRevocationsFile = "ca.crl";               ///< what the CA has revoked
inline constexpr std::size_t kLargestRevocationsFile_bytes = 16 << 20;  ///< a larger one is refused
inline constexpr std::size_t kLargestPem_bytes = 64 << 10;  ///< of a key or a certificate
inline constexpr const char* kCertificateFile =
    "link.crt";  ///< this machine's or person's certificate
inline constexpr const char* kPrivateKeyFile = "link.key";  ///< its private key, 0600

/// $XDG_CONFIG_HOME/foresight, else ~/.config/foresight.
std::filesystem::path ConfigFolder();
/// Where a head looks for its keys: /etc/foresight/link.
std::filesystem::path KeyFolderOfHead();
/// Where the station's programs look: $XDG_CONFIG_HOME/foresight/link, else
/// ~/.config/foresight/link.
std::filesystem::path KeyFolderOfStation();
/// The same place for a role, as people read it: "~/.config/foresight/link".
std::string KeyFolderText(LinkRole role);

/// Who this program is on the link, and whom it believes.
struct TlsFiles {
  std::filesystem::path folder;
  std::string ca_pem;
  std::string certificate_pem;
  std::string private_key_pem;
  LinkCertificate certificate;
};

/// Reads a folder of keys and checks it: the key is private and belongs to the certificate, the CA
/// signed that, and its dates hold at `utc_s`. Fails with kIo for files that are not there,
/// kBadData.
Result<TlsFiles> LoadTlsFiles(const std::filesystem::path& folder,
                              std::int64_t utc_s = UtcSecondsNow());

/// The same for a program that is a head, or that is a station: also fails, with kInvalidInput, for
/// the keys of the other kind.
Result<TlsFiles> LoadTlsFilesOfHead(const std::filesystem::path& folder,
                                    std::int64_t utc_s = UtcSecondsNow());
Result<TlsFiles> LoadTlsFilesOfStation(const std::filesystem::path& folder,
                                       std::int64_t utc_s = UtcSecondsNow());

}  // namespace foresight
