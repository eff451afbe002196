#pragma once

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
  /// Wide, or wide in bursts of a second between blackouts. 92 to 100 % of each burst is used:
  /// keepalive 1 + 1 s, an attempt to connect lasts 250 ms and the next one follows at once (ADR
  /// 0015).
  kBursts,
  /// Some kilobits a second. A connection takes 4.0 s to make at 9600 bit/s, and a
  /// reply may queue behind a chunk for as long: kBursts would never connect.
  kThin,
};

/// Of a station's channel.
void SetStationArguments(grpc::ChannelArguments& arguments, LinkPath path);

/// Of a head's server, for stations on either path: their pings are allowed; a handshake that does
/// not end is cut off after 20 s; a port that is taken is an error.
void SetHeadArguments(grpc::ServerBuilder& builder);

}  // namespace foresight
