#include "app/common/link_arguments.h"

namespace foresight {

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

}  // namespace foresight
