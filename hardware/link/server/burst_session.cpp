#include "hardware/link/server/burst_session.h"

#include "core/base/log.h"
#include "hardware/link/chunks/scan_items.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kBurstTick{100};
/// Where little is left it is not sent more often: a burst lasts for a second.
constexpr std::chrono::milliseconds kShortestRound{20};

}  // namespace

Result<std::shared_ptr<BurstSession>> BurstSession::Open(ScanShelf& shelf, const std::string& owner,
                                                         const BurstSenderOptions& options,
                                                         double linger_s) {
  FORESIGHT_TRY(const BurstKey key, BurstKey::Make());
  auto session = std::shared_ptr<BurstSession>(new BurstSession(shelf, owner, key, linger_s));
  BurstSession* raw = session.get();
  FORESIGHT_TRY(session->sender_,
                BurstSender::Start(options, key, [raw](bool wait, const std::stop_token& stop) {
                  return raw->Next(wait, stop);
                }));
  session->encoder_ = std::jthread([raw](const std::stop_token& stop) { raw->Encode(stop); });
  return session;
}

/// With the mutex held.
bool BurstSession::OverNow() const {
  const std::chrono::duration<double> alone = std::chrono::steady_clock::now() - left_;
  return ended_ || (!attended_ && alone.count() > linger_s_);
}

bool BurstSession::Over() const {
  const std::lock_guard lock(mutex_);
  return OverNow();
}

void BurstSession::Begin(const ScanToSend& source, const ChunkSet& have) {
  const std::lock_guard lock(mutex_);
  carousel_.emplace(source, have);
  scan_tag_ = BurstScanTag(source.scan.uuid);
  attended_ = true;
  wake_.notify_all();
}

void BurstSession::SetHave(const ChunkSet& have) {
  const std::lock_guard lock(mutex_);
  if (carousel_) carousel_->SetHave(have);
}

void BurstSession::SetPreferences(const TransferPreferences& preferences, bool paused) {
  const std::lock_guard lock(mutex_);
  TransferPreferences ours = preferences;
  ours.bytes_per_s = 0.0;  // that is the stream's path; this one is wide
  if (carousel_) carousel_->SetPreferences(ours);
  paused_ = paused;
  wake_.notify_all();
}

void BurstSession::StreamGone() {
  const std::lock_guard lock(mutex_);
  attended_ = false;
  left_ = std::chrono::steady_clock::now();
}

void BurstSession::End() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  carousel_.reset();
}

ChunkToBurst BurstSession::Next(bool wait, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const bool sends = carousel_ && !paused_ && !OverNow();
    if (sends)
      if (auto chunk = carousel_->Next()) return {scan_tag_, std::move(chunk)};
    if (!wait) return {};
    const auto now = std::chrono::steady_clock::now();
    if (!sends) {
      wake_.wait_for(lock, stop, kBurstTick, [] { return false; });
    } else if (now < round_began_ + kShortestRound) {
      wake_.wait_until(lock, stop, round_began_ + kShortestRound, [] { return false; });
    } else {
      round_began_ = now;
      carousel_->BeginRound();
    }
  }
  return {};
}

/// Takes over what the scan has gained.
void BurstSession::Refresh() {
  const std::int64_t news = shelf_.News();
  if (news == news_) return;
  std::string scan_id;
  {
    const std::lock_guard lock(mutex_);
    if (!carousel_) return;
    scan_id = carousel_->source().scan.uuid;
  }
  const auto scan = shelf_.Snapshot(scan_id);
  if (!scan) return;  // the stream tells the station
  const ScanToSend source{**scan, shelf_.DeviceHealthJson(scan_id)};
  const std::lock_guard lock(mutex_);
  if (!carousel_ || carousel_->source().scan.uuid != scan_id) return;
  carousel_->Update(source);
  news_ = news;
}

/// Whether there was something to encode.
bool BurstSession::EncodeOne() {
  std::optional<ItemId> id;
  std::optional<ScanToSend> source;
  {
    const std::lock_guard lock(mutex_);
    if (!carousel_ || OverNow()) return false;
    id = carousel_->NextToEncode();
    if (!id) return false;
    source = carousel_->source();
  }
  const auto bytes = EncodeItem(*source, *id);
  auto parts = bytes ? SplitItem(*id, *bytes) : tl::unexpected(bytes.error());
  if (!parts) LogError("scan {}: {}", source->scan.uuid, parts.error().message);
  const std::lock_guard lock(mutex_);
  if (!carousel_ || carousel_->source().scan.uuid != source->scan.uuid) return true;
  if (parts)
    carousel_->Add(*id, std::move(*parts));
  else
    carousel_->LeaveOut(*id);
  return true;
}

void BurstSession::Encode(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Refresh();
    if (!EncodeOne()) shelf_.WaitForNews(shelf_.News(), kBurstTick);
  }
}

}  // namespace foresight
