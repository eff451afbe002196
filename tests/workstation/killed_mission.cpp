#include "tests/workstation/killed_mission.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/base/random.h"
#include "core/mission/mission_file.h"
#include "tests/workstation/scan_digest.h"

namespace foresight {

/// What the killed program had shown as kept (mission_driver.cpp says how).
struct Acknowledged {
  struct Lines {
    std::size_t count = 0;
    std::string digest;
  };
  std::map<std::string, Lines> running;         ///< the last count of each scan
  std::size_t newest_lines = 0;                 ///< of the last of these scans
  std::map<std::string, std::string> complete;  ///< digests
  std::set<std::string> objects;
  std::set<std::string> accepted;
  std::set<std::string> rejected_in_review;
  bool end = false;

  explicit Acknowledged(const std::string& output) {
    std::istringstream text(output.substr(0, output.rfind('\n') + 1));
    for (std::string line; std::getline(text, line);) {
      std::istringstream words(line);
      std::string what, uuid;
      words >> what >> uuid;
      if (what == "lines") {
        words >> running[uuid].count >> running[uuid].digest;
        newest_lines = running[uuid].count;
      }
      if (what == "scan") words >> complete[uuid];
      if (what == "object") objects.insert(uuid);
      if (what == "accepted") accepted.insert(uuid);
      if (what == "rejected") rejected_in_review.insert(uuid);
      end = end || what == "end";
    }
  }
};

namespace {

constexpr int kNothingToGoOnWith = 3;  ///< exit code of mission_driver

std::string BytesOf(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

void CheckScan(const MissionFile& file, const ScanSummary& summary, const Acknowledged& kept) {
  const Scan scan = file.LoadScan(summary.id).value();
  for (std::size_t i = 1; i < scan.lines.size(); ++i)
    EXPECT_LT(scan.lines[i - 1].seq, scan.lines[i].seq) << "a line is there twice";
  EXPECT_LE(scan.frames.size(), scan.plan.image_angles_rad.size());
  if (const auto lines = kept.running.find(scan.uuid); lines != kept.running.end()) {
    ASSERT_GE(scan.lines.size(), lines->second.count);
    EXPECT_EQ(DigestOfLines(scan, lines->second.count), lines->second.digest);
  }
  if (const auto whole = kept.complete.find(scan.uuid); whole != kept.complete.end()) {
    EXPECT_EQ(DigestOfScan(scan), whole->second);
  }
}

void CheckObjects(const std::vector<DetectionRecord>& records, const Acknowledged& kept) {
  std::map<std::string, Decision> decisions;
  for (const DetectionRecord& record : records)
    EXPECT_TRUE(decisions.emplace(record.uuid, record.decision).second)
        << "an object is there twice";
  for (const std::string& uuid : kept.objects) EXPECT_TRUE(decisions.count(uuid)) << uuid;
  for (const std::string& uuid : kept.accepted)
    EXPECT_EQ(decisions[uuid], Decision::kAccepted) << uuid;
}

}  // namespace

std::vector<std::string> KilledMission::DriverArguments(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), driver_options_.begin(), driver_options_.end());
  return arguments;
}

void KilledMission::SetUp() {
  const auto begin = std::chrono::steady_clock::now();
  const ProgramResult result = RunProgram(MISSION_DRIVER, DriverArguments({other_.string()}));
  whole_mission_s_ =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const Acknowledged all(result.output);
  ASSERT_TRUE(all.end);
  ASSERT_EQ(all.complete.size(), 2u);
  ASSERT_EQ(all.accepted.size(), 2u);
}

void KilledMission::KillAndCheck(std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const TemporaryFolder own;
  const std::filesystem::path mission = own / "m.foresight";
  const std::filesystem::path reviewed = own / "other.foresight";
  std::filesystem::copy_file(other_, reviewed);
  RunningProgram driver(MISSION_DRIVER, DriverArguments({mission.string(), reviewed.string()}));
  WaitForTheMoment(seed, driver);
  driver.Signal(SIGKILL);
  const ProgramResult result = driver.Wait();
  const Acknowledged kept(result.output);
  if (!std::filesystem::exists(mission)) {
    EXPECT_TRUE(kept.complete.empty() && kept.running.empty());
    return;
  }
  const bool killed = result.exit_code == 128 + SIGKILL;
  if (killed && !kept.running.empty()) ExpectOneCommandToGoOn(mission, kept.end);
  CheckMission(mission, kept);
  CheckReview(reviewed, kept);
}

/// Odd seeds: any moment of the mission. Even ones: so many lines into its first or second sweep.
void KilledMission::WaitForTheMoment(std::uint64_t seed, const RunningProgram& driver) const {
  Random random(seed);
  const double moment_s = random.Uniform(0.1, 1.0) * whole_mission_s_;
  const auto sweep = static_cast<std::size_t>(random.Index(2));
  const auto lines = static_cast<std::size_t>(1 + random.Index(40));
  const auto begin = std::chrono::steady_clock::now();
  WaitUntil([&] {
    if (seed % 2 == 1)
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >
             moment_s;
    const Acknowledged now(driver.Output());
    return now.end || (now.complete.size() == sweep && now.newest_lines >= lines &&
                       now.running.size() == sweep + 1);
  });
}

void KilledMission::ExpectOneCommandToGoOn(const std::filesystem::path& mission,
                                           bool mission_ended) const {
  // A program that has closed its file was not interrupted, though it was killed a moment later.
  const bool closed = MissionFile::OpenReadOnly(mission).value()->WasClosedProperly();
  EXPECT_TRUE(!closed || mission_ended);
  const ProgramResult next =
      RunProgram(MISSION_DRIVER, DriverArguments({mission.string(), "go-on"}));
  EXPECT_EQ(next.exit_code, closed ? kNothingToGoOnWith : 0) << next.errors;
}

void KilledMission::CheckMission(const std::filesystem::path& path, const Acknowledged& kept) {
  const auto file = MissionFile::Open(path);
  ASSERT_TRUE(file) << file.error().message;
  const Status sound = (*file)->Verify({});
  EXPECT_TRUE(sound) << sound.error().message;
  const auto scans = (*file)->ListScans().value();
  std::map<std::string, ScanSummary> by_uuid;
  for (const ScanSummary& scan : scans) {
    EXPECT_TRUE(by_uuid.emplace(scan.uuid, scan).second) << "a scan is there twice";
    EXPECT_TRUE(scan.state == ScanState::kComplete || scan.state == ScanState::kInterrupted)
        << ToString(scan.state);
    CheckScan(**file, scan, kept);
  }
  EXPECT_LE(std::count_if(scans.begin(), scans.end(),
                          [](const auto& scan) { return scan.state != ScanState::kComplete; }),
            1);
  interrupted_ += scans.empty() || scans.back().state == ScanState::kComplete ? 0 : 1;
  for (const auto& [uuid, lines] : kept.running) EXPECT_TRUE(by_uuid.count(uuid)) << uuid;
  for (const auto& [uuid, digest] : kept.complete) {
    ASSERT_TRUE(by_uuid.count(uuid)) << uuid;
    EXPECT_EQ(by_uuid[uuid].state, ScanState::kComplete);
  }
  CheckObjects((*file)->ListDetections().value(), kept);
}

void KilledMission::CheckReview(const std::filesystem::path& reviewed,
                                const Acknowledged& kept) const {
  EXPECT_TRUE(BytesOf(reviewed) == BytesOf(other_)) << "a review changes nothing in the mission";
  if (kept.rejected_in_review.empty()) return;
  const auto notes = MissionFile::OpenReadOnly(MissionFile::ReviewPathOf(reviewed).value()).value();
  const auto records = notes->ListDetections().value();
  ASSERT_EQ(records.size(), kept.rejected_in_review.size());
  for (const DetectionRecord& record : records) {
    EXPECT_EQ(kept.rejected_in_review.count(record.uuid), 1u);
    EXPECT_EQ(record.decision, Decision::kRejected);
  }
}

}  // namespace foresight
