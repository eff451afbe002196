#include "hardware/link/pki/tls_files.h"

#include <cstdlib>

#include "core/base/atomic_file.h"
#include "hardware/link/pki/private_file.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

}  // namespace

fs::path ConfigFolder() {
  // The specification has relative paths ignored.
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config != nullptr && config[0] == '/')
    return fs::path(config) / "foresight";
  const char* home = std::getenv("HOME");
  return fs::path(home == nullptr ? "/" : home) / ".config" / "foresight";
}

fs::path KeyFolderOfHead() {
  return "/etc/foresight/link";
}

fs::path KeyFolderOfStation() {
  return ConfigFolder() / "link";
}

std::string KeyFolderText(LinkRole role) {
  return role == LinkRole::kHead ? KeyFolderOfHead().string() : "~/.config/foresight/link";
}

Result<TlsFiles> LoadTlsFiles(const fs::path& folder, std::int64_t utc_s) {
  TlsFiles files;
  files.folder = folder;
  const fs::path certificate = folder / kCertificateFile;
  const fs::path key = folder / kPrivateKeyFile;
  FORESIGHT_TRY(files.ca_pem, ReadFile(folder / kCaFile, kLargestPem_bytes));
  FORESIGHT_TRY(files.certificate_pem, ReadFile(certificate, kLargestPem_bytes));
  FORESIGHT_TRY(files.private_key_pem, ReadFile(key, kLargestPem_bytes));
  FORESIGHT_CHECK(CheckIsPrivate(key));
  FORESIGHT_CHECK(ReadCaCertificate(files.ca_pem, (folder / kCaFile).string()));
  FORESIGHT_TRY(files.certificate,
                ReadLinkCertificate(files.certificate_pem, certificate.string()));
  FORESIGHT_CHECK(CheckKeyFits(files.certificate_pem, files.private_key_pem, key.string()));
  FORESIGHT_CHECK(CheckSignedBy(files.ca_pem, files.certificate_pem,
                                files.certificate.identity.role, utc_s, certificate.string()));
  return files;
}

Result<TlsFiles> LoadTlsFilesOfHead(const fs::path& folder, std::int64_t utc_s) {
  FORESIGHT_TRY(TlsFiles files, LoadTlsFiles(folder, utc_s));
  const LinkIdentity& identity = files.certificate.identity;
  if (identity.role == LinkRole::kHead) return files;
  return Fail(ErrorCode::kInvalidInput,
              "{}: is of the {} {}; a head needs the keys of a head (foresightctl pki head)",
              (folder / kCertificateFile).string(), ToString(identity.role), identity.name);
}

Result<TlsFiles> LoadTlsFilesOfStation(const fs::path& folder, std::int64_t utc_s) {
  FORESIGHT_TRY(TlsFiles files, LoadTlsFiles(folder, utc_s));
  if (files.certificate.identity.role != LinkRole::kHead) return files;
  return Fail(ErrorCode::kInvalidInput,
              "{}: is of the head {}; a station needs the keys of a person (foresightctl pki "
              "operator)",
              (folder / kCertificateFile).string(), files.certificate.identity.name);
}

}  // namespace foresight
