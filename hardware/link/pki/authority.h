#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hardware/link/pki/revocation_list.h"

namespace foresight {

inline constexpr int kDaysOfCa = 3650;
/// Of a certificate, and of a revocation list: who renews the certificates makes a new list on the
/// way.
inline constexpr int kDaysOfCertificate = 730;

struct IssuedCertificate {
  LinkCertificate certificate;
  bool revoked = false;
  bool current = false;  ///< the latest of its name, and not revoked
};

/// The private CA of the link, in a folder that never leaves its machine (docs/formats.md):
///   ca.key, ca.crt, ca.crl        its private key, its certificate, what it has revoked
///   certificates/NAME-SERIAL.crt  each certificate that it signed: the record of all
///   machines/NAME/                what goes to one machine or person: TlsFiles
/// A name is of one head, operator or observer. While this exists, no second one can open the
/// folder.
class CertificateAuthority {
 public:
  /// Makes a new CA. Fails with kState where the folder has one, kInvalidOptions, kIo.
  static Result<CertificateAuthority> Create(const std::filesystem::path& folder, int days,
                                             std::int64_t utc_s);
  /// Fails with kIo and kBadData, with kState where another program has the folder open.
  static Result<CertificateAuthority> Open(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  const Validity& validity() const { return validity_; }
  const RevocationList& revocations() const { return revocations_; }
  /// What goes to the owner of that name.
  std::filesystem::path FolderOf(const std::string& name) const;

  struct IssueOptions {
    std::vector<std::string> addresses;  ///< of a head, at least one; of others, none
    int days = kDaysOfCertificate;
    bool replace = false;  ///< a certificate of that name is revoked and its key replaced
  };
  /// A new key and a certificate of it. Fails with kState where the name is taken and not to be
  /// replaced, with kInvalidOptions for a certificate that would outlive the CA, and as
  /// SignCertificate does.
  Result<LinkCertificate> Issue(const LinkIdentity& identity, const IssueOptions& options,
                                std::int64_t utc_s);

  struct RenewOptions {
    std::vector<std::string> addresses;  ///< of a head; empty = as before
    int days = kDaysOfCertificate;
  };
  /// A new certificate of the same key: only the certificate has to travel. The one before holds
  /// until its end. Fails with kInvalidInput where there is none of that name.
  Result<LinkCertificate> Renew(const std::string& name, const RenewOptions& options,
                                std::int64_t utc_s);

  /// Revokes all certificates of that name, makes a new list and removes the folder with the key.
  /// Returns how many.
  Result<int> Revoke(const std::string& name, std::int64_t utc_s);

  /// The same list with a new date and number, in all folders of machines.
  Status MakeRevocationsAnew(int days, std::int64_t utc_s);

  /// By name, then by begin.
  Result<std::vector<IssuedCertificate>> List() const;

 private:
  CertificateAuthority() = default;
  Result<Validity> ValidityFor(int days, std::int64_t utc_s) const;
  Result<IssuedCertificate> CurrentOf(const std::string& name) const;
  Result<LinkCertificate> SignAndKeep(const CertificateRequest& request) const;
  Status WriteRevocations(RevocationList list);

  std::filesystem::path folder_;
  std::shared_ptr<void> lock_;
  KeyPair keys_;
  Validity validity_;
  RevocationList revocations_;
};

}  // namespace foresight
