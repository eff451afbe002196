#include "hardware/link/wire/channel_arguments.h"

#include <grpc/impl/codegen/grpc_types.h>
#include <grpcpp/server_builder.h>
#include <grpcpp/support/channel_arguments.h>

#include <utility>

namespace foresight {
namespace {

/// A channel that lost the race closes its connection after this time.
constexpr int kUnusedMs = 1'000;

/// BDP probing opens the window to 16 MB: the sender was 22 MB ahead of a slow reader, and what was
/// urgent waited behind that. Without it the lookahead holds; it is ignored while BDP probing is on
/// (gRPC issue 14252).
template <class Set>
void SetWindow(const Set& set, int lookahead_bytes) {
  set(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  set(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, lookahead_bytes);
}
/// One message ahead.
constexpr int kLittleAhead = 64 << 10;
/// What 300 Mbit/s carry in a round trip of 100 ms. What a scan's stream is ahead of its reader is
/// bounded by the credit of the transfer, which knows the path's rate.
constexpr int kFarAhead = 4 << 20;

}  // namespace

std::vector<int> AttemptsOn(LinkPath path) {
  // The 4 s of a connection behind a full queue, with a margin.
  if (path == LinkPath::kThin) return {20'000};
  // gRPC tries every 100 ms at most: eight side by side find a window after 11 ms on average. For
  // round trips of up to 30, 130 and 500 ms.
  std::vector<int> attempts_ms(8, 100);
  attempts_ms.insert(attempts_ms.end(), {400, 1'500});
  return attempts_ms;
}

void SetStationArguments(grpc::ChannelArguments& arguments, LinkPath path, int attempt_ms) {
  // Bursts: measured over blackouts of 10 to 25 s (docs/performance.md, "The link through
  // blackouts").
  const bool thin = path == LinkPath::kThin;
  const int keepalive_ms = thin ? 10'000 : 1'000;
  const int pause_ms = thin ? 1'000 : attempt_ms;
  const auto set = [&](const char* name, int value) { arguments.SetInt(name, value); };
  set(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // channels of the same arguments would be one
  set(GRPC_ARG_KEEPALIVE_TIME_MS, keepalive_ms);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, keepalive_ms);
  set(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // as many as it takes
  set(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, pause_ms);
  set(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, pause_ms);
  set(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, attempt_ms);  // is how long an attempt may last
  set(GRPC_ARG_CLIENT_IDLE_TIMEOUT_MS, kUnusedMs);
  SetWindow(set, thin ? kLittleAhead : kFarAhead);
  arguments.SetMaxReceiveMessageSize(kLargestMessageBytes);
}

void SetHeadArguments(grpc::ServerBuilder& builder) {
  constexpr int kKeepaliveMs = 10'000;
  constexpr int kHandshakeMs = 20'000;
  constexpr int kGatheredBytes = 256 << 10;  // of chunks that follow at once, on a wide path
  const auto set = [&](const char* name, int value) { builder.AddChannelArgument(name, value); };
  // A server that allows less answers pings of 1 s with GOAWAY, and the station
  // then doubles its interval without a word (docs/performance.md).
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 500);
  set(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveMs);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveMs);
  set(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  set(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshakeMs);
  set(GRPC_ARG_ALLOW_REUSEPORT, 0);
  set(GRPC_ARG_HTTP2_WRITE_BUFFER_SIZE, kGatheredBytes);
  SetWindow(set, kLittleAhead);
  builder.SetMaxReceiveMessageSize(kLargestMessageBytes);
}

}  // namespace foresight
