// What a recording program acknowledged is in the file, whenever it is killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

/// What the child has been told is on the disk; shared with the parent.
struct Acknowledged {
  std::atomic<int> began{0};
  std::atomic<int> lines{0};
  std::atomic<int> images{0};
};

class SharedAcknowledged {
 public:
  SharedAcknowledged()
      : memory_(::mmap(nullptr, sizeof(Acknowledged), PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::runtime_error("no shared memory");
    new (memory_) Acknowledged();
  }
  ~SharedAcknowledged() { ::munmap(memory_, sizeof(Acknowledged)); }
  SharedAcknowledged(const SharedAcknowledged&) = delete;
  SharedAcknowledged& operator=(const SharedAcknowledged&) = delete;
  Acknowledged& operator*() const { return *static_cast<Acknowledged*>(memory_); }

 private:
  void* memory_;
};

constexpr int kImageEvery = 7;

/// Line `i` of a scan without an end.
LidarLine LineOf(const Scan& scan, int i) {
  LidarLine line = scan.lines[static_cast<std::size_t>(i) % scan.lines.size()];
  line.seq = i;
  line.time_s = 12.3 + 0.025 * i;
  return line;
}

CameraFrame ImageOf(const Scan& scan, int i) {
  CameraFrame frame = scan.frames[static_cast<std::size_t>(i) % scan.frames.size()];
  frame.seq = i;
  return frame;
}

/// Records until it is killed.
[[noreturn]] void RecordForEver(const std::filesystem::path& path, const Scan& scan,
                                Acknowledged& acknowledged) {
  const auto mission = MissionFile::Create(path);
  if (!mission) ::_exit(1);
  const auto id = (*mission)->BeginScan(scan);
  if (!id) ::_exit(1);
  acknowledged.began = 1;
  for (int i = 0;; ++i) {
    const MotorSample sample{12.2 + 0.025 * i, 0.01 * i};
    if (!(*mission)->AppendMotorSamples(*id, std::span(&sample, 1))) ::_exit(1);
    if (!(*mission)->AppendLine(*id, LineOf(scan, i))) ::_exit(1);
    acknowledged.lines = i + 1;
    if (i % kImageEvery != 0) continue;
    if (!(*mission)->AppendFrame(*id, ImageOf(scan, i / kImageEvery))) ::_exit(1);
    acknowledged.images = i / kImageEvery + 1;
  }
}

/// Lines and images are those that were recorded, from the first on without a gap.
void ExpectCleanPrefix(const Scan& read, const Scan& truth, int lines, int images) {
  ASSERT_GE(read.lines.size(), static_cast<std::size_t>(lines));
  ASSERT_LE(read.lines.size(), static_cast<std::size_t>(lines) + 1) << "one was on its way";
  ASSERT_GE(read.frames.size(), static_cast<std::size_t>(images));
  ASSERT_LE(read.frames.size(), static_cast<std::size_t>(images) + 1);
  for (std::size_t i = 0; i < read.lines.size(); ++i)
    ASSERT_EQ(read.lines[i], LineOf(truth, static_cast<int>(i)));
  for (std::size_t i = 0; i < read.frames.size(); ++i)
    ASSERT_EQ(read.frames[i], ImageOf(truth, static_cast<int>(i)));
}

/// @returns how many lines had been acknowledged.
int KillAndCheck(std::uint64_t seed, const std::filesystem::path& folder) {
  const Scan scan = SampleScan(seed);
  const std::filesystem::path path = folder / (std::to_string(seed) + ".foresight");
  const SharedAcknowledged shared;
  Acknowledged& acknowledged = *shared;
  const pid_t child = ::fork();
  if (child == 0) RecordForEver(path, scan, acknowledged);
  while (acknowledged.began == 0) ::usleep(200);
  ::usleep(static_cast<useconds_t>(Random(seed).Index(120'000)));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the recording failed before it was killed";
  const int lines = acknowledged.lines, images = acknowledged.images;

  const auto reader = MissionFile::OpenReadOnly(path).value();
  const Scan read = reader->LoadScan(1).value();
  EXPECT_EQ(read.state, ScanState::kInterrupted);
  ExpectCleanPrefix(read, scan, lines, images);
  EXPECT_TRUE(reader->Close());
  const auto next = MissionFile::Open(path).value();
  EXPECT_FALSE(next->WasClosedProperly()) << "the next start says so";
  EXPECT_EQ(next->Summary(1).value().state, ScanState::kInterrupted);
  EXPECT_THAT(next->Summary(1).value().reason, testing::HasSubstr("ended before the scan did"));
  EXPECT_TRUE(next->Verify({}));
  return lines;
}

void KillMany(int runs) {
  const TemporaryFolder folder;
  int lines = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    lines += KillAndCheck(static_cast<std::uint64_t>(seed), folder.path());
    if (::testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(lines, runs) << "hardly anything had been recorded";
}

TEST(KilledRecording, WhatWasAcknowledgedIsThere) {
  KillMany(10);
}

TEST(KilledRecording, AtTwoHundredMomentsToo) {
  KillMany(200);
}

}  // namespace
}  // namespace foresight
