#include "hardware/link/pki/check_key_folder.h"

#include <algorithm>

#include "core/base/atomic_file.h"
#include "hardware/link/pki/private_file.h"
#include "hardware/link/pki/revocation_list.h"
#include "hardware/link/pki/tls_files.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kDay_s = 86400;
constexpr std::int64_t kSoon = 30 * kDay_s;

/// Looks at one folder, file by file; later files are judged by the earlier ones.
class Examination {
 public:
  Examination(fs::path folder, std::int64_t utc_s) : folder_(std::move(folder)), utc_s_(utc_s) {}

  KeyFolderReport Run() {
    ReadAll();
    LookAtCa();
    LookAtCertificate();
    LookAtKey();
    LookAtRevocations();
    return std::move(report_);
  }

 private:
  using Kind = KeyFinding::Kind;

  void Add(Kind kind, std::string text) { report_.findings.push_back({kind, std::move(text)}); }

  void Add(const Status& status, std::string good) {
    if (status)
      Add(Kind::kGood, std::move(good));
    else
      Add(Kind::kProblem, status.error().message);
  }

  std::string Read(const char* name) {
    auto text = ReadFile(folder_ / name, std::size_t{16} << 20);
    if (text) return std::move(*text);
    Add(Kind::kProblem, text.error().message);
    return "";
  }

  void ReadAll() {
    ca_pem_ = Read(kCaFile);
    certificate_pem_ = Read(kCertificateFile);
    key_pem_ = Read(kPrivateKeyFile);
    list_pem_ = Read(kRevocationsFile);
  }

  void SayIfSoonOver(std::int64_t to_utc_s, const char* file, const char* remedy) {
    if (to_utc_s < utc_s_ + kSoon && to_utc_s >= utc_s_)
      Add(Kind::kWarning, fmt::format("{}: ends on {}; {}", file, DateText(to_utc_s), remedy));
  }

  void LookAtCa() {
    if (ca_pem_.empty()) return;
    const auto validity = ReadCaCertificate(ca_pem_, kCaFile);
    if (!validity) return Add(Kind::kProblem, validity.error().message);
    Add(Kind::kGood, fmt::format("{}: a CA, until {}", kCaFile, DateText(validity->to_utc_s)));
    SayIfSoonOver(validity->to_utc_s, kCaFile, "all machines need keys of a new CA");
  }

  void LookAtCertificate() {
    if (certificate_pem_.empty()) return;
    const auto certificate = ReadLinkCertificate(certificate_pem_, kCertificateFile);
    if (!certificate) return Add(Kind::kProblem, certificate.error().message);
    report_.certificate = *certificate;
    if (ca_pem_.empty()) return;
    const LinkIdentity& identity = certificate->identity;
    Add(CheckSignedBy(ca_pem_, certificate_pem_, identity.role, utc_s_, kCertificateFile),
        fmt::format("{}: {} {}, until {}", kCertificateFile, ToString(identity.role), identity.name,
                    DateText(certificate->to_utc_s)));
    SayIfSoonOver(certificate->to_utc_s, kCertificateFile, "foresightctl pki renew");
  }

  void LookAtKey() {
    if (key_pem_.empty()) return;
    if (const auto status = CheckIsPrivate(folder_ / kPrivateKeyFile); !status)
      Add(Kind::kProblem, status.error().message);
    if (!certificate_pem_.empty())
      Add(CheckKeyFits(certificate_pem_, key_pem_, kPrivateKeyFile),
          fmt::format("{}: the key of that certificate", kPrivateKeyFile));
  }

  void LookAtRevocations() {
    if (list_pem_.empty() || ca_pem_.empty()) return;
    const auto list = ReadRevocationList(list_pem_, ca_pem_, kRevocationsFile);
    if (!list) return Add(Kind::kProblem, list.error().message);
    Add(Kind::kGood,
        fmt::format("{}: list {} of revocations ({} in it), until {}", kRevocationsFile,
                    list->number, list->serials.size(), DateText(list->due_utc_s)));
    if (list->due_utc_s < utc_s_)
      Add(Kind::kWarning, fmt::format("{}: was to be made anew by {} (foresightctl pki "
                                      "revocations); it still holds",
                                      kRevocationsFile, DateText(list->due_utc_s)));
    SayIfSoonOver(list->due_utc_s, kRevocationsFile, "foresightctl pki revocations");
    if (report_.certificate && list->Contains(report_.certificate->serial))
      Add(Kind::kProblem, fmt::format("{}: was revoked", kCertificateFile));
  }

  fs::path folder_;
  std::int64_t utc_s_;
  KeyFolderReport report_;
  std::string ca_pem_;
  std::string certificate_pem_;
  std::string key_pem_;
  std::string list_pem_;
};

}  // namespace

bool KeyFolderReport::IsUsable() const {
  return std::none_of(findings.begin(), findings.end(), [](const KeyFinding& finding) {
    return finding.kind == KeyFinding::Kind::kProblem;
  });
}

Result<KeyFolderReport> CheckKeyFolder(const fs::path& folder, std::int64_t utc_s) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    return Fail(ErrorCode::kIo, "{}: is no folder", folder.string());
  return Examination(folder, utc_s).Run();
}

}  // namespace foresight
