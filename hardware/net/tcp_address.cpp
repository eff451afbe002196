#include "hardware/net/tcp_address.h"

#include <charconv>

namespace foresight {

Result<TcpAddress> TcpAddress::Parse(std::string_view text, std::uint16_t default_port) {
  TcpAddress address{std::string(text.substr(0, text.find(':'))), default_port};
  if (const auto colon = text.find(':'); colon != std::string_view::npos) {
    const std::string_view port = text.substr(colon + 1);
    const char* end = port.data() + port.size();
    const auto [stop, error] = std::from_chars(port.data(), end, address.port);
    if (error != std::errc() || stop != end)
      return Fail(ErrorCode::kInvalidOptions, "address {}: '{}' is no port number", text, port);
  }
  if (address.host.empty())
    return Fail(ErrorCode::kInvalidOptions, "address '{}': has no host", text);
  return address;
}

std::string TcpAddress::ToText() const {
  return fmt::format("{}:{}", host, port);
}

}  // namespace foresight
