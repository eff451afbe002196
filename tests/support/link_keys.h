#pragma once

#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "hardware/link/pki/authority.h"
#include "hardware/link/pki/private_file.h"
#include "hardware/link/pki/tls_files.h"
#include "tests/support/temporary_folder.h"

namespace foresight {

inline constexpr std::int64_t kDayS = 86400;

/// A CA in a folder of its own, and keys that it makes.
class LinkKeys {
 public:
  explicit LinkKeys(std::int64_t now_utc_s = UtcSecondsNow())
      : now_utc_s_(now_utc_s),
        ca_(CertificateAuthority::Create(folder_ / "pki", kDaysOfCa, now_utc_s).value()) {}

  CertificateAuthority& ca() { return ca_; }
  std::int64_t now_utc_s() const { return now_utc_s_; }
  std::filesystem::path folder(const std::string& name) const { return ca_.FolderOf(name); }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  std::filesystem::path Head(const std::string& name = "left",
                             std::vector<std::string> addresses = {"127.0.0.1", "localhost"}) {
    return Issue({LinkRole::kHead, name}, std::move(addresses));
  }
  std::filesystem::path Operator(const std::string& name = "anna") {
    return Issue({LinkRole::kOperator, name}, {});
  }
  std::filesystem::path Observer(const std::string& name = "otto") {
    return Issue({LinkRole::kObserver, name}, {});
  }

  /// Replaces the certificate in a folder of keys by one of the same key that says something else.
  void Rewrite(const std::filesystem::path& folder, const LinkIdentity& identity,
               const Validity& validity, const std::vector<std::string>& addresses = {}) {
    const std::string key = ReadFile(folder / kPrivateKeyFile).value();
    const auto pem =
        SignCertificate({identity, addresses, validity, PublicKeyOf(key).value()}, Keys());
    ASSERT_TRUE(pem) << pem.error().message;
    ASSERT_TRUE(WriteFileAtomically(folder / kCertificateFile, *pem));
  }

  /// The CA's own.
  KeyPair Keys() const {
    return {ReadFile(ca_.folder() / "ca.crt").value(), ReadFile(ca_.folder() / "ca.key").value()};
  }

  /// As somebody copies the new list to a machine.
  void DeliverRevocations(const std::filesystem::path& folder) {
    ASSERT_TRUE(WriteFileAtomically(folder / kRevocationsFile,
                                    ReadFile(ca_.folder() / kRevocationsFile).value()));
  }

 private:
  std::filesystem::path Issue(const LinkIdentity& identity, std::vector<std::string> addresses) {
    const auto certificate =
        ca_.Issue(identity, {std::move(addresses), kDaysOfCertificate, false}, now_utc_s_);
    EXPECT_TRUE(certificate) << certificate.error().message;
    return folder(identity.name);
  }

  TemporaryFolder folder_;
  std::int64_t now_utc_s_;
  CertificateAuthority ca_;
};

}  // namespace foresight
