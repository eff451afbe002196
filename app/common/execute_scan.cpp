#include "app/common/execute_scan.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "app/common/wait_for_head.h"
#include "hardware/head/scan_fanout.h"
#include "hardware/head/scan_recorder.h"

namespace foresight {
namespace {

/// User and system time of this process.
double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Whether a file is empty, or a database without a single table and without a log that could hold
/// some.
bool HoldsNothing(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  if (std::filesystem::exists(path + "-wal", error)) return false;
  if (std::filesystem::file_size(path, error) == 0) return !error;
  // By SQLite's file format: 100 bytes of header, then the root of the list of tables: 0Dh says
  // that it is a leaf, and two bytes behind the next two how many entries it has.
  std::array<unsigned char, 108> head{};
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(head.data()), head.size());
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  return stream && std::equal(kMagic.begin(), kMagic.end(), head.begin()) && head[100] == 0x0D &&
         head[103] == 0 && head[104] == 0;
}

/// Whether a scan has ended.
class EndOfScan final : public ScanSink {
 public:
  void OnScanStarted(const Scan& /*header*/) override {}
  void OnLine(const LidarLine& /*line*/) override {}
  void OnMotorSamples(std::span<const MotorSample> /*samples*/) override {}
  void OnFrame(const CameraFrame& /*frame*/) override {}
  void OnScanEnded(ScanState /*state*/, const std::string& /*reason*/) override { ended_ = true; }

  bool Ended() const { return ended_; }

 private:
  std::atomic<bool> ended_{false};
};

}  // namespace

RemoveUnlessUsed::RemoveUnlessUsed(std::string path)
    : path_(std::move(path)), was_there_(std::filesystem::exists(path_) && !HoldsNothing(path_)) {}

RemoveUnlessUsed::~RemoveUnlessUsed() {
  std::error_code error;
  if (was_there_ || !std::filesystem::is_regular_file(path_, error)) return;
  {
    const auto mission = MissionFile::OpenReadOnly(path_);
    if (!mission) {
      // Damaged or in use: whatever it is, it may hold something.
      if (!HoldsNothing(path_)) return;
    } else if (const auto scans = (*mission)->ListScans(); !scans || !scans->empty()) {
      return;
    }
  }
  for (const char* suffix : {"", "-wal", "-journal"})
    std::filesystem::remove(path_ + suffix, error);
}

Result<ExecutedScan> ExecuteScan(SensorHead& head, const ScanPlan& plan,
                                 std::shared_ptr<MissionFile> mission, const RunContext& context) {
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_CHECK(HomeAndWait(head, context));
  const auto recorder = std::make_shared<ScanRecorder>(std::move(mission));
  const auto start = std::chrono::steady_clock::now();
  const double cpu_before_s = CpuSeconds();
  const auto end = std::make_shared<EndOfScan>();
  FORESIGHT_CHECK(head.StartScan(
      plan, std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{recorder, end})));
  const HeadStatus status = WaitWhile(head, {HeadState::kSweeping, HeadState::kStopping}, context);
  const bool came = WaitForEnd(
      head, [&] { return end->Ended(); }, context);
  ExecutedScan executed;
  executed.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  executed.cpu_fraction = (CpuSeconds() - cpu_before_s) / executed.seconds;
  if (!came)
    return Fail(ErrorCode::kCancelled,
                "the scan's end did not come over the link: the head keeps the scan, and what came "
                "is in the mission file");
  FORESIGHT_TRY(executed.id, recorder->WaitUntilWritten());
  if (status.state == HeadState::kFault) return Fail(ErrorCode::kDevice, "{}", status.message);
  return executed;
}

Result<std::shared_ptr<MissionFile>> OpenOrCreateMission(const std::string& path) {
  std::error_code error;
  if (HoldsNothing(path)) std::filesystem::remove(path, error);
  const bool there =
      std::filesystem::status(path, error).type() != std::filesystem::file_type::not_found;
  auto opened = there ? MissionFile::Open(path) : MissionFile::Create(path);
  if (!opened) return tl::unexpected(opened.error());
  return std::shared_ptr<MissionFile>(std::move(*opened));
}

}  // namespace foresight
