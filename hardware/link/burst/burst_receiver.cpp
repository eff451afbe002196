#include "hardware/link/burst/burst_receiver.h"

#include <utility>

#include "core/base/log.h"

namespace foresight {
namespace {

/// 0.1 s at 300 Mbit/s, with what the system keeps around each datagram.
constexpr std::size_t kBufferBytes = std::size_t{8} << 20;
constexpr std::size_t kSmallBufferBytes = std::size_t{2} << 20;
constexpr std::chrono::milliseconds kTick{200};

}  // namespace

Status BurstReader::Expect(const BurstKey& key, const std::string& scan_id, const ChunkSet& have) {
  FORESIGHT_TRY(DatagramOpener opener, DatagramOpener::Make(key));
  opener_.emplace(std::move(opener));
  const std::uint64_t tag = BurstScanTag(scan_id);
  if (tag != scan_tag_) {
    assembler_.Forget();
    waiting_.clear();
    waiting_bytes_ = 0;
  }
  scan_tag_ = tag;
  SetHave(have);
  return {};
}

void BurstReader::SetHave(const ChunkSet& have) {
  here_ = have;
  for (const Chunk& chunk : waiting_) here_.AddPart(chunk);
}

void BurstReader::Take(std::span<const std::uint8_t> datagram) {
  if (!opener_) {
    ++counts_.foreign;
    return;
  }
  switch (opener_->Open(datagram, content_)) {
    case DatagramVerdict::kGood:
      ++counts_.datagrams;
      counts_.bytes += static_cast<std::int64_t>(datagram.size());
      return TakeContent(content_);
    case DatagramVerdict::kNoDatagram:
    case DatagramVerdict::kForeignKey:
      ++counts_.foreign;
      return;
    case DatagramVerdict::kReplayed:
      ++counts_.replayed;
      return;
    case DatagramVerdict::kForged:
      ++counts_.forged;
      return;
  }
}

void BurstReader::TakeContent(std::span<const std::uint8_t> content) {
  const auto fragment = ReadFragment(content);
  if (!fragment) {
    ++counts_.forged;
    return;
  }
  if (fragment->scan_tag != scan_tag_ || here_.HasPart(fragment->id, fragment->item_crc)) return;
  auto chunk = assembler_.Take(*fragment);
  if (!chunk) {
    ++counts_.forged;
    return;
  }
  if (!*chunk || waiting_bytes_ + (*chunk)->bytes.size() > kMostWaitingBytes) return;
  ++counts_.chunks;
  waiting_bytes_ += (*chunk)->bytes.size() + sizeof(Chunk);
  here_.AddPart(**chunk);
  waiting_.push_back(std::move(**chunk));
}

std::vector<Chunk> BurstReader::TakeChunks() {
  waiting_bytes_ = 0;
  return std::exchange(waiting_, {});
}

Result<std::unique_ptr<BurstReceiver>> BurstReceiver::Listen(const TcpAddress& address) {
  FORESIGHT_TRY(DatagramSocket socket, DatagramSocket::Bind(address));
  if (const std::size_t given = socket.SetBuffers(kBufferBytes); given < kSmallBufferBytes)
    LogWarning(
        "burst path: the system keeps only {} kB of datagrams that have come, and loses what "
        "comes meanwhile: sysctl -w net.core.rmem_max={}",
        given / 1000, kBufferBytes);
  return std::unique_ptr<BurstReceiver>(new BurstReceiver(std::move(socket)));
}

BurstReceiver::BurstReceiver(DatagramSocket socket) : socket_(std::move(socket)) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

BurstReceiver::~BurstReceiver() {
  thread_.request_stop();
  wake_.Raise();
}

void BurstReceiver::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_, std::defer_lock);
    socket_.Receive(kTick, &wake_, [&](std::span<const std::uint8_t> datagram) {
      if (!lock.owns_lock()) lock.lock();  // once for all that are there
      const std::int64_t before = reader_.counts().datagrams;
      reader_.Take(datagram);
      if (reader_.counts().datagrams != before) heard_ = std::chrono::steady_clock::now();
    });
  }
}

Status BurstReceiver::Expect(const BurstKey& key, const std::string& scan_id,
                             const ChunkSet& have) {
  const std::lock_guard lock(mutex_);
  heard_ = std::chrono::steady_clock::now();
  return reader_.Expect(key, scan_id, have);
}

void BurstReceiver::SetHave(const ChunkSet& have) {
  const std::lock_guard lock(mutex_);
  reader_.SetHave(have);
}

std::vector<Chunk> BurstReceiver::TakeChunks() {
  const std::lock_guard lock(mutex_);
  return reader_.TakeChunks();
}

BurstCounts BurstReceiver::Counts() const {
  const std::lock_guard lock(mutex_);
  return reader_.counts();
}

double BurstReceiver::SilenceSeconds() const {
  const std::lock_guard lock(mutex_);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - heard_).count();
}

}  // namespace foresight
