#include "hardware/link/server/scan_shelf.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "core/base/contract.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/utc_text.h"
#include "core/mission/mission_file.h"
#include "core/sensor/rig_id.h"
#include "hardware/head/scan_assembler.h"
#include "hardware/head/scan_recorder.h"
#include "hardware/link/chunks/health_item.h"

namespace foresight {
namespace {

constexpr std::string_view kSuffix = ".foresight";
constexpr const char* kConfirmed = "link: a station has the whole scan";
/// A scan's file holds this much more than its raw data at worst: rows, index, thumbnail.
constexpr std::int64_t kFileOverhead_bytes = std::int64_t{4} << 20;

std::int64_t SizeOf(const std::filesystem::path& path) {
  std::int64_t bytes = 0;
  for (const char* suffix : {"", "-wal"}) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path.string() + suffix, error);
    if (!error) bytes += static_cast<std::int64_t>(size);
  }
  return bytes;
}

/// What a scan's header says of it.
void Describe(const Scan& header, ShelvedScan& scan) {
  const Result<ScanPrediction> prediction = PredictScan(header.plan, header.rig);
  scan.expected_lines = prediction ? prediction->lines : 0;
  scan.rig_id = RigId(header.rig);
  scan.simulated = header.simulated;
}

bool OlderThan(const ShelvedScan& a, const ShelvedScan& b) {
  return std::tie(a.begin_utc_ns, a.uuid) < std::tie(b.begin_utc_ns, b.uuid);
}

}  // namespace

/// One scan on its way to the disk. What the recorder hands on comes here, from its thread.
class ScanShelf::Recording final : public ScanSink {
 public:
  Recording(ScanShelf& shelf, std::string uuid) : shelf_(&shelf), uuid_(std::move(uuid)) {}

  /// The shelf is gone; a head may still hold the sink.
  void Leave() {
    const std::lock_guard lock(mutex_);
    shelf_ = nullptr;
  }

  void OnScanStarted(const Scan& header) override {
    assembler_.OnScanStarted(header);
    Tell([&](Entry& entry) {
      Describe(header, entry.scan);
      entry.scan.begin_utc_ns = BeginUtc_ns(header);
      entry.scan.begun = std::chrono::steady_clock::now();
    });
  }
  void OnLine(const LidarLine& line) override {
    assembler_.OnLine(line);
    Tell([&](Entry& entry) {
      if (entry.scan.lines++ == 0) LogInfo("scan {}: the first line is here", uuid_);
    });
  }
  void OnMotorSamples(std::span<const MotorSample> samples) override {
    assembler_.OnMotorSamples(samples);
  }
  void OnFrame(const CameraFrame& frame) override {
    assembler_.OnFrame(frame);
    Tell([&](Entry& entry) { ++entry.scan.frames; });
  }
  void OnDeviceHealth(const HeadHealth& at_start, const HeadHealth& at_end) override {
    const std::string json = ToJson(HealthReport{at_start, at_end});
    Tell([&](Entry& entry) { entry.health_json = json; });
  }
  /// What the file says counts: the tidier reads it when it is closed.
  void OnScanEnded(ScanState /*state*/, const std::string& /*reason*/) override {
    Tell([this](Entry&) { ended_ = true; });
  }

  bool Ended() const { return ended_; }
  std::shared_ptr<const Scan> Snapshot() const { return assembler_.Snapshot(); }

  std::shared_ptr<MissionFile> mission;
  std::shared_ptr<ScanRecorder> recorder;

 private:
  template <class Change>
  void Tell(const Change& change) {
    const std::lock_guard here(mutex_);
    if (shelf_ == nullptr) return;
    const std::lock_guard lock(shelf_->mutex_);
    const auto found = shelf_->entries_.find(uuid_);
    if (found == shelf_->entries_.end()) return;
    change(found->second);
    shelf_->Changed(found->second);
  }

  std::mutex mutex_;
  ScanShelf* shelf_;  ///< null = gone
  const std::string uuid_;
  ScanAssembler assembler_;
  bool ended_ = false;  ///< guarded by the shelf's mutex
};

namespace {

/// What the head hears of: the scan gets the name that the station gave it, and goes to the disk.
class NamedScan final : public ScanSink {
 public:
  NamedScan(std::string uuid, std::shared_ptr<ScanRecorder> recorder)
      : uuid_(std::move(uuid)), recorder_(std::move(recorder)) {}

  void OnScanStarted(const Scan& header) override {
    Scan named = header;
    named.uuid = uuid_;
    named.state = ScanState::kRunning;
    recorder_->OnScanStarted(named);
  }
  void OnLine(const LidarLine& line) override { recorder_->OnLine(line); }
  void OnMotorSamples(std::span<const MotorSample> samples) override {
    recorder_->OnMotorSamples(samples);
  }
  void OnFrame(const CameraFrame& frame) override { recorder_->OnFrame(frame); }
  std::optional<std::string> Failure() const override { return recorder_->Failure(); }
  void OnDeviceHealth(const HeadHealth& at_start, const HeadHealth& at_end) override {
    recorder_->OnDeviceHealth(at_start, at_end);
  }
  void OnScanEnded(ScanState state, const std::string& reason) override {
    recorder_->OnScanEnded(state, reason);
  }

 private:
  const std::string uuid_;
  const std::shared_ptr<ScanRecorder> recorder_;
};

}  // namespace

Result<std::unique_ptr<ScanShelf>> ScanShelf::Open(const Options& options) {
  if (!(options.disk_ratio > 0.0 && options.disk_ratio <= 1.0))
    return Fail(ErrorCode::kInvalidOptions, "disk_ratio {} is not in (0, 1]", options.disk_ratio);
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error)
    return Fail(ErrorCode::kIo, "{}: cannot make the folder for scans: {}", options.folder.string(),
                error.message());
  auto shelf = std::unique_ptr<ScanShelf>(new ScanShelf(options));
  for (const auto& file : std::filesystem::directory_iterator(options.folder, error))
    if (file.path().extension() == kSuffix) shelf->TakeIn(file.path());
  if (error)
    return Fail(ErrorCode::kIo, "{}: cannot list the scans: {}", options.folder.string(),
                error.message());
  shelf->tidier_ =
      std::jthread([raw = shelf.get()](const std::stop_token& stop) { raw->Tidy(stop); });
  return shelf;
}

/// A scan that runs on is interrupted, as the end of its recorder makes it.
ScanShelf::~ScanShelf() {
  tidier_ = {};
  for (auto& [uuid, entry] : entries_) {
    if (!entry.recording) continue;
    entry.recording->recorder.reset();
    entry.recording->Leave();
  }
}

/// Opening for writing ends a scan that a crash left running.
void ScanShelf::TakeIn(const std::filesystem::path& path) {
  const auto mission = MissionFile::Open(path);
  if (!mission) return LogError("{}; its scan is not offered to stations", mission.error().message);
  const auto scans = (*mission)->ListScans();
  const auto events = (*mission)->ListEvents();
  if (!scans || !events)
    return LogError("{}; its scan is not offered to stations",
                    (scans ? events.error() : scans.error()).message);
  if (scans->empty()) {
    // The head was stopped between making the file and the start of the sweep.
    static_cast<void>((*mission)->Close());
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return;
  }
  const ScanSummary& summary = scans->front();
  Entry entry;
  entry.path = path;
  entry.scan.uuid = summary.uuid;
  entry.scan.state = summary.state;
  entry.scan.reason = summary.reason;
  entry.scan.begin_utc_ns = summary.begin_utc_ns;
  entry.scan.lines = static_cast<int>(summary.lines);
  entry.scan.frames = static_cast<int>(summary.images);
  if (const auto header = (*mission)->LoadHeader(summary.id)) Describe(*header, entry.scan);
  entry.scan.begun =
      std::chrono::steady_clock::now() -
      std::chrono::nanoseconds(std::max<std::int64_t>(0, NowUtc_ns() - summary.begin_utc_ns));
  for (const EventRecord& event : *events)
    if (event.text == kConfirmed) entry.scan.confirmed = true;
  if (const Status closed = (*mission)->Close(); !closed) LogError("{}", closed.error().message);
  entry.scan.file_bytes = SizeOf(path);
  entry.scan.news = ++news_;
  entries_.emplace(summary.uuid, std::move(entry));
}

std::int64_t ScanShelf::ShareBytes() const {
  struct statvfs disk {};
  if (statvfs(options_.folder.c_str(), &disk) != 0) return 0;
  const double all = static_cast<double>(disk.f_blocks) * static_cast<double>(disk.f_frsize);
  const double free = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  // What others have filled is not there for scans, whatever the share.
  return static_cast<std::int64_t>(
      std::min(options_.disk_ratio * all, free + static_cast<double>(UsedBytes())));
}

/// With the mutex held.
std::int64_t ScanShelf::UsedBytes() const {
  std::int64_t bytes = 0;
  for (const auto& [uuid, entry] : entries_) bytes += entry.scan.file_bytes;
  return bytes;
}

std::int64_t ScanShelf::FreeBytes() const {
  const std::lock_guard lock(mutex_);
  return std::max<std::int64_t>(0, ShareBytes() - UsedBytes());
}

/// With the mutex held.
Status ScanShelf::MakeRoom(std::int64_t bytes) {
  const std::int64_t share = ShareBytes();
  while (UsedBytes() + bytes > share) {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (!entry->second.scan.confirmed || entry->second.recording) continue;
      if (oldest == entries_.end() || OlderThan(entry->second.scan, oldest->second.scan))
        oldest = entry;
    }
    if (oldest == entries_.end())
      return Fail(ErrorCode::kIo,
                  "{}: no room for a scan of {} MB: {} scans that no station has yet fill {} of {} "
                  "MB: let a station fetch them, or give scans more of the disk",
                  options_.folder.string(), bytes >> 20, entries_.size(), UsedBytes() >> 20,
                  share >> 20);
    std::error_code error;
    std::filesystem::remove(oldest->second.path, error);
    if (error)
      return Fail(ErrorCode::kIo, "{}: cannot be deleted to make room: {}",
                  oldest->second.path.string(), error.message());
    LogInfo("{}: deleted to make room; a station has it", oldest->second.path.string());
    entries_.erase(oldest);
    ++news_;
  }
  return {};
}

Result<std::shared_ptr<ScanSink>> ScanShelf::Begin(const std::string& uuid,
                                                   const ScanPrediction& expected) {
  const std::lock_guard lock(mutex_);
  if (entries_.contains(uuid))
    return Fail(ErrorCode::kInvalidInput, "the head has a scan {} already", uuid);
  FORESIGHT_CHECK(MakeRoom(expected.bytes + kFileOverhead_bytes));
  Entry entry;
  const std::int64_t now_ns = NowUtc_ns();
  std::string name = UtcText(now_ns) + "-" + uuid.substr(0, 8);
  std::replace(name.begin(), name.end(), ':', '-');
  entry.path = options_.folder / (name + std::string(kSuffix));
  FORESIGHT_TRY(std::shared_ptr<MissionFile> mission, MissionFile::Create(entry.path));
  entry.scan.uuid = uuid;
  entry.scan.begin_utc_ns = now_ns;
  entry.scan.expected_lines = expected.lines;
  entry.scan.file_bytes = expected.bytes;
  entry.recording = std::make_shared<Recording>(*this, uuid);
  entry.recording->mission = mission;
  entry.recording->recorder = std::make_shared<ScanRecorder>(mission, entry.recording);
  auto sink = std::make_shared<NamedScan>(uuid, entry.recording->recorder);
  Changed(entries_.emplace(uuid, std::move(entry)).first->second);
  return sink;
}

void ScanShelf::Withdraw(const std::string& uuid) {
  std::shared_ptr<Recording> recording;
  {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(uuid);
    if (found == entries_.end() || !found->second.recording) return;
    recording = found->second.recording;
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm"})
      std::filesystem::remove(found->second.path.string() + suffix, ignored);
    entries_.erase(found);
    ++news_;
    changed_.notify_all();
  }
  recording->recorder.reset();
}

/// With the mutex held.
void ScanShelf::Changed(Entry& entry) {
  entry.scan.news = ++news_;
  changed_.notify_all();
}

std::vector<ShelvedScan> ScanShelf::List() const {
  const std::lock_guard lock(mutex_);
  std::vector<ShelvedScan> scans;
  for (const auto& [uuid, entry] : entries_) scans.push_back(entry.scan);
  std::sort(scans.begin(), scans.end(), OlderThan);
  return scans;
}

Result<ShelvedScan> ScanShelf::Find(const std::string& uuid) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(uuid);
  if (found == entries_.end())
    return Fail(ErrorCode::kInvalidInput, "the head has no scan {}", uuid);
  return found->second.scan;
}

std::string ScanShelf::DeviceHealthJson(const std::string& uuid) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(uuid);
  return found == entries_.end() ? "" : found->second.health_json;
}

Result<std::shared_ptr<const Scan>> ScanShelf::Snapshot(const std::string& uuid) {
  std::filesystem::path path;
  {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(uuid);
    if (found == entries_.end())
      return Fail(ErrorCode::kInvalidInput, "the head has no scan {}", uuid);
    if (found->second.recording) {
      if (auto scan = found->second.recording->Snapshot()) return scan;
      return Fail(ErrorCode::kState, "scan {} has not begun", uuid);
    }
    if (auto loaded = found->second.loaded.lock()) return loaded;
    path = found->second.path;
  }
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
  FORESIGHT_TRY(const auto id, mission->FindScan(uuid));
  if (!id) return Fail(ErrorCode::kBadData, "{}: scan {} is not in it", path.string(), uuid);
  FORESIGHT_TRY(Scan scan, mission->LoadScan(*id));
  auto loaded = std::make_shared<const Scan>(std::move(scan));
  const std::lock_guard lock(mutex_);
  if (const auto found = entries_.find(uuid); found != entries_.end())
    found->second.loaded = loaded;
  last_loaded_ = loaded;
  return loaded;
}

Status ScanShelf::Confirm(const std::string& uuid, const std::string& by) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(uuid);
  if (found == entries_.end())
    return Fail(ErrorCode::kInvalidInput, "the head has no scan {}", uuid);
  Entry& entry = found->second;
  if (entry.scan.confirmed) return {};
  if (entry.recording)
    return Fail(ErrorCode::kState, "scan {} has not ended: nobody can have all of it", uuid);
  FORESIGHT_TRY(const auto mission, MissionFile::Open(entry.path));
  EventRecord event;
  event.utc_ns = NowUtc_ns();
  event.source = by;
  event.severity = "info";
  event.text = kConfirmed;
  FORESIGHT_CHECK(mission->AddEvent(event));
  FORESIGHT_CHECK(mission->Close());
  entry.scan.confirmed = true;
  Changed(entry);
  return {};
}

std::int64_t ScanShelf::News() const {
  const std::lock_guard lock(mutex_);
  return news_;
}

std::int64_t ScanShelf::WaitForNews(std::int64_t seen, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return news_ > seen; });
  return news_;
}

void ScanShelf::Tidy(const std::stop_token& stop) {
  for (;;) {
    std::string uuid;
    std::shared_ptr<Recording> ended;
    {
      std::unique_lock lock(mutex_);
      const auto find = [&] {
        for (const auto& [name, entry] : entries_) {
          if (!entry.recording || !entry.recording->Ended()) continue;
          uuid = name;
          ended = entry.recording;
        }
        return ended != nullptr;
      };
      if (!changed_.wait(lock, stop, find)) return;
    }
    Finish(uuid, *ended);
    ended.reset();
    GiveMemoryBack();
  }
}

/// Closes the file and takes over what it says.
void ScanShelf::Finish(const std::string& uuid, Recording& recording) {
  static_cast<void>(recording.recorder->WaitUntilWritten());
  recording.recorder.reset();  // its last handing on needs the mutex
  const auto scans = recording.mission->ListScans();
  if (const Status closed = recording.mission->Close(); !closed)
    LogError("{}", closed.error().message);
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_.at(uuid);
  entry.recording.reset();
  entry.scan.file_bytes = SizeOf(entry.path);
  if (scans && !scans->empty()) {
    entry.scan.state = scans->front().state;
    entry.scan.reason = scans->front().reason;
    entry.scan.lines = static_cast<int>(scans->front().lines);
    entry.scan.frames = static_cast<int>(scans->front().images);
    entry.scan.begin_utc_ns = scans->front().begin_utc_ns;
  } else {
    entry.scan.state = ScanState::kInterrupted;
    entry.scan.reason = scans ? "nothing of it reached the disk" : scans.error().message;
  }
  Changed(entry);
}

}  // namespace foresight
