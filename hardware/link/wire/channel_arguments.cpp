#include "hardware/link/wire/channel_arguments.h"

#include <grpc/impl/codegen/grpc_types.h>
#include <grpcpp/server_builder.h>
#include <grpcpp/support/channel_arguments.h>

#include <utility>

namespace foresight {
namespace {

struct PathTimes {
  int keepalive_ms;
  int keepalive_timeout_ms;
  int reconnect_ms;
  int connect_ms;
};

PathTimes TimesOf(LinkPath path) {
  // Bursts: measured over blackouts of 10 to 25 s (hardware.md, section 4). Thin: the 4 s of a
  // connection and of a full queue, with a margin of two to five.
  if (path == LinkPath::kThin) return {10'000, 10'000, 1'000, 20'000};
  return {1'000, 1'000, 250, 250};
}

/// BDP probing opens the window to 16 MB: the sender was 22 MB ahead of a slow reader, and what was
/// urgent waited behind that. Without it and with 64 KiB of lookahead it is one message ahead. The
/// lookahead alone is ignored while BDP probing is on (gRPC issue 14252).
template <class Set>
void SetWindow(const Set& set) {
  set(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  set(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, 64 << 10);
}

}  // namespace

void SetStationArguments(grpc::ChannelArguments& arguments, LinkPath path) {
  const PathTimes times = TimesOf(path);
  const auto set = [&](const char* name, int value) { arguments.SetInt(name, value); };
  set(GRPC_ARG_KEEPALIVE_TIME_MS, times.keepalive_ms);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, times.keepalive_timeout_ms);
  set(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // as many as it takes
  set(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, times.reconnect_ms);
  set(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, times.reconnect_ms);
  set(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, times.connect_ms);  // is how long an attempt may last
  SetWindow(set);
  arguments.SetMaxReceiveMessageSize(kLargestMessageBytes);
}

void SetHeadArguments(grpc::ServerBuilder& builder) {
  constexpr int kKeepaliveMs = 10'000;
  constexpr int kHandshakeMs = 20'000;
  const auto set = [&](const char* name, int value) { builder.AddChannelArgument(name, value); };
  // A server that allows less answers pings of 1 s with GOAWAY, and the station
  // then doubles its interval without a word (hardware.md, section 4).
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 500);
  set(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveMs);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveMs);
  set(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  set(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshakeMs);
  set(GRPC_ARG_ALLOW_REUSEPORT, 0);
  SetWindow(set);
  builder.SetMaxReceiveMessageSize(kLargestMessageBytes);
}

}  // namespace foresight
