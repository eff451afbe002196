#include "app/common/link_arguments.h"

#include <grpcpp/security/credentials.h>

#include <cstdlib>

#include "hardware/link/pki/link_role.h"
#include "hardware/link/wire/credentials.h"
#include "hardware/link/wire/grpc_log.h"
#include "hardware/link/wire/station_channels.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kConnect{15'000};

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

}  // namespace

std::string HostOf(const std::string& address) {
  std::string host = address.substr(0, address.rfind(':'));
  if (host.size() > 2 && host.front() == '[' && host.back() == ']')
    host = host.substr(1, host.size() - 2);
  return host;
}

Result<std::string> LinkAddress(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::size_t bracket = text.rfind(']');
  const bool has_port = colon != std::string::npos &&
                        (bracket == std::string::npos || colon > bracket) &&
                        (bracket != std::string::npos || text.find(':') == colon);
  if (text.empty() || (!has_port && bracket == std::string::npos && colon != std::string::npos))
    return Fail(ErrorCode::kInvalidOptions,
                "--head '{}': is no HOST or HOST:PORT (an IPv6 address stands in brackets)", text);
  if (!has_port) return fmt::format("{}:{}", text, kLinkPort);
  const std::string port = text.substr(colon + 1);
  const bool digits = !port.empty() && port.size() <= 5 &&
                      port.find_first_not_of("0123456789") == std::string::npos;
  if (colon == 0 || !digits || std::stoi(port) < 1 || std::stoi(port) > 65535)
    return Fail(ErrorCode::kInvalidOptions, "--head '{}': '{}' is no port (1 to 65535)", text,
                port);
  return text;
}

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

CLI::Option* AddLinkOptions(CLI::App& command, LinkArguments& arguments) {
  CLI::Option* head = command.add_option(
      "--head", arguments.head, "A head at the far end of a link, HOST or HOST:PORT (port 47130)");
  CLI::Option* keys =
      command
          .add_option("--link-keys", arguments.keys,
                      "Folder of this station's keys (default: ~/.config/foresight/link)")
          ->needs(head);
  command
      .add_option("--head-name", arguments.name,
                  "The head's certificate must have this name (default: the address of --head)")
      ->needs(head);
  command
      .add_flag("--plaintext", arguments.plaintext,
                "Without encryption, for a head on this computer only")
      ->needs(head)
      ->excludes(keys);
  command
      .add_flag("--thin-link", arguments.thin, "The path carries some kilobits a second at most")
      ->needs(head);
  command
      .add_option("--burst-port", arguments.burst_port,
                  "UDP port for bursts of a one-way path from the head, beside the link; HOST:PORT "
                  "names the address of this computer on it")
      ->needs(head);
  return head;
}

Result<std::shared_ptr<RemoteHead>> ConnectHead(const LinkArguments& arguments,
                                                std::shared_ptr<ScanArchive> archive,
                                                const std::string& spool) {
  FORESIGHT_TRY(const std::string address, LinkAddress(arguments.head));
  FORESIGHT_TRY(const auto credentials, CredentialsFor(arguments, address));
  RemoteHead::Options options;
  if (!arguments.burst_port.empty()) {
    FORESIGHT_TRY(options.burst, BurstOptions(arguments.burst_port));
  }
  SendGrpcLogToOurs();
  std::string certificate_host;
  if (!arguments.name.empty()) {
    FORESIGHT_CHECK(CheckLinkName(LinkRole::kHead, arguments.name));
    certificate_host = StableHostOfHead(arguments.name);
  }
  const LinkPath path = arguments.thin ? LinkPath::kThin : LinkPath::kBursts;
  options.address = address;
  options.status_rate_hz = arguments.thin ? 0.5 : 10.0;
  options.thin = arguments.thin;
  options.spool = spool.empty() ? SpoolFolder() : std::filesystem::path(spool);
  options.archive = std::move(archive);
  return RemoteHead::Connect(StationChannels(address, credentials, path, certificate_host), options,
                             kConnect);
}

}  // namespace foresight
