#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "hardware/link/pki/tls_files.h"

namespace foresight {

/// Decides whose certificate is good: a head admits operators and observers, a station admits
/// heads. The revocation list is read again when its file changes. A list that is then damaged,
/// another CA's or older is logged and not taken: what was revoked stays revoked. Safe from any
/// thread.
class CertificateGate {
 public:
  using Clock = std::function<std::int64_t()>;  ///< UTC in seconds

  /// Fails with kIo and kBadData where the folder's revocation list cannot be used, or
  /// revokes the own certificate.
  static Result<std::shared_ptr<CertificateGate>> Open(const TlsFiles& files,
                                                       Clock clock = UtcSecondsNow);
  ~CertificateGate();

  /// At a handshake: who the peer is. Fails with kBadData, and why, for a certificate that the CA
  /// did not sign, that is not valid now, revoked, or of a role that is not admitted. 0.5 ms.
  Result<LinkCertificate> Admit(std::string_view pem);

  /// In a connection whose handshake was admitted: whether the certificate still is neither expired
  /// nor revoked. The signature is not checked once more. 0.2 ms.
  Result<LinkCertificate> CheckStillGood(std::string_view pem);

 private:
  struct Impl;
  explicit CertificateGate(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
