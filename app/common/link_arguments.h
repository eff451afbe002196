#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/base/result.h"

namespace foresight {

/// How to reach a head over the link, as the command line says it.
struct LinkArguments {
  std::string head;        ///< HOST or HOST:PORT; empty = no link
  std::string name;        ///< of the head's certificate; empty = it has the address
  std::string keys;        ///< folder; empty = the user's
  bool plaintext = false;  ///< on this computer only
  bool thin = false;       ///< the path carries some kilobits a second
  std::string burst_port;  ///< PORT or HOST:PORT of this computer; empty = no burst path
};

/// A head listens there unless it is told otherwise.
inline constexpr int kLinkPort = 47130;

/// "host" -> "host:47130"; "[::1]" and "[::1]:5" too. Fails with kInvalidOptions.
Result<std::string> LinkAddress(const std::string& text);

/// The host of HOST:PORT, without the brackets of an IPv6 address.
std::string HostOf(const std::string& address);

/// --head and what goes with it; returns the option --head.
CLI::Option* AddLinkOptions(CLI::App& command, LinkArguments& arguments);

}  // namespace foresight
