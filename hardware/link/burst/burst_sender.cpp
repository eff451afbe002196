#include "hardware/link/burst/burst_sender.h"

#include <cmath>

#include "core/base/log.h"
#include "hardware/link/burst/burst_pace.h"

namespace foresight {
namespace {

/// So much time may be made good at once: a thread is woken up late on a busy computer.
constexpr double kSlack_s = 0.01;
constexpr std::size_t kSendBufferBytes = std::size_t{1} << 20;

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::uint32_t StrideFor(std::size_t datagram_bytes) {
  return static_cast<std::uint32_t>(datagram_bytes - kDatagramSealBytes - kFragmentHeadBytes);
}

}  // namespace

Status BurstSenderOptions::Check() const {
  if (datagram_bytes < kLeastDatagramBytes || datagram_bytes > kMostDatagramBytes)
    return Fail(ErrorCode::kInvalidOptions, "datagram_bytes = {}: must be {} to {}", datagram_bytes,
                kLeastDatagramBytes, kMostDatagramBytes);
  if (!std::isfinite(bytes_per_s) || bytes_per_s < 1e3 || bytes_per_s > 1.25e9)
    return Fail(ErrorCode::kInvalidOptions, "bytes_per_s = {}: must be 1e3 to 1.25e9", bytes_per_s);
  if (to.port == 0) return Fail(ErrorCode::kInvalidOptions, "port = 0: must be 1 to 65535");
  return {};
}

Result<std::unique_ptr<BurstSender>> BurstSender::Start(const BurstSenderOptions& options,
                                                        const BurstKey& key, Source source) {
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(DatagramSocket socket, DatagramSocket::Bind({"0.0.0.0", 0}));
  FORESIGHT_TRY(DatagramSealer sealer, DatagramSealer::Make(key));
  socket.SetBuffers(kSendBufferBytes);
  return std::unique_ptr<BurstSender>(
      new BurstSender(options, std::move(socket), std::move(sealer), std::move(source)));
}

BurstSender::BurstSender(const BurstSenderOptions& options, DatagramSocket socket,
                         DatagramSealer sealer, Source source)
    : options_(options),
      stride_(StrideFor(options.datagram_bytes)),
      socket_(std::move(socket)),
      sealer_(std::move(sealer)),
      source_(std::move(source)),
      sealed_(DatagramSocket::kAtOnce),
      thread_([this](const std::stop_token& stop) { Work(stop); }) {}

/// Moves on to the next fragment of the chunk, or of the next chunk.
bool BurstSender::NextFragment(bool wait, const std::stop_token& stop) {
  if (now_.chunk && ++fragment_ < FragmentCount(*now_.chunk, stride_)) return true;
  now_ = source_(wait, stop);
  fragment_ = 0;
  return now_.chunk != nullptr;
}

/// As many datagrams as go with one call; none where a stop was requested.
Status BurstSender::SealSome(const std::stop_token& stop) {
  count_ = bytes_ = 0;
  while (count_ < sealed_.size() && NextFragment(count_ == 0, stop)) {
    WriteFragment(now_.scan_tag, *now_.chunk, stride_, fragment_, content_);
    FORESIGHT_CHECK(sealer_.Seal(content_, sealed_[count_]));
    bytes_ += sealed_[count_++].size() + kWireBytesAroundDatagram;
  }
  return {};
}

void BurstSender::Work(const std::stop_token& stop) {
  BurstPace pace(options_.bytes_per_s, kSlack_s * options_.bytes_per_s);
  bool refused = false;
  while (!stop.stop_requested()) {
    if (const Status sealed = SealSome(stop); !sealed) {
      LogError("{}", sealed.error().message);
      return;
    }
    if (count_ == 0) continue;
    const double wait_s = pace.Take(static_cast<double>(bytes_), Now());
    if (wait_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
    const Status sent = socket_.Send(sealed_, count_, options_.to);
    // An interface may be down between bursts.
    if (!sent && !refused) LogWarning("burst path: {}: it is tried again", sent.error().message);
    refused = !sent;
    if (sent) sent_bytes_ += static_cast<std::int64_t>(bytes_);
  }
}

}  // namespace foresight
