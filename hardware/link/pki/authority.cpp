#include "hardware/link/pki/authority.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <tuple>

#include "core/base/atomic_file.h"
#include "hardware/link/pki/private_file.h"
#include "hardware/link/pki/tls_files.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCaKeyFile = "ca.key";
constexpr const char* kCertificates = "certificates";
constexpr const char* kMachines = "machines";
constexpr std::int64_t kDay = 86400;
/// A machine whose clock is behind by less takes a new certificate at once.
constexpr std::int64_t kClockTolerance = kDay;

Status MakePrivateFolder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return {};
  fs::create_directories(folder, error);
  if (!error) fs::permissions(folder, fs::perms::owner_all, error);
  if (!error) return {};
  return Fail(ErrorCode::kIo, "{}: cannot make the folder: {}", folder.string(), error.message());
}

/// Held by what it returns; the system gives it back when a program dies.
Result<std::shared_ptr<void>> Lock(const fs::path& folder) {
  const int handle = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0)
    return Fail(ErrorCode::kIo, "{}: cannot open: {}", folder.string(), std::strerror(errno));
  std::shared_ptr<void> lock(nullptr, [handle](void*) { close(handle); });
  if (flock(handle, LOCK_EX | LOCK_NB) != 0)
    return Fail(ErrorCode::kState, "{}: another program works with this CA now", folder.string());
  return lock;
}

Status CheckDays(int days, int most) {
  if (days >= 1 && days <= most) return {};
  return Fail(ErrorCode::kInvalidOptions, "--days: {} is not between 1 and {}", days, most);
}

}  // namespace

Result<CertificateAuthority> CertificateAuthority::Create(const fs::path& folder, int days,
                                                          std::int64_t utc_s) {
  constexpr int kMostDays = 36500;
  FORESIGHT_CHECK(CheckDays(days, kMostDays));
  FORESIGHT_CHECK(MakePrivateFolder(folder));
  CertificateAuthority ca;
  ca.folder_ = folder;
  FORESIGHT_TRY(ca.lock_, Lock(folder));
  for (const char* file : {kCaKeyFile, kCaFile})
    if (std::error_code ignored; fs::exists(folder / file, ignored))
      return Fail(ErrorCode::kState,
                  "{}: there is a CA in this folder already; it is never overwritten",
                  (folder / file).string());
  ca.validity_ = {utc_s - kClockTolerance, utc_s + days * kDay};
  FORESIGHT_TRY(ca.keys_, MakeCa(ca.validity_));
  FORESIGHT_CHECK(MakePrivateFolder(folder / kCertificates));
  FORESIGHT_CHECK(MakePrivateFolder(folder / kMachines));
  FORESIGHT_CHECK(WritePrivateFile(folder / kCaKeyFile, ca.keys_.private_key_pem));
  FORESIGHT_CHECK(WriteFileAtomically(folder / kCaFile, ca.keys_.certificate_pem));
  FORESIGHT_CHECK(ca.MakeRevocationsAnew(std::min(days, kDaysOfCertificate), utc_s));
  return ca;
}

Result<CertificateAuthority> CertificateAuthority::Open(const fs::path& folder) {
  CertificateAuthority ca;
  ca.folder_ = folder;
  if (std::error_code ignored; !fs::exists(folder / kCaFile, ignored))
    return Fail(ErrorCode::kIo, "{}: holds no CA; foresightctl pki init makes one",
                folder.string());
  FORESIGHT_TRY(ca.lock_, Lock(folder));
  const fs::path key = folder / kCaKeyFile;
  const std::string certificate = (folder / kCaFile).string();
  FORESIGHT_TRY(ca.keys_.certificate_pem, ReadFile(certificate, kLargestPem_bytes));
  FORESIGHT_TRY(ca.keys_.private_key_pem, ReadFile(key, kLargestPem_bytes));
  FORESIGHT_CHECK(CheckIsPrivate(key));
  FORESIGHT_TRY(ca.validity_, ReadCaCertificate(ca.keys_.certificate_pem, certificate));
  FORESIGHT_CHECK(CheckKeyFits(ca.keys_.certificate_pem, ca.keys_.private_key_pem, key.string()));
  FORESIGHT_TRY(const std::string list,
                ReadFile(folder / kRevocationsFile, kLargestRevocationsFile_bytes));
  FORESIGHT_TRY(ca.revocations_, ReadRevocationList(list, ca.keys_.certificate_pem,
                                                    (folder / kRevocationsFile).string()));
  return ca;
}

fs::path CertificateAuthority::FolderOf(const std::string& name) const {
  return folder_ / kMachines / name;
}

Result<LinkCertificate> CertificateAuthority::Issue(const LinkIdentity& identity,
                                                    const IssueOptions& options,
                                                    std::int64_t utc_s) {
  FORESIGHT_CHECK(CheckLinkName(identity.role, identity.name));
  FORESIGHT_TRY(const Validity validity, ValidityFor(options.days, utc_s));
  FORESIGHT_TRY(const std::string key, MakePrivateKey());
  FORESIGHT_TRY(const std::string public_key, PublicKeyOf(key));
  const CertificateRequest request{identity, options.addresses, validity, public_key};
  // Signed once in vain, so that nothing is revoked for a request that cannot be signed.
  FORESIGHT_CHECK(SignCertificate(request, keys_));
  if (const auto present = CurrentOf(identity.name)) {
    if (!options.replace)
      return Fail(ErrorCode::kState,
                  "{}: is the name of the {} {} already; --replace revokes that certificate and "
                  "makes a new key, `renew` keeps the key",
                  identity.name, ToString(present->certificate.identity.role), identity.name);
    FORESIGHT_CHECK(Revoke(identity.name, utc_s));
  } else if (present.error().code != ErrorCode::kInvalidInput) {
    return tl::unexpected(present.error());
  }
  const fs::path folder = FolderOf(identity.name);
  FORESIGHT_CHECK(MakePrivateFolder(folder));
  FORESIGHT_CHECK(WritePrivateFile(folder / kPrivateKeyFile, key));
  return SignAndKeep(request);
}

Result<LinkCertificate> CertificateAuthority::Renew(const std::string& name,
                                                    const RenewOptions& options,
                                                    std::int64_t utc_s) {
  FORESIGHT_TRY(const IssuedCertificate present, CurrentOf(name));
  const LinkCertificate& certificate = present.certificate;
  FORESIGHT_TRY(Validity validity, ValidityFor(options.days, utc_s));
  // The latest of a name is the one that begins last, also where two were made in one second.
  validity.from_utc_s = std::max(validity.from_utc_s, certificate.from_utc_s + 1);
  CertificateRequest request{certificate.identity, options.addresses, validity,
                             certificate.public_key_pem};
  if (!request.addresses.empty() && certificate.identity.role != LinkRole::kHead)
    return Fail(ErrorCode::kInvalidOptions,
                "--address: {} is the name of an {}; only heads have addresses", name,
                ToString(certificate.identity.role));
  if (request.addresses.empty() && !certificate.addresses.empty())  // the first is the stable one
    request.addresses.assign(certificate.addresses.begin() + 1, certificate.addresses.end());
  FORESIGHT_CHECK(MakePrivateFolder(FolderOf(name)));
  return SignAndKeep(request);
}

Result<int> CertificateAuthority::Revoke(const std::string& name, std::int64_t utc_s) {
  FORESIGHT_TRY(const std::vector<IssuedCertificate> all, List());
  RevocationList list = revocations_;
  int count = 0;
  for (const IssuedCertificate& issued : all)
    if (issued.certificate.identity.name == name && !issued.revoked) {
      list.serials.insert(issued.certificate.serial);
      ++count;
    }
  if (count == 0)
    return Fail(ErrorCode::kInvalidInput, "{}: no certificate of that name that could be revoked",
                name);
  list.from_utc_s = utc_s;
  list.due_utc_s = std::min(utc_s + kDaysOfCertificate * kDay, validity_.to_utc_s);
  FORESIGHT_CHECK(WriteRevocations(std::move(list)));
  std::error_code error;
  fs::remove_all(FolderOf(name), error);
  if (error)
    return Fail(ErrorCode::kIo, "{}: revoked, but its keys cannot be removed: {}",
                FolderOf(name).string(), error.message());
  return count;
}

Status CertificateAuthority::MakeRevocationsAnew(int days, std::int64_t utc_s) {
  FORESIGHT_TRY(const Validity validity, ValidityFor(days, utc_s));
  RevocationList list = revocations_;
  list.from_utc_s = utc_s;
  list.due_utc_s = validity.to_utc_s;
  return WriteRevocations(std::move(list));
}

Result<std::vector<IssuedCertificate>> CertificateAuthority::List() const {
  std::vector<IssuedCertificate> all;
  std::error_code error;
  for (fs::directory_iterator file(folder_ / kCertificates, error), end; !error && file != end;
       file.increment(error)) {
    if (file->path().extension() != ".crt") continue;
    FORESIGHT_TRY(const std::string pem, ReadFile(file->path(), kLargestPem_bytes));
    FORESIGHT_TRY(LinkCertificate certificate, ReadLinkCertificate(pem, file->path().string()));
    const bool revoked = revocations_.Contains(certificate.serial);
    all.push_back({std::move(certificate), revoked, false});
  }
  if (error)
    return Fail(ErrorCode::kIo, "{}: cannot read the folder: {}",
                (folder_ / kCertificates).string(), error.message());
  const auto key = [](const IssuedCertificate& issued) {
    const LinkCertificate& it = issued.certificate;
    return std::tie(it.identity.name, it.from_utc_s, it.to_utc_s, it.serial);
  };
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const IssuedCertificate* later = nullptr;
  for (auto issued = all.rbegin(); issued != all.rend(); ++issued) {
    if (issued->revoked) continue;
    issued->current =
        later == nullptr || later->certificate.identity.name != issued->certificate.identity.name;
    later = &*issued;
  }
  return all;
}

/// Fails with kInvalidInput where there is none.
Result<IssuedCertificate> CertificateAuthority::CurrentOf(const std::string& name) const {
  FORESIGHT_TRY(std::vector<IssuedCertificate> all, List());
  for (IssuedCertificate& issued : all)
    if (issued.current && issued.certificate.identity.name == name) return std::move(issued);
  return Fail(ErrorCode::kInvalidInput, "{}: no certificate of that name, or only revoked ones",
              name);
}

Result<Validity> CertificateAuthority::ValidityFor(int days, std::int64_t utc_s) const {
  const auto most = static_cast<int>((validity_.to_utc_s - utc_s) / kDay);
  if (most < 1)
    return Fail(ErrorCode::kState, "{}: this CA ended on {}; a new one has to be made",
                folder_.string(), DateText(validity_.to_utc_s));
  if (const Status status = CheckDays(days, most); !status)
    return Fail(ErrorCode::kInvalidOptions, "{} (the CA ends on {})", status.error().message,
                DateText(validity_.to_utc_s));
  return Validity{utc_s - kClockTolerance, utc_s + days * kDay};
}

Result<LinkCertificate> CertificateAuthority::SignAndKeep(const CertificateRequest& request) const {
  FORESIGHT_TRY(const std::string pem, SignCertificate(request, keys_));
  FORESIGHT_TRY(LinkCertificate certificate, ReadLinkCertificate(pem, "the new certificate"));
  const std::string& name = certificate.identity.name;
  const fs::path folder = FolderOf(name);
  // The record first: what it does not know could never be revoked.
  FORESIGHT_CHECK(WriteFileAtomically(
      folder_ / kCertificates / fmt::format("{}-{}.crt", name, certificate.serial), pem));
  FORESIGHT_TRY(const std::string list,
                ReadFile(folder_ / kRevocationsFile, kLargestRevocationsFile_bytes));
  FORESIGHT_CHECK(WriteFileAtomically(folder / kCaFile, keys_.certificate_pem));
  FORESIGHT_CHECK(WriteFileAtomically(folder / kRevocationsFile, list));
  FORESIGHT_CHECK(WriteFileAtomically(folder / kCertificateFile, pem));
  return certificate;
}

Status CertificateAuthority::WriteRevocations(RevocationList list) {
  list.number = revocations_.number + 1;
  FORESIGHT_TRY(const std::string pem, SignRevocationList(list, keys_));
  FORESIGHT_CHECK(WriteFileAtomically(folder_ / kRevocationsFile, pem));
  revocations_ = std::move(list);
  std::error_code error;
  for (fs::directory_iterator machine(folder_ / kMachines, error), end; !error && machine != end;
       machine.increment(error))
    if (machine->is_directory())
      FORESIGHT_CHECK(WriteFileAtomically(machine->path() / kRevocationsFile, pem));
  if (!error) return {};
  return Fail(ErrorCode::kIo, "{}: cannot read the folder: {}", (folder_ / kMachines).string(),
              error.message());
}

}  // namespace foresight
