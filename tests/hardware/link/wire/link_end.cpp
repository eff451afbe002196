#include "tests/hardware/link/wire/link_end.h"

#include <grpcpp/security/credentials.h>
#include <grpcpp/security/server_credentials.h>

#include <chrono>

#include "core/base/log.h"
#include "hardware/link/wire/peer.h"

namespace foresight {
namespace {

std::string Text(const std::filesystem::path& folder, const char* file) {
  return ReadFile(folder / file).value();
}

}  // namespace

TinyHead::TinyHead(const std::shared_ptr<grpc::ServerCredentials>& credentials,
                   std::shared_ptr<CertificateGate> gate)
    : gate_(std::move(gate)) {
  Start(credentials);
}

TinyHead::TinyHead(const std::filesystem::path& keys) {
  const TlsFiles files = LoadTlsFiles(keys).value();
  gate_ = GateOf(files);
  Start(HeadCredentials(files, gate_));
}

TinyHead::~TinyHead() {
  server_->Shutdown(std::chrono::system_clock::now());
}

void TinyHead::Start(const std::shared_ptr<grpc::ServerCredentials>& credentials) {
  grpc::ServerBuilder builder;
  SetHeadArguments(builder);
  builder.AddListeningPort("127.0.0.1:0", credentials, &port_);
  builder.RegisterService(this);
  server_ = builder.BuildAndStart();
}

std::string TinyHead::Address(const std::string& host) const {
  return fmt::format("{}:{}", host, port_);
}

std::optional<LinkIdentity> TinyHead::peer() const {
  const std::lock_guard lock(mutex_);
  return peer_;
}

grpc::Status TinyHead::ListScans(grpc::ServerContext* context, const link::ListScansRequest*,
                                 link::ListScansReply*) {
  const auto peer = CheckPeer(*context->auth_context(), gate_.get());
  if (!peer) return {grpc::StatusCode::UNAUTHENTICATED, peer.error().message};
  const std::lock_guard lock(mutex_);
  peer_ = *peer;
  return grpc::Status::OK;
}

std::shared_ptr<CertificateGate> GateOf(const TlsFiles& files) {
  return CertificateGate::Open(files).value();
}

TinyStation::TinyStation(const std::string& address,
                         const std::shared_ptr<grpc::ChannelCredentials>& credentials,
                         const std::string& expected_host) {
  grpc::ChannelArguments arguments;
  SetStationArguments(arguments, LinkPath::kThin, 20'000);  // the test's machine may be slow
  if (!expected_host.empty()) arguments.SetSslTargetNameOverride(expected_host);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // each station connects by itself
  stub_ = link::SensorHead::NewStub(grpc::CreateCustomChannel(address, credentials, arguments));
}

TinyStation::TinyStation(const std::string& address, const std::filesystem::path& keys,
                         const std::string& expected_host)
    : TinyStation(
          address,
          [&] {
            const TlsFiles files = LoadTlsFiles(keys).value();
            return StationCredentials(files, GateOf(files));
          }(),
          expected_host) {}

grpc::Status TinyStation::Ask() {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  link::ListScansReply reply;
  const grpc::Status status = stub_->ListScans(&context, {}, &reply);
  context_ = context.auth_context();
  return status;
}

std::shared_ptr<grpc::ServerCredentials> BareServerCredentials(const std::filesystem::path& keys) {
  grpc::SslServerCredentialsOptions options(
      GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  options.pem_root_certs = Text(keys, kCaFile);
  options.pem_key_cert_pairs = {{Text(keys, kPrivateKeyFile), Text(keys, kCertificateFile)}};
  return grpc::SslServerCredentials(options);
}

std::shared_ptr<grpc::ChannelCredentials> BareChannelCredentials(
    const std::filesystem::path& keys) {
  grpc::SslCredentialsOptions options;
  options.pem_root_certs = Text(keys, kCaFile);
  options.pem_private_key = Text(keys, kPrivateKeyFile);
  options.pem_cert_chain = Text(keys, kCertificateFile);
  return grpc::SslCredentials(options);
}

CapturedLog::CapturedLog() {
  SetLogListener([this](LogLevel level, std::string_view line) {
    if (level < LogLevel::kWarning) return;
    const std::lock_guard lock(mutex_);
    text_ += std::string(line) + "\n";
  });
}

CapturedLog::~CapturedLog() {
  SetLogListener({});
}

std::string CapturedLog::Text() const {
  const std::lock_guard lock(mutex_);
  return text_;
}

}  // namespace foresight
