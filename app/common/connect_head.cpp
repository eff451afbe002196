#include "app/common/connect_head.h"

#include <grpcpp/security/credentials.h>

#include <cstdlib>

#include "hardware/link/client/remote_head.h"
#include "hardware/link/pki/link_role.h"
#include "hardware/link/wire/credentials.h"
#include "hardware/link/wire/grpc_log.h"
#include "hardware/link/wire/station_channels.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kConnect{15'000};
constexpr std::chrono::milliseconds kStop{60'000};

std::filesystem::path SpoolFolder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state != '\0') return std::filesystem::path(state) / "foresight/link";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : "/tmp") / ".local/state/foresight/link";
}

Result<std::shared_ptr<grpc::ChannelCredentials>> CredentialsFor(const LinkArguments& arguments,
                                                                 const std::string& address) {
  if (arguments.plaintext) return PlaintextStationCredentials(HostOf(address));
  const std::filesystem::path keys =
      arguments.keys.empty() ? KeyFolderOfStation() : std::filesystem::path(arguments.keys);
  FORESIGHT_TRY(const TlsFiles files, LoadTlsFilesOfStation(keys));
  FORESIGHT_TRY(auto gate, CertificateGate::Open(files));
  return StationCredentials(files, std::move(gate));
}

Result<std::vector<ChannelMaker>> ChannelsFor(const LinkArguments& arguments,
                                              const std::string& address) {
  FORESIGHT_TRY(const auto credentials, CredentialsFor(arguments, address));
  SendGrpcLogToOurs();
  std::string certificate_host;
  if (!arguments.name.empty()) {
    FORESIGHT_CHECK(CheckLinkName(LinkRole::kHead, arguments.name));
    certificate_host = StableHostOfHead(arguments.name);
  }
  const LinkPath path = arguments.thin ? LinkPath::kThin : LinkPath::kBursts;
  return StationChannels(address, credentials, path, certificate_host);
}

/// "47131" or "10.0.0.2:47131". Fails with kInvalidOptions.
Result<BurstClient::Options> BurstOptions(const std::string& text) {
  BurstClient::Options options;
  const std::size_t colon = text.rfind(':');
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  if (colon != std::string::npos) options.host = text.substr(0, colon);
  const bool digits = !port.empty() && port.size() <= 5 &&
                      port.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoi(port) < 1 || std::stoi(port) > 65535)
    return Fail(ErrorCode::kInvalidOptions, "--burst-port '{}': '{}' is no port (1 to 65535)", text,
                port);
  if (colon != std::string::npos)
    if (const auto ip = UnicastIp(options.host); !ip)
      return Fail(ErrorCode::kInvalidOptions, "--burst-port {}", ip.error().message);
  options.port = std::stoi(port);
  return options;
}

}  // namespace

Result<HeadStatus> StopHeadAt(const LinkArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const std::string address, LinkAddress(arguments.head));
  FORESIGHT_TRY(auto channels, ChannelsFor(arguments, address));
  LinkSession session(std::move(channels), address);
  return StopHead(session, kStop, context);
}

Result<std::shared_ptr<RemoteHead>> ConnectHead(const LinkArguments& arguments, HeadUse use,
                                                std::shared_ptr<ScanArchive> archive,
                                                const std::string& spool) {
  FORESIGHT_TRY(const std::string address, LinkAddress(arguments.head));
  FORESIGHT_TRY(auto channels, ChannelsFor(arguments, address));
  RemoteHead::Options options;
  if (!arguments.burst_port.empty()) {
    FORESIGHT_TRY(options.burst, BurstOptions(arguments.burst_port));
  }
  options.address = address;
  options.status_rate_hz = arguments.thin ? 0.5 : 10.0;
  options.thin = arguments.thin;
  options.looks_on = use == HeadUse::kRead;
  options.spool = spool.empty() ? SpoolFolder() : std::filesystem::path(spool);
  options.archive = std::move(archive);
  return RemoteHead::Connect(std::move(channels), options, kConnect);
}

Result<std::shared_ptr<RemoteHead>> LookAtHead(const LinkArguments& arguments) {
  return ConnectHead(arguments, HeadUse::kRead, nullptr, "/dev/null/spool");  // takes nothing
}

}  // namespace foresight
