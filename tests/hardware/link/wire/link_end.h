#pragma once

#include <grpcpp/grpcpp.h>

#include <mutex>
#include <optional>
#include <string>

#include "hardware/link/wire/channel_arguments.h"
#include "hardware/link/wire/credentials.h"
#include "sensor_head.grpc.pb.h"
#include "tests/support/link_keys.h"

namespace foresight {

/// A server that only lists scans, of which it has none, and keeps who asked.
class TinyHead : public link::SensorHead::Service {
 public:
  explicit TinyHead(const std::shared_ptr<grpc::ServerCredentials>& credentials,
                    std::shared_ptr<CertificateGate> gate = nullptr);
  explicit TinyHead(const std::filesystem::path& keys);
  ~TinyHead() override;

  int port() const { return port_; }
  std::string Address(const std::string& host = "127.0.0.1") const;
  /// Who made the last call.
  std::optional<LinkIdentity> peer() const;

  grpc::Status ListScans(grpc::ServerContext* context, const link::ListScansRequest*,
                         link::ListScansReply*) override;

 private:
  void Start(const std::shared_ptr<grpc::ServerCredentials>& credentials);

  std::shared_ptr<CertificateGate> gate_;
  mutable std::mutex mutex_;
  std::optional<LinkIdentity> peer_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

/// A gate of the keys in a folder.
std::shared_ptr<CertificateGate> GateOf(const TlsFiles& files);

/// One end of a link that asks once.
class TinyStation {
 public:
  TinyStation(const std::string& address,
              const std::shared_ptr<grpc::ChannelCredentials>& credentials,
              const std::string& expected_host = "");
  /// With the keys in a folder.
  TinyStation(const std::string& address, const std::filesystem::path& keys,
              const std::string& expected_host = "");

  /// A connection that cannot be made ends the call at once.
  grpc::Status Ask();
  std::shared_ptr<const grpc::AuthContext> context() const { return context_; }

 private:
  std::unique_ptr<link::SensorHead::Stub> stub_;
  std::shared_ptr<const grpc::AuthContext> context_;
};

/// What gRPC makes of such files without our gate: an end that checks nothing but the CA.
std::shared_ptr<grpc::ServerCredentials> BareServerCredentials(const std::filesystem::path& keys);
std::shared_ptr<grpc::ChannelCredentials> BareChannelCredentials(const std::filesystem::path& keys);

/// The log's warnings while it exists.
class CapturedLog {
 public:
  CapturedLog();
  ~CapturedLog();
  std::string Text() const;

 private:
  mutable std::mutex mutex_;
  std::string text_;
};

}  // namespace foresight
