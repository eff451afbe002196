// How long a commit takes while a scan is recorded at the pace of a head: 40 lines and 10 batches
// of motor samples a second, and a raw image each second, in a file on the given disk; and how fast
// a mission of many scans is listed and a scan of it loaded.
//   recording_pace FOLDER [SECONDS] [SCANS]
// In the end ten times as many small missions are searched.
// Bars: 99 % of the commits of lines below 20 ms; a mission of 100 scans opens in 1 s; 1000
// missions are searched in 1 s.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>

#include "core/base/random.h"
#include "core/mission/mission_file.h"
#include "core/mission/mission_index.h"

namespace foresight {
namespace {

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

Scan Header() {
  Scan scan;
  scan.uuid = NewUuid();
  scan.start_utc_ns = 1795352400000000000;
  scan.source = "benchmark";
  scan.simulated = true;
  scan.rig = DefaultSensorRig();
  return scan;
}

LidarLine LineOf(int i, Random& random) {
  LidarLine line;
  line.seq = i;
  line.time_s = 0.025 * i;
  for (int beam = 0; beam < 1081; ++beam) {
    line.range_mm.push_back(
        static_cast<std::uint16_t>(3000.0 + 900.0 * std::sin(0.01 * beam) + 8.0 * random.Normal()));
    line.intensity.push_back(static_cast<std::uint16_t>(2000 + random.Index(200)));
  }
  return line;
}

/// As noisy as a camera's: it hardly gets smaller as PNG.
CameraFrame ImageOf(int i, Random& random) {
  CameraFrame frame;
  frame.seq = i;
  frame.time_s = i;
  frame.image = ColorImage(1288, 964);
  for (Rgb8& pixel : frame.image.values())
    pixel.r = pixel.g = pixel.b = static_cast<std::uint8_t>(random.Index(256));
  return frame;
}

/// Times of one kind of call, in milliseconds.
struct Times {
  const char* name;
  std::vector<double> ms;

  void Print() {
    std::sort(ms.begin(), ms.end());
    const auto at = [this](double ratio) {
      return ms[std::min(ms.size() - 1,
                         static_cast<std::size_t>(ratio * static_cast<double>(ms.size())))];
    };
    fmt::print("{:<22} {:>6} calls  median {:7.2f} ms  99 % {:7.2f} ms  largest {:7.2f} ms\n", name,
               ms.size(), at(0.5), at(0.99), ms.back());
  }
};

Status RecordAtPace(const std::filesystem::path& path, int seconds) {
  FORESIGHT_TRY(const auto mission, MissionFile::Create(path));
  FORESIGHT_TRY(const std::int64_t id, mission->BeginScan(Header()));
  Random random(1);
  Times lines{"line", {}}, motor{"motor samples", {}}, images{"image (PNG and commit)", {}};
  const auto begin = Clock::now();
  Status image_status;
  for (int i = 0; i < 40 * seconds; ++i) {
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(25 * i));
    const LidarLine line = LineOf(i, random);
    auto before = Clock::now();
    FORESIGHT_CHECK(mission->AppendLine(id, line));
    lines.ms.push_back(MillisecondsSince(before));
    if (i % 4 == 0) {
      std::vector<MotorSample> samples;
      for (int k = 0; k < 24; ++k) samples.push_back({0.025 * i + k / 240.0, 0.001 * (6 * i + k)});
      before = Clock::now();
      FORESIGHT_CHECK(mission->AppendMotorSamples(id, samples));
      motor.ms.push_back(MillisecondsSince(before));
    }
    if (i % 40 != 20) continue;
    const CameraFrame frame = ImageOf(i / 40, random);
    before = Clock::now();
    FORESIGHT_CHECK(mission->AppendFrame(id, frame));
    images.ms.push_back(MillisecondsSince(before));
  }
  FORESIGHT_CHECK(mission->EndScan(id, ScanState::kComplete, ""));
  for (Times* times : {&lines, &motor, &images}) times->Print();
  return mission->Close();
}

Status ListAndLoad(const std::filesystem::path& path, int scans) {
  FORESIGHT_TRY(const auto mission, MissionFile::Create(path));
  Random random(2);
  std::vector<LidarLine> lines;
  for (int i = 0; i < 240; ++i) lines.push_back(LineOf(i, random));
  const CameraFrame frame = ImageOf(0, random);
  for (int scan = 0; scan < scans; ++scan) {
    const Status recorded = mission->Batch([&]() -> Status {
      FORESIGHT_TRY(const std::int64_t id, mission->BeginScan(Header()));
      for (const LidarLine& line : lines) FORESIGHT_CHECK(mission->AppendLine(id, line));
      FORESIGHT_CHECK(mission->AppendFrame(id, frame));
      return mission->EndScan(id, ScanState::kComplete, "");
    });
    FORESIGHT_CHECK(recorded);
  }
  FORESIGHT_CHECK(mission->Close());
  Times open{"open and list", {}}, load{"load one scan", {}};
  for (int i = 0; i < 5; ++i) {
    auto before = Clock::now();
    FORESIGHT_TRY(const auto reader, MissionFile::OpenReadOnly(path));
    FORESIGHT_TRY(const std::vector<ScanSummary> list, reader->ListScans());
    open.ms.push_back(MillisecondsSince(before));
    before = Clock::now();
    FORESIGHT_CHECK(reader->LoadScan(list.back().id));
    load.ms.push_back(MillisecondsSince(before));
  }
  fmt::print("a mission of {} scans of {} lines and an image:\n", scans, lines.size());
  for (Times* times : {&open, &load}) times->Print();
  return {};
}

Status SearchMany(const std::filesystem::path& folder, int missions) {
  std::filesystem::create_directories(folder);
  for (int i = 0; i < missions; ++i) {
    FORESIGHT_TRY(const auto mission,
                  MissionFile::Create(folder / fmt::format("{:04}.foresight", i)));
    FORESIGHT_TRY(const std::int64_t id, mission->BeginScan(Header()));
    FORESIGHT_CHECK(mission->EndScan(id, ScanState::kComplete, ""));
    DetectionRecord object;
    object.scan_id = id;
    object.kind = i % 10 == 0 ? "drill" : "valve";
    object.json = "{}";
    FORESIGHT_CHECK(mission->AddDetection(object));
    for (int event = 0; event < 20; ++event)
      FORESIGHT_CHECK(mission->AddEvent({0, event, "head", "info", "homed", ""}));
    FORESIGHT_CHECK(mission->Close());
  }
  MissionQuery query;
  query.words = {"drill"};
  Times first{"first search", {}}, again{"search again", {}};
  for (int i = 0; i < 6; ++i) {
    const auto before = Clock::now();
    FORESIGHT_TRY(const MissionHits found, SearchMissions(folder, query, {}, {}));
    (i == 0 ? first : again).ms.push_back(MillisecondsSince(before));
    if (i == 0) fmt::print("{} missions, {} hits:\n", found.missions, found.hits.size());
  }
  for (Times* times : {&first, &again}) times->Print();
  return {};
}

Status Run(const std::filesystem::path& folder, int seconds, int scans) {
  FORESIGHT_CHECK(RecordAtPace(folder / "recording_pace.foresight", seconds));
  FORESIGHT_CHECK(ListAndLoad(folder / "recording_pace_many.foresight", scans));
  return SearchMany(folder / "recording_pace_search", 10 * scans);
}

int NumberFrom(int count, char** values, int at, int otherwise) {
  if (count <= at) return otherwise;
  int number = otherwise;
  std::from_chars(values[at], values[at] + std::strlen(values[at]), number);
  return std::max(1, number);
}

}  // namespace
}  // namespace foresight

int main(int count, char** values) {
  if (count < 2) {
    std::fputs("recording_pace FOLDER [SECONDS] [SCANS]\n", stderr);
    return 2;
  }
  const foresight::Status done =
      foresight::Run(values[1], foresight::NumberFrom(count, values, 2, 30),
                     foresight::NumberFrom(count, values, 3, 100));
  if (done) return 0;
  std::fprintf(stderr, "recording_pace: %s\n", done.error().message.c_str());
  return 3;
}
