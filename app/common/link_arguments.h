#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "hardware/link/client/remote_head.h"

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

/// "47131" or "10.0.0.2:47131". Fails with kInvalidOptions.
Result<BurstClient::Options> BurstOptions(const std::string& text);

/// --head and what goes with it; returns the option --head.
CLI::Option* AddLinkOptions(CLI::App& command, LinkArguments& arguments);

/// Connects to the head. `spool` is the folder for what has come of scans that are not whole; empty
/// = the user's.
Result<std::shared_ptr<RemoteHead>> ConnectHead(const LinkArguments& arguments,
                                                std::shared_ptr<ScanArchive> archive,
                                                const std::string& spool = "");

}  // namespace foresight
