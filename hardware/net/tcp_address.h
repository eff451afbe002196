#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

/// Where a device listens: an IPv4 address or a host name, and a port.
struct TcpAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: a listener takes any free one

  /// "10.0.0.2:10940", or "10.0.0.2" for the default port. Fails with kInvalidOptions.
  static Result<TcpAddress> Parse(std::string_view text, std::uint16_t default_port);
  std::string ToText() const;

  bool operator==(const TcpAddress&) const = default;
};

}  // namespace foresight
