#include "hardware/head/scan_recorder.h"

#include <chrono>

#include "core/base/contract.h"
#include "core/base/log.h"
#include "core/base/utc_text.h"
#include "hardware/api/health_watch.h"

namespace foresight {
namespace {

/// A disk this far behind (50 minutes of lines, or 140 images) will not catch up; the memory of
/// the machine is worth more then.
constexpr std::size_t kMaxWaitingBytes = std::size_t{512} << 20;
/// What ending a scan and closing its file may need: the file's log, which is written into it then.
constexpr std::size_t kReserveBytes = std::size_t{16} << 20;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::string Summary(const DeviceDiagnosis& diagnosis, const std::string& numbers) {
  return diagnosis.problem.empty() ? numbers : numbers + " (" + diagnosis.problem + ")";
}

}  // namespace

ScanRecorder::ScanRecorder(std::shared_ptr<MissionFile> mission, std::shared_ptr<ScanSink> then)
    : mission_(std::move(mission)),
      then_(std::move(then)),
      outcome_(Fail(ErrorCode::kState, "no scan has been recorded yet")) {
  FORESIGHT_EXPECTS(mission_ != nullptr, "a recorder has a mission file");
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

ScanRecorder::~ScanRecorder() {
  thread_.request_stop();
  thread_.join();
  if (!running_) return;
  const End end{ScanState::kInterrupted, "the recorder was closed before the scan ended"};
  const Status ended = mission_->EndScan(*running_, end.state, end.reason);
  if (!ended) LogError("{}", ended.error().message);
  HandOn(end);
}

std::optional<std::string> ScanRecorder::Failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void ScanRecorder::OnScanStarted(const Scan& header) {
  {
    const std::lock_guard lock(mutex_);
    ++started_;
    failure_.reset();
  }
  Push(header, 0);
}

void ScanRecorder::OnLine(const LidarLine& line) {
  Push(line, (line.range_mm.size() + line.intensity.size()) * sizeof(std::uint16_t));
}

void ScanRecorder::OnMotorSamples(std::span<const MotorSample> samples) {
  Push(std::vector<MotorSample>(samples.begin(), samples.end()), samples.size_bytes());
}

void ScanRecorder::OnFrame(const CameraFrame& frame) {
  Push(frame, frame.image.size() * sizeof(Rgb8));
}

void ScanRecorder::OnDeviceHealth(const HeadHealth& at_start, const HeadHealth& at_end) {
  Push(Health{at_start, at_end}, 0);
}

void ScanRecorder::OnScanEnded(ScanState state, const std::string& reason) {
  Push(End{state, reason}, 0);
}

void ScanRecorder::Push(Piece piece, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (std::holds_alternative<Scan>(piece)) overflowed_ = false;
  if (overflowed_) return;
  if (waiting_bytes_ + bytes > kMaxWaitingBytes) {
    overflowed_ = true;
    piece = Error{ErrorCode::kIo, fmt::format("{}: the disk is too slow: {} MB are waiting for it",
                                              mission_->path().string(), waiting_bytes_ >> 20)};
    bytes = 0;
  }
  waiting_bytes_ += bytes;
  waiting_.push_back(std::move(piece));
  idle_ = false;
  wake_.notify_all();
}

Result<std::int64_t> ScanRecorder::WaitUntilWritten() {
  std::unique_lock lock(mutex_);
  written_.wait(lock, [this] { return idle_; });
  return outcome_;
}

Status ScanRecorder::WaitUntilKept() {
  FORESIGHT_CHECK(WaitUntilWritten());
  return {};
}

void ScanRecorder::Work(const std::stop_token& stop) {
  for (;;) {
    std::deque<Piece> pieces;
    {
      std::unique_lock lock(mutex_);
      if (waiting_.empty()) {
        idle_ = true;
        written_.notify_all();
      }
      wake_.wait(lock, stop, [this] { return !waiting_.empty(); });
      if (waiting_.empty()) return;
      pieces.swap(waiting_);
      waiting_bytes_ = 0;
    }
    try {
      WriteAll(pieces);
    } catch (const std::exception& error) {
      HandOn(
          GiveUp({ErrorCode::kIo, fmt::format("{}: {}", mission_->path().string(), error.what())}));
    }
  }
}

/// Everything that waited goes to the disk in one commit, and is handed on after it. Where that is
/// not possible each piece goes by itself, up to the one that fails.
void ScanRecorder::WriteAll(const std::deque<Piece>& pieces) {
  const auto running = running_;
  const int begun = begun_;
  // What follows a scan that was given up is not its own; that has been told.
  const auto is_wanted = [this](const Piece& piece) {
    return running_ || std::holds_alternative<Scan>(piece);
  };
  std::vector<const Piece*> on_disk;
  const Status status = mission_->Batch([&]() -> Status {
    for (const Piece& piece : pieces) {
      if (!is_wanted(piece)) continue;
      FORESIGHT_CHECK(Write(piece));
      on_disk.push_back(&piece);
    }
    return {};
  });
  if (status) {
    for (const Piece* piece : on_disk) HandOn(*piece);
    return;
  }
  running_ = running;
  begun_ = begun;
  for (const Piece& piece : pieces) {
    if (!is_wanted(piece)) continue;
    if (const Status written = Write(piece))
      HandOn(piece);
    else
      HandOn(GiveUp(written.error()));
  }
}

Status ScanRecorder::Write(const Piece& piece) {
  if (const auto* header = std::get_if<Scan>(&piece)) return WriteHeader(*header);
  const std::int64_t id = *running_;
  return std::visit(
      Overloaded{[](const Scan&) -> Status { return {}; },
                 [&](const LidarLine& line) { return mission_->AppendLine(id, line); },
                 [&](const std::vector<MotorSample>& samples) {
                   return mission_->AppendMotorSamples(id, samples);
                 },
                 [&](const CameraFrame& frame) { return mission_->AppendFrame(id, frame); },
                 [&](const Health& health) { return WriteHealth(id, health); },
                 [&](const End& end) {
                   running_.reset();
                   return mission_->EndScan(id, end.state, end.reason);
                 },
                 [](const Error& error) -> Status { return tl::unexpected(error); }},
      piece);
}

Status ScanRecorder::WriteHeader(const Scan& header) {
  running_.reset();
  ++begun_;
  const Result<ScanPrediction> planned = PredictScan(header.plan, header.rig);
  planned_lines_ = planned ? planned->lines : 0;
  FORESIGHT_CHECK(reserve_.Take(mission_->path().parent_path(), kReserveBytes));
  FORESIGHT_TRY(running_, mission_->BeginScan(header));
  const std::lock_guard lock(mutex_);
  outcome_ = *running_;
  return {};
}

Status ScanRecorder::WriteHealth(std::int64_t scan_id, const Health& health) {
  const HeadDiagnosis diagnosis = Diagnose(health.at_end, health.at_start);
  const bool well = diagnosis.Worst() == DeviceCondition::kWell;
  EventRecord event;
  event.utc_ns = NowUtc_ns();
  event.source = "head";
  event.severity = well ? "info" : "warning";
  event.text = fmt::format("scan {}: lidar: {}; camera: {}; motor: {}", scan_id,
                           Summary(diagnosis.lidar, Describe(health.at_end.lidar)),
                           Summary(diagnosis.camera, Describe(health.at_end.camera)),
                           Summary(diagnosis.motor, Describe(health.at_end.motor)));
  event.json = ToJson(health.at_end);
  FORESIGHT_CHECK(mission_->AddEvent(event));
  return {};
}

ScanRecorder::End ScanRecorder::GiveUp(const Error& error) {
  reserve_.Release();
  Error told = error;
  if (running_) {
    told.message += WhatWasKept(*running_);
    const Status ended = mission_->EndScan(*running_, ScanState::kInterrupted, told.message);
    if (!ended) LogError("{}", ended.error().message);
    running_.reset();
  }
  LogError("{}", told.message);
  const std::lock_guard lock(mutex_);
  if (begun_ == started_) failure_ = told.message;
  outcome_ = tl::unexpected(told);
  return {ScanState::kInterrupted, told.message};
}

/// What goes wrong there is no fault of the file, and must not end the thread that writes it.
void ScanRecorder::HandOn(const Piece& piece) {
  if (!then_) return;
  if (std::holds_alternative<Scan>(piece)) then_hears_ = true;
  if (!then_hears_) return;
  try {
    Tell(piece);
  } catch (const std::exception& error) {
    then_hears_ = false;
    LogError("{}: who follows the recording hears no more of this scan: {}",
             mission_->path().string(), error.what());
  }
}

void ScanRecorder::Tell(const Piece& piece) {
  std::visit(
      Overloaded{
          [&](const Scan& header) { then_->OnScanStarted(header); },
          [&](const LidarLine& line) { then_->OnLine(line); },
          [&](const std::vector<MotorSample>& samples) { then_->OnMotorSamples(samples); },
          [&](const CameraFrame& frame) { then_->OnFrame(frame); },
          [&](const Health& health) { then_->OnDeviceHealth(health.at_start, health.at_end); },
          [&](const End& end) {
            then_hears_ = false;
            then_->OnScanEnded(end.state, end.reason);
          },
          [](const Error&) {}},
      piece);
}

/// What the file itself says: a failed write takes others with it.
std::string ScanRecorder::WhatWasKept(std::int64_t id) const {
  const auto scans = mission_->ListScans();
  if (!scans) return "";
  for (const ScanSummary& scan : *scans)
    if (scan.id == id) return fmt::format(": {} of {} lines were kept", scan.lines, planned_lines_);
  return "";
}

}  // namespace foresight
