#pragma once

#include <memory>
#include <string>

#include "hardware/link/server/head_service.h"

namespace grpc {
class Server;
class ServerCredentials;
}  // namespace grpc

namespace foresight {

/// A head that listens: the service on a port.
class HeadServer {
 public:
  /// `address` is HOST:PORT; port 0 = a free one. `desk` outlives it. Fails with kIo where the port
  /// is taken or the address is none of this computer.
  static Result<std::unique_ptr<HeadServer>> Start(
      HeadDesk& desk, const std::string& address,
      const std::shared_ptr<grpc::ServerCredentials>& credentials, PeerReader peer);
  /// Ends all streams; calls under way have two seconds.
  ~HeadServer();

  int port() const { return port_; }

 private:
  HeadServer(HeadDesk& desk, PeerReader peer);

  HeadService service_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace foresight
