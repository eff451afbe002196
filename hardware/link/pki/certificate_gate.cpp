#include "hardware/link/pki/certificate_gate.h"

#include <sys/stat.h>

#include <mutex>
#include <tuple>

#include "core/base/atomic_file.h"
#include "core/base/log.h"
#include "hardware/link/pki/revocation_list.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

/// Differs after each change of a file, also after two within one tick of the file system's clock.
struct FileVersion {
  ino_t node = 0;
  off_t size = -1;
  std::int64_t changed_s = 0;
  std::int64_t changed_ns = 0;

  bool operator==(const FileVersion&) const = default;
};

FileVersion VersionOf(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_size, status.st_ctim.tv_sec, status.st_ctim.tv_nsec};
}

Result<RevocationList> ReadList(const fs::path& file, std::string_view ca_pem) {
  FORESIGHT_TRY(const std::string pem, ReadFile(file, kLargestRevocationsFile_bytes));
  return ReadRevocationList(pem, ca_pem, file.string());
}

}  // namespace

struct CertificateGate::Impl {
  fs::path list_file;
  std::string ca_pem;
  LinkIdentity self;
  Clock clock;

  std::mutex mutex;
  FileVersion version;
  RevocationList list;

  void Take(RevocationList newer) {
    list = std::move(newer);
    if (list.due_utc_s < clock())
      LogWarning("{}: the revocation list was to be made anew by {}; it still holds",
                 list_file.string(), DateText(list.due_utc_s));
  }

  /// With the mutex held.
  void ReadAgainWhereChanged() {
    const FileVersion present = VersionOf(list_file);
    if (present == version) return;
    version = present;
    auto newer = ReadList(list_file, ca_pem);
    if (!newer) {
      LogError("{}; the list that was read before still holds", newer.error().message);
    } else if (newer->number < list.number) {
      LogError("{}: is list {}, older than list {} that was read before, which still holds",
               list_file.string(), newer->number, list.number);
    } else {
      Take(std::move(*newer));
      LogInfo("{}: list {} of revocations was read, {} in it", list_file.string(), list.number,
              list.serials.size());
    }
  }

  bool IsRevoked(const LinkCertificate& certificate) {
    const std::lock_guard lock(mutex);
    ReadAgainWhereChanged();
    return list.Contains(certificate.serial);
  }

  Status CheckRole(const LinkCertificate& certificate) const {
    const bool admits_heads = self.role != LinkRole::kHead;
    if ((certificate.identity.role == LinkRole::kHead) == admits_heads) return {};
    return Fail(ErrorCode::kBadData, "{}: is not the certificate of {}",
                certificate.identity.ToUri(), admits_heads ? "a head" : "an operator or observer");
  }
};

CertificateGate::CertificateGate(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CertificateGate::~CertificateGate() = default;

Result<std::shared_ptr<CertificateGate>> CertificateGate::Open(const TlsFiles& files, Clock clock) {
  auto impl = std::make_unique<Impl>();
  impl->list_file = files.folder / kRevocationsFile;
  impl->ca_pem = files.ca_pem;
  impl->self = files.certificate.identity;
  impl->clock = std::move(clock);
  impl->version = VersionOf(impl->list_file);
  FORESIGHT_TRY(RevocationList list, ReadList(impl->list_file, files.ca_pem));
  if (list.Contains(files.certificate.serial))
    return Fail(ErrorCode::kBadData, "{}: the certificate of {} was revoked",
                (files.folder / kCertificateFile).string(), impl->self.name);
  impl->Take(std::move(list));
  return std::shared_ptr<CertificateGate>(new CertificateGate(std::move(impl)));
}

Result<LinkCertificate> CertificateGate::Admit(std::string_view pem) {
  FORESIGHT_TRY(LinkCertificate certificate, ReadLinkCertificate(pem, "peer"));
  const std::string uri = certificate.identity.ToUri();
  FORESIGHT_CHECK(impl_->CheckRole(certificate));
  FORESIGHT_CHECK(
      CheckSignedBy(impl_->ca_pem, pem, certificate.identity.role, impl_->clock(), uri));
  if (impl_->IsRevoked(certificate))
    return Fail(ErrorCode::kBadData, "{}: the certificate {} was revoked", uri, certificate.serial);
  return certificate;
}

Result<LinkCertificate> CertificateGate::CheckStillGood(std::string_view pem) {
  FORESIGHT_TRY(LinkCertificate certificate, ReadLinkCertificate(pem, "peer"));
  const std::string uri = certificate.identity.ToUri();
  FORESIGHT_CHECK(impl_->CheckRole(certificate));
  if (impl_->clock() > certificate.to_utc_s)
    return Fail(ErrorCode::kBadData, "{}: expired on {}", uri, DateText(certificate.to_utc_s));
  if (impl_->IsRevoked(certificate))
    return Fail(ErrorCode::kBadData, "{}: the certificate {} was revoked", uri, certificate.serial);
  return certificate;
}

}  // namespace foresight
