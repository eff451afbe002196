#include "app/head/listen.h"

#include <grpcpp/security/auth_context.h>
#include <grpcpp/security/server_credentials.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <thread>

#include "app/common/link_arguments.h"
#include "app/common/output.h"
#include "hardware/link/discovery/head_announcement.h"
#include "hardware/link/robot/robot_socket.h"
#include "hardware/link/server/head_server.h"
#include "hardware/link/wire/credentials.h"
#include "hardware/link/wire/grpc_log.h"
#include "hardware/link/wire/peer.h"

namespace foresight {
namespace {

std::filesystem::path ScansFolder() {
  const char* data = std::getenv("XDG_DATA_HOME");
  if (data != nullptr && *data != '\0') return std::filesystem::path(data) / "foresight/head";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : "/tmp") / ".local/share/foresight/head";
}

struct Door {
  std::shared_ptr<grpc::ServerCredentials> credentials;
  PeerReader peer;
  std::string name;  ///< of the head's certificate; empty without encryption
};

Result<Door> MakeDoor(const ListenArguments& arguments) {
  Door door;
  std::shared_ptr<CertificateGate> gate;
  if (arguments.plaintext) {
    FORESIGHT_TRY(door.credentials, PlaintextHeadCredentials(HostOf(arguments.address)));
  } else {
    const std::filesystem::path keys =
        arguments.keys.empty() ? KeyFolderOfHead() : std::filesystem::path(arguments.keys);
    FORESIGHT_TRY(const TlsFiles files, LoadTlsFilesOfHead(keys));
    FORESIGHT_TRY(gate, CertificateGate::Open(files));
    door.name = files.certificate.identity.name;
    door.credentials = HeadCredentials(files, gate);
  }
  door.peer = [gate](const grpc::ServerContext& context) -> Result<HeadDesk::Peer> {
    FORESIGHT_TRY(const LinkIdentity identity, CheckPeer(*context.auth_context(), gate.get()));
    return HeadDesk::Peer{identity.name, identity.role == LinkRole::kOperator};
  };
  return door;
}

/// On the local network, where stations of other computers can connect and know whom they reach.
class Announcement {
 public:
  Announcement(const ListenArguments& arguments, const std::string& name, int port,
               bool simulated) {
    if (arguments.announce && !name.empty() && !IsLoopback(HostOf(arguments.address)))
      announcement_.emplace(name, static_cast<std::uint16_t>(port), simulated);
  }

  /// Says once what keeps stations from finding the head.
  void NoteTrouble() {
    if (!announcement_) return;
    const std::string trouble = announcement_->Trouble();
    if (trouble != noted_ && !trouble.empty())
      PrintNote("stations have to type this head's address: {}", trouble);
    noted_ = trouble;
  }

 private:
  std::optional<HeadAnnouncement> announcement_;
  std::string noted_;
};

}  // namespace

Result<ExitCode> Listen(std::shared_ptr<SensorHead> head, bool simulated, MovingStand* stand,
                        const ListenArguments& arguments, const RunContext& context) {
  SendGrpcLogToOurs();
  FORESIGHT_TRY(const Door door, MakeDoor(arguments));
  const std::filesystem::path folder =
      arguments.scans.empty() ? ScansFolder() : std::filesystem::path(arguments.scans);
  FORESIGHT_TRY(const auto shelf, ScanShelf::Open({folder, arguments.disk_ratio}));
  std::unique_ptr<RobotSocket> robot;
  std::optional<PoseGate> gate;
  if (!arguments.robot_socket.empty()) {
    RobotSocketOptions options;
    options.path = arguments.robot_socket;
    FORESIGHT_TRY(robot, RobotSocket::Listen(options));
    gate.emplace(PoseGateOptions(),
                 [&robot](const PoseMessage& message) { return robot->Send(message); });
    PrintNote("poses go to whoever connects to {}", robot->path().string());
  }
  HeadDesk desk(head, *shelf,
                {arguments.lease_s, simulated, gate ? &*gate : nullptr,
                 arguments.burst_mbit_s * 1e6 / 8.0, stand});
  FORESIGHT_TRY(const auto server,
                HeadServer::Start(desk, arguments.address, door.credentials, door.peer));
  const std::string host = arguments.address.substr(0, arguments.address.rfind(':'));
  PrintNote("{}: listening on {}:{}{}; scans in {}", head->Describe(), host, server->port(),
            arguments.plaintext ? " without encryption" : "", folder.string());
  if (arguments.json)
    PrintJson({{"address", fmt::format("{}:{}", host, server->port())}, {"pid", getpid()}});
  Announcement announcement(arguments, door.name, server->port(), simulated);
  while (!context.Cancelled()) {
    announcement.NoteTrouble();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  PrintNote("{}: no longer listening", head->Describe());
  return ExitCode::kDone;
}

}  // namespace foresight
