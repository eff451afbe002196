#include "hardware/link/client/scan_fetcher.h"

#include <algorithm>
#include <deque>

#include "core/base/log.h"
#include "hardware/link/chunks/chunk_order.h"
#include "hardware/link/client/early_scan.h"
#include "hardware/link/protocol/chunk_messages.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kFetchTick{100};
constexpr std::chrono::milliseconds kNoWait{0};
constexpr std::chrono::milliseconds kFetchPause{20};
constexpr std::chrono::milliseconds kWatch{5};  ///< how late a fresh connection is seen
constexpr double kPause_s = 0.020;
/// What came and was not decoded yet: five windows of a second at 300 Mbit/s, since an image takes
/// longer to read than to come.
constexpr std::int64_t kMostWaiting = std::int64_t{200} << 20;
constexpr double kRetry_s = 0.25;  ///< after the link broke at once, again and again
constexpr double kFirstRetry_s = 0.02;
constexpr double kRetryDisk_s = 2.0;  ///< after this computer's disk did not take something
constexpr double kEarlyEvery_s = 0.3;
constexpr double kLastWord_s = 2.0;  ///< for the word that all is here, at a program's end
constexpr double kConfirm_s = 5.0;   ///< for the head's answer that it heard of the end
/// A sign of life and its answer, 300 bytes with all that is around them, take 0.25 s at 9600
/// bit/s.
constexpr double kWideRoundTrip_s = 0.12;

}  // namespace

/// What the reading thread brings, until the stream ends.
class ScanFetcher::Inbox {
 public:
  /// `left_bytes`: as the stream before said.
  explicit Inbox(std::int64_t left_bytes) : left_bytes_(left_bytes) {}

  void Push(link::Chunk message) {
    const std::lock_guard lock(mutex_);
    left_bytes_ = message.left_bytes();
    if (auto chunk = FromMessage(std::move(message))) chunks_.push_back(*std::move(chunk));
    wake_.notify_all();
  }
  void Close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    wake_.notify_all();
  }
  /// All that has come, waiting so long for the first.
  std::vector<Chunk> TakeAll(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, wait, [this] { return closed_ || !chunks_.empty(); });
    return std::exchange(chunks_, {});
  }
  bool Closed() const {
    const std::lock_guard lock(mutex_);
    return closed_ && chunks_.empty();
  }
  std::int64_t LeftBytes() const {
    const std::lock_guard lock(mutex_);
    return left_bytes_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Chunk> chunks_;
  std::int64_t left_bytes_;
  bool closed_ = false;
};

ScanFetcher::ScanFetcher(LinkSession& session, Options options)
    : session_(session), options_(std::move(options)) {
  if (options_.archive) TakeInSpools();
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

ScanFetcher::~ScanFetcher() {
  // Who ends as soon as a scan's end is here still tells the head that it has all of it.
  const double end_s = LinkSession::Now() + kLastWord_s;
  while (ending_ && session_.Connected() && LinkSession::Now() < end_s)
    std::this_thread::sleep_for(kWatch);
  thread_ = {};
  for (auto& [id, scan] : scans_)
    EndSink(*scan, ScanState::kInterrupted,
            "the program ended before all of the scan had come: the rest is at the head");
}

/// What an earlier run left is fetched behind everything new.
void ScanFetcher::TakeInSpools() {
  const auto spools = ListSpools(options_.spool);
  if (!spools) return LogError("{}", spools.error().message);
  for (const SpoolSummary& spool : *spools) {
    auto scan = std::make_shared<Fetched>();
    scan->header.uuid = scan->shown.scan_id = spool.scan_id;
    scan->command = Fetched::Command::kDoubtful;
    scans_.emplace(spool.scan_id, std::move(scan));
  }
}

void ScanFetcher::Expect(const Scan& header, std::shared_ptr<ScanSink> sink) {
  const std::lock_guard lock(mutex_);
  auto scan = std::make_shared<Fetched>();
  scan->header = header;
  scan->sink = std::move(sink);
  scan->order = ++order_;
  scan->shown.scan_id = header.uuid;
  scan->shown.begin_utc_ns = header.start_utc_ns;
  if (const auto planned = PredictScan(header.plan, header.rig))
    scan->shown.of_lines = planned->lines;
  scans_[header.uuid] = std::move(scan);
  lines_first_.reset();
  newest_ = header.uuid;
  early_.reset();
}

void ScanFetcher::Started(const std::string& scan_id) {
  const std::lock_guard lock(mutex_);
  if (const auto found = scans_.find(scan_id); found != scans_.end())
    found->second->command = Fetched::Command::kTaken;
  wake_.notify_all();
}

void ScanFetcher::Refuse(const std::string& scan_id, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  const auto found = scans_.find(scan_id);
  if (found == scans_.end()) return;
  found->second->command = Fetched::Command::kRefused;
  found->second->refusal = reason;
  wake_.notify_all();
}

void ScanFetcher::Doubt(const std::string& scan_id) {
  const std::lock_guard lock(mutex_);
  if (const auto found = scans_.find(scan_id); found != scans_.end())
    found->second->command = Fetched::Command::kDoubtful;
}

void ScanFetcher::Heard(const std::vector<link::ScanOnHead>& scans, bool all) {
  const std::lock_guard lock(mutex_);
  std::map<std::string, const link::ScanOnHead*> on_head;
  if (all) on_head_.clear();
  for (const link::ScanOnHead& scan : scans) {
    on_head[scan.scan_id()] = &scan;
    on_head_[scan.scan_id()] = scan;
  }
  for (auto& [id, scan] : scans_) {
    const auto found = on_head.find(id);
    if (found != on_head.end()) {
      if (scan->command == Fetched::Command::kDoubtful) scan->command = Fetched::Command::kTaken;
    } else if (all && scan->command == Fetched::Command::kDoubtful && scan->sink) {
      scan->command = Fetched::Command::kRefused;
      scan->refusal = "the command was lost on the link and the head did not start the scan";
    } else if (all && !scan->done && scan->command != Fetched::Command::kSent) {
      scan->shown.trouble = "the head does not have this scan any more";
    }
  }
  wake_.notify_all();
}

std::vector<LinkedScan> ScanFetcher::Scans() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Fetched>> queue;
  for (const auto& [id, scan] : scans_)
    if (scan->command != Fetched::Command::kRefused) queue.push_back(scan);
  std::sort(queue.begin(), queue.end(), [](const auto& a, const auto& b) {
    return std::pair(a->done, -a->order) < std::pair(b->done, -b->order);
  });
  std::vector<LinkedScan> scans;
  for (const auto& scan : queue) {
    scans.push_back(scan->shown);
    scans.back().place = PlaceOf(*scan);
    if (const auto there = on_head_.find(scan->header.uuid); there != on_head_.end())
      Describe(there->second, scan->begun || scan->done, scans.back());
  }
  const std::size_t ours = scans.size();
  for (const auto& [id, there] : on_head_) {
    if (scans_.count(id) != 0) continue;
    LinkedScan& scan = scans.emplace_back();
    scan.scan_id = id;
    Describe(there, false, scan);
  }
  std::sort(
      scans.begin() + static_cast<std::ptrdiff_t>(ours), scans.end(),
      [](const LinkedScan& a, const LinkedScan& b) { return a.begin_utc_ns > b.begin_utc_ns; });
  return scans;
}

/// With the mutex held.
LinkedScan::Place ScanFetcher::PlaceOf(const Fetched& scan) const {
  using Place = LinkedScan::Place;
  if (scan.done) return Place::kHere;
  if (scan.paused) return Place::kPaused;
  return scan.header.uuid == coming_ ? Place::kComing : Place::kWaiting;
}

void ScanFetcher::Describe(const link::ScanOnHead& there, bool left_is_known, LinkedScan& scan) {
  scan.begin_utc_ns = there.begin_utc_ns();
  const bool runs = there.state() == ToString(ScanState::kRunning);
  scan.of_lines = runs ? there.expected_lines() : there.lines();
  scan.of_images = there.frames();
  if (!left_is_known) scan.left_bytes = there.bytes();
}

/// With the mutex held: the entry of a scan, which is made at the end of the queue where there is
/// none.
ScanFetcher::Fetched& ScanFetcher::Queued(const std::string& scan_id) {
  auto& scan = scans_[scan_id];
  if (!scan) {
    scan = std::make_shared<Fetched>();
    scan->header.uuid = scan->shown.scan_id = scan_id;
    scan->command = Fetched::Command::kTaken;
    for (const auto& [id, other] : scans_) scan->order = std::min(scan->order, other->order - 1);
  }
  scan->paused = false;
  wake_.notify_all();
  return *scan;
}

void ScanFetcher::Fetch(const std::string& scan_id) {
  const std::lock_guard lock(mutex_);
  Queued(scan_id);
}

void ScanFetcher::FetchFirst(const std::string& scan_id) {
  const std::lock_guard lock(mutex_);
  Queued(scan_id).order = ++order_;
}

double ScanFetcher::DownBytesPerS() const {
  const std::lock_guard lock(mutex_);
  return rate_.BytesPerS(LinkSession::Now());
}

std::shared_ptr<const EarlyScan> ScanFetcher::Early() const {
  const std::lock_guard lock(mutex_);
  return early_;
}

void ScanFetcher::LinesFirst(std::optional<std::pair<std::int64_t, std::int64_t>> seqs) {
  const std::lock_guard lock(mutex_);
  lines_first_ = seqs;
  ++preferences_changed_;
}

void ScanFetcher::Pause(const std::string& scan_id) {
  const std::lock_guard lock(mutex_);
  const auto found = scans_.find(scan_id);
  if (found != scans_.end()) found->second->paused = true;
}

/// With the mutex held.
bool ScanFetcher::MayBeFetched(const Fetched& scan) const {
  return scan.command == Fetched::Command::kTaken && !scan.confirmed && !scan.paused &&
         LinkSession::Now() >= scan.not_before_s;
}

std::shared_ptr<ScanFetcher::Fetched> ScanFetcher::Next(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  std::shared_ptr<Fetched> next;
  const auto find = [&] {
    next.reset();
    for (const auto& [id, scan] : scans_) {
      const bool refused = scan->command == Fetched::Command::kRefused && scan->sink;
      if (refused || (MayBeFetched(*scan) && (!next || scan->order > next->order))) next = scan;
      if (refused) break;
    }
    return next != nullptr;
  };
  wake_.wait_for(lock, stop, kFetchTick, find);
  return next;
}

bool ScanFetcher::Superseded(const Fetched& scan) const {
  const std::lock_guard lock(mutex_);
  if (!MayBeFetched(scan)) return true;
  for (const auto& [id, other] : scans_)
    if (other->order > scan.order && MayBeFetched(*other)) return true;
  return false;
}

void ScanFetcher::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto scan = Next(stop);
    if (!scan) continue;
    if (scan->command == Fetched::Command::kRefused) {
      EndSinksOfOthers(*scan);
      EndSink(*scan, ScanState::kAborted, scan->refusal);
      continue;
    }
    if (scan->sink) EndSinksOfOthers(*scan);
    SetComing(scan->header.uuid);
    const double began_s = LinkSession::Now();
    const Status fetched = Bring(*scan, stop);
    ending_ = false;
    SetComing("");
    if (fetched && scan->transfer && scan->transfer->TakeMistakenRig()) continue;
    if (fetched && std::exchange(again_, false)) continue;
    // A link that broke is tried again as soon as there is a connection, with ever longer pauses
    // where that breaks at once: it may not be known yet that it is gone. A disk or a mission that
    // takes nothing is tried again later.
    const bool disk = !fetched && fetched.error().code != ErrorCode::kDevice;
    if (disk) LogError("{}", fetched.error().message);
    const std::lock_guard lock(mutex_);
    if (!fetched) scan->shown.trouble = fetched.error().message;
    const double now_s = LinkSession::Now();
    scan->pause_s =
        now_s - began_s > kRetry_s ? 0.0 : std::clamp(2.0 * scan->pause_s, kFirstRetry_s, kRetry_s);
    scan->not_before_s = now_s + (disk ? kRetryDisk_s : scan->pause_s);
  }
}

void ScanFetcher::SetComing(const std::string& scan_id) {
  const std::lock_guard lock(mutex_);
  coming_ = scan_id;
}

void ScanFetcher::EndSinksOfOthers(const Fetched& newest) {
  std::vector<std::shared_ptr<Fetched>> others;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, scan] : scans_)
      if (scan->order < newest.order && scan->sink) others.push_back(scan);
  }
  for (const auto& scan : others)
    EndSink(*scan, ScanState::kInterrupted,
            "another scan began before all of this one had come: the rest follows");
}

void ScanFetcher::EndSink(Fetched& scan, ScanState state, const std::string& reason) {
  if (!scan.sink) return;
  const Delivered heard = scan.transfer ? scan.transfer->builder().delivered() : Delivered();
  if (!heard.started) scan.sink->OnScanStarted(scan.header);
  if (!heard.ended) scan.sink->OnScanEnded(state, reason);
  const std::lock_guard lock(mutex_);
  scan.sink.reset();
}

link::TransferStart ScanFetcher::StartOf(const Fetched& scan, const std::string& have) {
  link::TransferStart start;
  start.set_scan_id(scan.header.uuid);
  start.set_have(have);
  thin_ = options_.thin;
  {
    const std::lock_guard lock(mutex_);
    rate_.Begin(LinkSession::Now(), SeemsWide());
    start.set_credit_bytes(rate_.credit());
  }
  *start.mutable_preferences() = Preferences();
  // Of a scan that is here, the head is to hear only that.
  if (have.empty()) start.mutable_preferences()->set_pause(true);
  return start;
}

/// Until the scan is whole, the link breaks, or something else goes first.
Status ScanFetcher::Bring(Fetched& scan, const std::stop_token& stop) {
  if (!scan.transfer && !scan.done) {
    const std::string rig = options_.rig_yaml ? options_.rig_yaml() : "";
    FORESIGHT_TRY(scan.transfer, ScanTransfer::Open(options_.spool, scan.header.uuid, rig));
  }
  std::uint32_t burst_key = 0;
  if (options_.burst && !scan.done) {
    FORESIGHT_TRY(burst_key,
                  options_.burst->Open(session_, scan.header.uuid, scan.transfer->Have(), stop));
  }
  const auto context = LinkSession::Context(std::chrono::milliseconds(0));
  const std::stop_callback cancel(stop, [&] { context->TryCancel(); });
  const std::string have = scan.transfer ? scan.transfer->Have().Encode() : "";
  // A window that opens does not wait until the item that is being read is whole: meanwhile the
  // stream begins. What this thread changes is not looked at before it has ended.
  const std::int64_t left_bytes = scan.shown.left_bytes;
  Status taken_in;
  std::jthread taker([&](const std::stop_token& connected) {
    while (taken_in && scan.transfer && scan.transfer->Waiting() && !connected.stop_requested() &&
           !session_.Connected())
      taken_in = TakeIn(scan, scan.transfer->WaitingBytes() - 1, left_bytes);
  });
  const auto stub = session_.WaitForStub(stop);
  if (stub == nullptr) return {};
  const auto stream = stub->Transfer(context.get());
  link::TransferRequest request;
  *request.mutable_start() = StartOf(scan, have);
  request.mutable_start()->set_burst_key_id(burst_key);
  if (!stream->Write(request)) return tl::unexpected(session_.ToError(stream->Finish(), "a scan"));
  Inbox inbox(left_bytes);
  Status received;
  {
    const std::jthread reader([&] {
      link::Chunk message;
      while (stream->Read(&message)) inbox.Push(std::move(message));
      inbox.Close();
    });
    taker = {};
    received = taken_in;
    // What could not be read has to come again, and the head does not know that.
    again_ = received && scan.transfer && scan.transfer->Have().Encode() != have;
    if (received && !scan.done && !again_) received = Receive(scan, stub, *stream, inbox);
    if (received && scan.done) SayThatAllIsHere(*stream, inbox);
    if (!inbox.Closed()) context->TryCancel();
  }
  const grpc::Status ended = stream->Finish();
  FORESIGHT_CHECK(received);
  if (ended.ok()) {
    const std::lock_guard lock(mutex_);
    scan.confirmed = scan.done;
    return {};
  }
  if (ended.error_code() == grpc::StatusCode::CANCELLED) return {};
  return tl::unexpected(session_.ToError(ended, "a scan"));
}

/// Waits until the head has heard it, which ends the stream: then it may delete the scan.
void ScanFetcher::SayThatAllIsHere(Stream& stream, Inbox& inbox) {
  link::TransferRequest request;
  request.mutable_acknowledge()->set_all(true);
  stream.Write(request);
  stream.WritesDone();
  const double end_s = LinkSession::Now() + kConfirm_s;
  while (!inbox.Closed() && LinkSession::Now() < end_s) inbox.TakeAll(kFetchTick);
}

/// How long to look for chunks before what came is taken in. An image takes longer to read than its
/// parts take to come through a wide path, so it waits for a pause.
std::chrono::milliseconds ScanFetcher::WaitBeforeTakingIn(const ScanTransfer& transfer,
                                                          double silent_s) {
  if (!transfer.Waiting()) return kFetchTick;
  return transfer.NextKind() == ChunkKind::kImage && silent_s < kPause_s ? kFetchPause : kNoWait;
}

Status ScanFetcher::Receive(Fetched& scan, const Stub& stub, Stream& stream, Inbox& inbox) {
  std::int64_t preferences_sent = 0;
  bool doubted = false;  // then a fresh connection is looked for, and nothing else is begun
  double came_s = LinkSession::Now();
  silence_.Begin(came_s);
  while (!inbox.Closed() && !Superseded(scan)) {
    again_ = session_.LeftBehind(stub);
    if (again_) break;
    std::vector<Chunk> chunks = inbox.TakeAll(
        doubted ? kWatch : WaitBeforeTakingIn(*scan.transfer, LinkSession::Now() - came_s));
    if (Superseded(scan)) break;  // what is not taken in comes again
    const bool came = !chunks.empty();
    if (came) came_s = LinkSession::Now();
    if (came || inbox.LeftBytes() == 0) {
      if (silence_.Heard(LinkSession::Now())) session_.Trust();
      doubted = false;
    } else if (!thin_ && silence_.Doubts(LinkSession::Now(), RoundTrip())) {
      session_.Doubt();
      doubted = true;
    }
    FORESIGHT_CHECK(Acknowledge(scan, stream, std::move(chunks), inbox.LeftBytes()));
    FORESIGHT_TRY(const bool came_by_burst, KeepBurst(scan, stream));
    // The link goes first: what came is decoded when nothing more comes for a moment.
    const std::int64_t most =
        came || came_by_burst || doubted ? kMostWaiting : scan.transfer->WaitingBytes() - 1;
    FORESIGHT_CHECK(TakeIn(scan, most, inbox.LeftBytes()));
    if (scan.done || !scan.transfer || scan.transfer->MistakenRig()) return {};
    link::TransferRequest request;
    const bool was_thin = thin_;
    *request.mutable_preferences() = Preferences();
    std::int64_t changed = 0;
    {
      const std::lock_guard lock(mutex_);
      changed = preferences_changed_;
    }
    if (changed == preferences_sent && was_thin == thin_) continue;
    preferences_sent = changed;
    if (!stream.Write(request)) break;
  }
  return {};
}

/// The head hears at once what is on the disk.
Status ScanFetcher::Acknowledge(Fetched& scan, Stream& stream, std::vector<Chunk> chunks,
                                std::int64_t left_bytes) {
  std::int64_t bytes = 0;
  for (const Chunk& chunk : chunks) bytes += static_cast<std::int64_t>(chunk.bytes.size());
  FORESIGHT_TRY(const std::vector<ChunkId> kept, scan.transfer->Keep(std::move(chunks)));
  link::TransferRequest request;
  link::Acknowledge& acknowledge = *request.mutable_acknowledge();
  for (const ChunkId& kept_id : kept) {
    link::ChunkId& id = *acknowledge.add_chunks();
    id.set_kind(static_cast<int>(kept_id.kind));
    id.set_item(kept_id.item);
    id.set_part(kept_id.part);
  }
  {
    const std::lock_guard lock(mutex_);
    rate_.Received(bytes, left_bytes, LinkSession::Now());
    acknowledge.set_credit_bytes(rate_.credit());
  }
  if (!kept.empty()) stream.Write(request);  // that it broke shows when it is read
  return {};
}

/// Keeps what came on the burst path; whether anything did. The head hears of it seldom, in few
/// bytes, and sends it again until then.
Result<bool> ScanFetcher::KeepBurst(Fetched& scan, Stream& stream) {
  if (!options_.burst) return false;
  std::vector<Chunk> chunks = options_.burst->TakeChunks();
  const ChunkSet before = scan.transfer->Have();
  std::erase_if(chunks,
                [&](const Chunk& chunk) { return before.HasPart(chunk.id, chunk.item_crc); });
  FORESIGHT_TRY(const std::vector<ChunkId> kept, scan.transfer->Keep(std::move(chunks)));
  const ChunkSet have = scan.transfer->Have();
  if (!kept.empty()) options_.burst->SetHave(have);
  if (options_.burst->MayTell(LinkSession::Now())) {
    link::TransferRequest request;
    request.mutable_acknowledge()->set_have(options_.burst->Tell(have, LinkSession::Now()));
    stream.Write(request);
  }
  return !kept.empty();
}

/// Takes in what was kept until only `most_waiting` bytes of it wait.
Status ScanFetcher::TakeIn(Fetched& scan, std::int64_t most_waiting, std::int64_t left_bytes) {
  while (scan.transfer->Waiting() && scan.transfer->WaitingBytes() > most_waiting) {
    // What could not be read is to come again.
    if (!scan.transfer->TakeInNext() && options_.burst)
      options_.burst->SetHave(scan.transfer->Have());
    if (scan.transfer->builder().Progress().complete) ending_ = true;
    if (scan.sink) scan.transfer->builder().DeliverTo(*scan.sink);
  }
  Show(scan, left_bytes);
  const bool all = !scan.transfer->Waiting() && scan.transfer->builder().Progress().complete;
  return all ? Finish(scan) : Status();
}

/// Everything is here: it is kept for good, and the spool is not needed any more.
Status ScanFetcher::Finish(Fetched& scan) {
  const Result<Scan> whole = scan.transfer->builder().Whole();
  if (!whole) {
    LogError("scan {}: {}: it is fetched again", scan.header.uuid, whole.error().message);
    EndSink(scan, ScanState::kInterrupted,
            "what came over the link is not what the head has: it is fetched again");
    const Status removed = scan.transfer->Remove();
    scan.transfer.reset();
    FORESIGHT_CHECK(removed);
    return tl::unexpected(whole.error());
  }
  if (scan.sink) scan.transfer->builder().DeliverTo(*scan.sink);
  if (options_.archive)
    FORESIGHT_CHECK(options_.archive->Keep(*whole));
  else if (scan.sink)
    FORESIGHT_CHECK(scan.sink->WaitUntilKept());
  FORESIGHT_CHECK(scan.transfer->Remove());
  const std::lock_guard lock(mutex_);
  scan.transfer.reset();
  scan.sink.reset();
  scan.done = true;
  scan.shown.trouble.clear();
  scan.shown.left_bytes = 0;
  scan.shown.lines = scan.shown.of_lines = static_cast<int>(whole->lines.size());
  scan.shown.images = scan.shown.of_images = static_cast<int>(whole->frames.size());
  if (scan.header.uuid == newest_) early_.reset();
  return {};
}

void ScanFetcher::Show(Fetched& scan, std::int64_t left_bytes) {
  ScanBuilder& builder = scan.transfer->builder();
  const ScanProgress progress = builder.Progress();
  const double now_s = LinkSession::Now();
  std::shared_ptr<const EarlyScan> early;
  const bool look = scan.sink && now_s - early_s_ > kEarlyEvery_s;
  if (look) {
    early_s_ = now_s;
    early = EarlyScanOf(builder);
  }
  const std::lock_guard lock(mutex_);
  // A stream beside bursts tells only of what is small: the file at the head says about how much
  // there is.
  if (const auto there = on_head_.find(scan.header.uuid);
      thin_ && options_.burst && there != on_head_.end())
    left_bytes = std::max(left_bytes, there->second.bytes() - scan.transfer->TakenBytes());
  scan.shown.lines = static_cast<int>(progress.lines);
  scan.shown.images = static_cast<int>(progress.frames);
  scan.shown.left_bytes = left_bytes;
  scan.shown.trouble.clear();
  scan.begun = true;
  if (look && scan.header.uuid == newest_) early_ = std::move(early);
}

/// By its round trip. A path that is known to be thin may have a queue that lets a short message
/// pass at once.
bool ScanFetcher::SeemsWide() const {
  const double round_trip_s = RoundTrip();
  return !options_.thin && round_trip_s > 0.0 && round_trip_s < kWideRoundTrip_s;
}

double ScanFetcher::RoundTrip() const {
  return options_.round_trip ? options_.round_trip() : 0.0;
}

link::TransferPreferences ScanFetcher::Preferences() {
  const std::lock_guard lock(mutex_);
  link::TransferPreferences preferences;
  const auto rate = rate_.PathBytesPerS(LinkSession::Now());
  if (rate && *rate < kThinBytesPerS) thin_ = true;
  // A thin path that has nothing more to carry shows by its round trip that it became wide.
  if ((rate && *rate > 2.0 * kThinBytesPerS) || SeemsWide()) thin_ = false;
  // What is beside a burst path carries what is small.
  if (options_.burst && options_.burst->Carries()) thin_ = true;
  if (thin_) preferences.set_bytes_per_s(static_cast<std::int64_t>(kThinBytesPerS) - 1);
  if (lines_first_ && coming_ == newest_) {
    preferences.mutable_lines_first()->set_first(lines_first_->first);
    preferences.mutable_lines_first()->set_last(lines_first_->second);
  }
  return preferences;
}

}  // namespace foresight
