#include "hardware/link/server/burst_desk.h"

#include <algorithm>
#include <utility>

#include "core/base/log.h"

namespace foresight {
namespace {

/// Of "ipv4:10.0.0.2:51234", as gRPC names who calls.
std::string HostOfCaller(const std::string& address) {
  constexpr std::string_view kScheme = "ipv4:";
  if (address.compare(0, kScheme.size(), kScheme) != 0) return "";
  return address.substr(kScheme.size(), address.rfind(':') - kScheme.size());
}

Result<UdpPeer> DestinationOf(const link::BurstRequest& request, const std::string& address) {
  if (request.port() < 1 || request.port() > 65535)
    return Fail(ErrorCode::kInvalidInput, "burst path: port {}: must be 1 to 65535",
                request.port());
  const std::string host = request.host().empty() ? HostOfCaller(address) : request.host();
  if (host.empty())
    return Fail(ErrorCode::kInvalidInput,
                "burst path: {} is no IPv4 address: name one (--burst-port HOST:PORT)", address);
  const auto ip = UnicastIp(host);
  if (!ip) return Fail(ErrorCode::kInvalidInput, "burst path: {}", ip.error().message);
  return UdpPeer{*ip, static_cast<std::uint16_t>(request.port())};
}

}  // namespace

Result<link::BurstReply> BurstDesk::Open(const link::BurstRequest& request,
                                         const std::string& caller, const std::string& address) {
  if (bytes_per_s_ <= 0.0)
    return Fail(ErrorCode::kState, "this head sends no bursts (its --burst-rate is 0)");
  BurstSenderOptions options;
  options.bytes_per_s = bytes_per_s_;
  if (request.datagram_bytes() != 0)
    options.datagram_bytes =
        static_cast<std::size_t>(std::max<std::int32_t>(0, request.datagram_bytes()));
  FORESIGHT_TRY(options.to, DestinationOf(request, address));
  if (const Status good = options.Check(); !good)
    return Fail(ErrorCode::kInvalidInput, "burst path: {}", good.error().message);
  std::shared_ptr<BurstSession> before;  // declared first: its threads end outside of the lock
  const std::lock_guard lock(mutex_);
  if (session_ && !session_->Over() && session_->owner() != caller)
    return Fail(ErrorCode::kState, "{} has the burst path: a head has one at a time",
                session_->owner());
  FORESIGHT_TRY(auto session, BurstSession::Open(shelf_, caller, options));
  before = std::exchange(session_, session);
  if (before) before->End();
  LogInfo("{}: bursts go to {}.{}.{}.{}:{}{}", caller, options.to.ip >> 24,
          options.to.ip >> 16 & 255, options.to.ip >> 8 & 255, options.to.ip & 255, options.to.port,
          request.host().empty() ? "" : ", as they asked");
  link::BurstReply reply;
  reply.set_key_id(session->key().id);
  reply.set_key(session->key().SecretBytes());
  reply.set_bytes_per_s(static_cast<std::int64_t>(bytes_per_s_));
  return reply;
}

std::shared_ptr<BurstSession> BurstDesk::Find(std::uint32_t key_id,
                                              const std::string& owner) const {
  const std::lock_guard lock(mutex_);
  if (!session_ || session_->key().id != key_id || session_->owner() != owner || session_->Over())
    return nullptr;
  return session_;
}

}  // namespace foresight
