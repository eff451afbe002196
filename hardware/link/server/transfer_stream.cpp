#include "hardware/link/server/transfer_stream.h"

#include <thread>

#include "core/base/log.h"
#include "hardware/link/protocol/chunk_messages.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kTransferTick{100};
/// Credit that a station gives on a wide path alone.
constexpr std::int64_t kWideCredit = std::int64_t{1} << 20;

grpc::Status Refusal(const Error& error) {
  return {grpc::StatusCode::FAILED_PRECONDITION, error.message};
}

/// A chunk is never larger than this on the wire, so that any credit lets at least one go.
std::int64_t Cost(const Chunk& chunk) {
  constexpr std::int64_t kAround = 40;
  return static_cast<std::int64_t>(chunk.bytes.size()) + kAround;
}

}  // namespace

grpc::Status TransferStream::Run(const std::atomic<bool>& closing) {
  link::TransferRequest first;
  if (!stream_.Read(&first) || !first.has_start())
    return {grpc::StatusCode::INVALID_ARGUMENT, "a transfer starts with the scan that is wanted"};
  if (const grpc::Status begun = Begin(first.start()); !begun.ok()) return begun;
  grpc::Status sent;
  {
    const std::jthread reader([this] { Read(); });
    sent = Send(closing);
    if (burst_) burst_->StreamGone();
    if (!sent.ok()) LogWarning("{}: scan {}: {}", peer_.name, scan_id_, sent.error_message());
    // The reader waits for a station that has nothing more to say.
    bool gone = false;
    {
      const std::lock_guard lock(mutex_);
      gone = gone_;
    }
    if (!gone) context_.TryCancel();
  }
  return sent;
}

grpc::Status TransferStream::Begin(const link::TransferStart& start) {
  scan_id_ = start.scan_id();
  if (const auto found = shelf_.Find(scan_id_); !found) return Refusal(found.error());
  auto have = ChunkSet::Decode(start.have());
  if (!have) return {grpc::StatusCode::INVALID_ARGUMENT, have.error().message};
  credit_ = start.credit_bytes();
  if (start.burst_key_id() != 0) burst_ = bursts_.Find(start.burst_key_id(), peer_.name);
  // A scan that was asked for this moment may not have begun.
  for (int i = 0; i < 100; ++i) {
    const std::int64_t news = shelf_.News();
    const auto scan = shelf_.Snapshot(scan_id_);
    if (scan) {
      const ScanToSend source{**scan, shelf_.DeviceHealthJson(scan_id_)};
      if (burst_) burst_->Begin(source, *have);
      TakePreferences(start.preferences());
      cache_.Prepare(scan_id_, *have, *preferences_);
      source_.emplace(source, std::move(*have), [this](const ScanToSend& now, const ItemId& id) {
        return cache_.Get(now, id);
      });
      news_ = news;
      LogInfo("{} fetches scan {}", peer_.name, scan_id_);
      return grpc::Status::OK;
    }
    if (scan.error().code != ErrorCode::kState) return Refusal(scan.error());
    shelf_.WaitForNews(news, kTransferTick);
    if (context_.IsCancelled()) break;
  }
  return {grpc::StatusCode::UNAVAILABLE, "the scan has not begun yet: ask again"};
}

void TransferStream::Read() {
  link::TransferRequest request;
  while (stream_.Read(&request) && still_good_()) {
    const std::lock_guard lock(mutex_);
    if (request.has_preferences()) TakePreferences(request.preferences());
    if (request.has_acknowledge()) TakeAcknowledge(request.acknowledge());
    wake_.notify_all();
  }
  if (burst_ && !still_good_()) burst_->End();
  const std::lock_guard lock(mutex_);
  gone_ = true;
  wake_.notify_all();
}

void TransferStream::TakePreferences(const link::TransferPreferences& preferences) {
  TransferPreferences taken = FromMessage(preferences);
  paused_ = preferences.pause();
  if (burst_) burst_->SetPreferences(taken, paused_);
  preferences_ = std::move(taken);
}

void TransferStream::TakeAcknowledge(const link::Acknowledge& acknowledge) {
  for (const link::ChunkId& id : acknowledge.chunks()) {
    answered_ = true;
    const auto found = sent_.find({static_cast<ChunkKind>(id.kind()), id.item(), id.part()});
    if (found == sent_.end()) continue;
    in_flight_ -= found->second;
    cache_.Acknowledged(scan_id_, found->first);
    sent_.erase(found);
  }
  if (auto have = ChunkSet::Decode(acknowledge.have()); have && !acknowledge.have().empty()) {
    if (burst_) burst_->SetHave(*have);
    have_ = std::move(*have);
  }
  if (acknowledge.credit_bytes() > 0) credit_ = acknowledge.credit_bytes();
  if (acknowledge.all()) confirmed_ = true;
}

/// Takes over what the scan has gained.
Status TransferStream::Refresh() {
  const std::int64_t news = shelf_.News();
  if (news == news_) return {};
  FORESIGHT_TRY(const auto scan, shelf_.Snapshot(scan_id_));
  source_->Update(ScanToSend{*scan, shelf_.DeviceHealthJson(scan_id_)});
  news_ = news;
  return {};
}

/// Waits a little where nothing may be sent.
bool TransferStream::MaySend() {
  std::unique_lock lock(mutex_);
  const auto may = [this] {
    return gone_ || confirmed_ || (!paused_ && (in_flight_ == 0 || in_flight_ < credit_));
  };
  if (!may()) {
    lock.unlock();
    Flush();
    lock.lock();
  }
  return wake_.wait_for(lock, kTransferTick, may);
}

/// On a wide path gRPC may gather what follows at once: to wait until each chunk is on the wire
/// costs two changes of threads, which others of this computer make long. Not before the station
/// answered: as long as HTTP/2's window is a new connection's 64 KB, a chunk that is to be gathered
/// waits for room that no byte on the wire makes. False where the stream broke.
bool TransferStream::Write(link::Chunk message) {
  bool wide = false;
  {
    const std::lock_guard lock(mutex_);
    wide = answered_ && credit_ >= kWideCredit;
  }
  if (!wide) return Flush() && stream_.Write(message);
  const bool good = !held_ || stream_.Write(*held_, grpc::WriteOptions().set_buffer_hint());
  held_ = std::move(message);
  return good;
}

/// Sends the last chunk, and with it whatever was gathered.
bool TransferStream::Flush() {
  const bool good = !held_ || stream_.Write(*held_);
  held_.reset();
  return good;
}

grpc::Status TransferStream::Send(const std::atomic<bool>& closing) {
  while (!closing && !context_.IsCancelled()) {
    const bool may = MaySend();
    {
      const std::lock_guard lock(mutex_);
      if (confirmed_) return Confirm();
      if (gone_) return grpc::Status::OK;
      if (preferences_) {
        cache_.SetPreferences(scan_id_, *preferences_);
        source_->SetPreferences(*std::exchange(preferences_, std::nullopt));
      }
      if (have_) source_->AddHave(*std::exchange(have_, std::nullopt));
    }
    if (!may) continue;
    if (const Status fresh = Refresh(); !fresh) return Refusal(fresh.error());
    auto chunk = source_->Next();
    if (!chunk) {
      LogError("scan {}: {}", scan_id_, chunk.error().message);
      continue;
    }
    if (!*chunk) {
      if (!Flush()) return grpc::Status::OK;
      shelf_.WaitForNews(news_, std::chrono::milliseconds(20));
      continue;
    }
    {
      const std::lock_guard lock(mutex_);
      in_flight_ += Cost(**chunk);
      sent_[(*chunk)->id] = Cost(**chunk);
    }
    link::Chunk message = ToMessage(std::move(**chunk));
    message.set_left_bytes(source_->LeftBytes());
    if (!Write(std::move(message))) return grpc::Status::OK;
  }
  return grpc::Status::OK;
}

/// With the mutex held.
grpc::Status TransferStream::Confirm() {
  if (!peer_.may_operate) return grpc::Status::OK;
  if (burst_) burst_->End();
  const Status confirmed = shelf_.Confirm(scan_id_, peer_.name);
  if (!confirmed) return Refusal(confirmed.error());
  cache_.Forget(scan_id_);
  LogInfo("{} has all of scan {}", peer_.name, scan_id_);
  return grpc::Status::OK;
}

}  // namespace foresight
