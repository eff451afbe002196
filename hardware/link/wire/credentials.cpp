#include "hardware/link/wire/credentials.h"

#include <arpa/inet.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/security/server_credentials.h>

#include <cstdlib>
#include <string>

#include "core/base/log.h"
#include "core/base/printable.h"
#include "hardware/link/wire/line_limit.h"

namespace foresight {
namespace {

namespace tls = grpc::experimental;

/// gRPC 1.51 has no public way to refuse TLS 1.2. It offers there what this variable says, which it
/// reads once, at its first handshake: suites for RSA keys, which nobody on the link has. TLS 1.3
/// has suites of its own. Set before main(), because setenv() is not safe beside other threads.
[[maybe_unused]] const bool kNoTls12 =
    setenv("GRPC_SSL_CIPHER_SUITES", "ECDHE-RSA-AES256-GCM-SHA384", 1) == 0;

std::string_view View(const grpc::string_ref& text) {
  return {text.data(), text.size()};
}

/// Asks the gate once TLS has verified the chain, before a byte of HTTP/2 is read.
class GateVerifier : public tls::ExternalCertificateVerifier {
 public:
  GateVerifier(std::shared_ptr<CertificateGate> gate, bool check_host)
      : gate_(std::move(gate)), check_host_(check_host) {}

  bool Verify(tls::TlsCustomVerificationCheckRequest* request, std::function<void(grpc::Status)>,
              grpc::Status* status) override {
    *status = check_host_ ? CheckHost(*request) : grpc::Status::OK;
    if (!status->ok()) return true;
    const auto peer = gate_->Admit(View(request->peer_cert()));
    if (peer) return true;
    LogRefusal("refused a peer: " + peer.error().message);
    *status = grpc::Status(grpc::StatusCode::UNAUTHENTICATED, peer.error().message);
    return true;
  }

  void Cancel(tls::TlsCustomVerificationCheckRequest*) override {}

 private:
  grpc::Status CheckHost(tls::TlsCustomVerificationCheckRequest& request) {
    grpc::Status status;
    host_verifier_.Verify(&request, nullptr, &status);  // it answers at once
    if (!status.ok())
      LogRefusal(fmt::format("refused a head: its certificate is not one for {}",
                             View(request.target_name())));
    return status;
  }

  void LogRefusal(const std::string& why) {
    if (const auto line = limit_.Pass(why, std::chrono::steady_clock::now()))
      LogWarning("link: {}", Printable(*line));
  }

  std::shared_ptr<CertificateGate> gate_;
  bool check_host_;
  LineLimit limit_;
  tls::HostNameCertificateVerifier host_verifier_;
};

void Configure(tls::TlsCredentialsOptions& options, const std::shared_ptr<CertificateGate>& gate,
               bool check_host) {
  options.watch_root_certs();
  options.watch_identity_key_cert_pairs();
#ifndef __clang_analyzer__  // it takes what gRPC's core owns for a leak
  options.set_certificate_verifier(
      tls::ExternalCertificateVerifier::Create<GateVerifier>(gate, check_host));
#endif
}

std::shared_ptr<tls::StaticDataCertificateProvider> ProviderOf(const TlsFiles& files) {
  return std::make_shared<tls::StaticDataCertificateProvider>(
      files.ca_pem,
      std::vector<tls::IdentityKeyCertPair>{{files.private_key_pem, files.certificate_pem}});
}

Status CheckLoopback(std::string_view host) {
  if (IsLoopback(host)) return {};
  return Fail(ErrorCode::kInvalidOptions,
              "{}: a link without encryption is possible on this machine only (127.0.0.1); for "
              "other addresses make keys with foresightctl pki",
              Printable(host));
}

}  // namespace

std::shared_ptr<grpc::ServerCredentials> HeadCredentials(
    const TlsFiles& files, const std::shared_ptr<CertificateGate>& gate) {
  tls::TlsServerCredentialsOptions options(ProviderOf(files));
  Configure(options, gate, false);
  options.set_cert_request_type(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  return tls::TlsServerCredentials(options);
}

std::shared_ptr<grpc::ChannelCredentials> StationCredentials(
    const TlsFiles& files, const std::shared_ptr<CertificateGate>& gate) {
  tls::TlsChannelCredentialsOptions options;
  options.set_certificate_provider(ProviderOf(files));
  Configure(options, gate, true);
  return tls::TlsCredentials(options);
}

Result<std::shared_ptr<grpc::ServerCredentials>> PlaintextHeadCredentials(std::string_view host) {
  FORESIGHT_CHECK(CheckLoopback(host));
  return tls::LocalServerCredentials(LOCAL_TCP);
}

Result<std::shared_ptr<grpc::ChannelCredentials>> PlaintextStationCredentials(
    std::string_view host) {
  FORESIGHT_CHECK(CheckLoopback(host));
  return tls::LocalCredentials(LOCAL_TCP);
}

bool IsLoopback(std::string_view host) {
  constexpr std::uint32_t kLoopbackNet = 127;
  in_addr address{};
  if (inet_pton(AF_INET, std::string(host).c_str(), &address) == 1)
    return ntohl(address.s_addr) >> 24 == kLoopbackNet;
  return host == "localhost" || host == "::1";
}

}  // namespace foresight
