#pragma once

#include <vector>

namespace grpc {
class ChannelArguments;
class ServerBuilder;
}  // namespace grpc

namespace foresight {

/// Largest message that either side takes. Chunks are of 60 kB; what is larger is an image that was
/// asked for.
inline constexpr int kLargestMessageBytes = 16 << 20;

/// What lies between station and head.
enum class LinkPath {
  /// Wide, or wide in bursts of a second between blackouts: keepalive 1 + 1 s, and short attempts
  /// to connect beside longer ones, each followed by the next one at once (ADR 0015).
  kBursts,
  /// Some kilobits a second. A connection takes 4.0 s to make at 9600 bit/s, and a
  /// reply may queue behind a chunk for as long: kBursts would never connect.
  kThin,
};

/// How long attempts to connect last, in milliseconds, each on a channel of its own. A window that
/// opens is found with the next attempt; a connection takes three round trips.
std::vector<int> AttemptsOn(LinkPath path);

/// Of a station's channel.
void SetStationArguments(grpc::ChannelArguments& arguments, LinkPath path, int attempt_ms);

/// Of a head's server, for stations on either path: their pings are allowed; a handshake that does
/// not end is cut off after 20 s; a port that is taken is an error.
void SetHeadArguments(grpc::ServerBuilder& builder);

}  // namespace foresight
