#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hardware/api/sensor_head.h"

namespace foresight {

/// A scan that a head keeps for its stations.
struct ShelvedScan {
  std::string uuid;
  ScanState state = ScanState::kRunning;
  std::string reason;
  std::int64_t begin_utc_ns = 0;
  int lines = 0;
  int expected_lines = 0;
  int frames = 0;
  std::string rig_id;
  bool simulated = false;
  std::chrono::steady_clock::time_point begun;  ///< also of one from before this program's start
  bool confirmed = false;                       ///< a station has all of it
  std::int64_t file_bytes = 0;
  std::int64_t news = 0;  ///< ScanShelf::News() when this changed last
};

/// Where a head keeps its scans: a folder with one mission file a scan, and the scan that runs.
/// Holds as many as fit into a share of the disk: the oldest ones that a station has confirmed make
/// room for new ones, and a scan that no station has is never deleted. Safe from any thread.
class ScanShelf {
 public:
  struct Options {
    std::filesystem::path folder;
    double disk_ratio = 0.5;  ///< of the disk that the folder is on
  };

  /// Takes in what an earlier run left; a scan that a crash cut short is interrupted. A file that
  /// cannot be read is left alone, and logged. Fails with kIo where the folder cannot be made, and
  /// kInvalidOptions.
  static Result<std::unique_ptr<ScanShelf>> Open(const Options& options);
  ~ScanShelf();
  ScanShelf(const ScanShelf&) = delete;
  ScanShelf& operator=(const ScanShelf&) = delete;

  /// A sink that records one scan into a file of its own, under this uuid. Fails with kIo where
  /// the file cannot be made or there is no room, with what would make some; kInvalidInput where
  /// the shelf has a scan of this uuid.
  Result<std::shared_ptr<ScanSink>> Begin(const std::string& uuid, const ScanPrediction& expected);
  /// The scan that was begun did not start after all.
  void Withdraw(const std::string& uuid);
  /// Oldest first.
  std::vector<ShelvedScan> List() const;
  /// Fails with kInvalidInput where there is no such scan.
  Result<ShelvedScan> Find(const std::string& uuid) const;
  /// What of a scan is on the disk now; never changes afterwards. Fails as Find does, with kState
  /// where it has not begun, and as MissionFile::LoadScan does.
  Result<std::shared_ptr<const Scan>> Snapshot(const std::string& uuid);
  /// How the devices did, as JSON; empty where the scan has not ended or nothing was recorded.
  std::string DeviceHealthJson(const std::string& uuid) const;
  /// A station has all of the scan: it may be deleted when room is needed.
  Status Confirm(const std::string& uuid, const std::string& by);

  /// Grows with everything that changes here.
  std::int64_t News() const;
  /// Returns News() when it is more than `seen`, or when the time is over.
  std::int64_t WaitForNews(std::int64_t seen, std::chrono::milliseconds timeout) const;
  /// Of the share of the disk.
  std::int64_t FreeBytes() const;

 private:
  class Recording;
  struct Entry {
    ShelvedScan scan;
    std::filesystem::path path;
    std::shared_ptr<Recording> recording;  ///< while it runs
    std::weak_ptr<const Scan> loaded;
    std::string health_json;
  };

  explicit ScanShelf(const Options& options) : options_(options) {}
  void TakeIn(const std::filesystem::path& path);
  Status MakeRoom(std::int64_t bytes);
  std::int64_t ShareBytes() const;
  std::int64_t UsedBytes() const;
  void Changed(Entry& entry);
  void Tidy(const std::stop_token& stop);
  void Finish(const std::string& uuid, Recording& recording);

  const Options options_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::map<std::string, Entry> entries_;  ///< by uuid
  std::int64_t news_ = 0;
  std::shared_ptr<const Scan> last_loaded_;  ///< the one that is being sent is read once
  std::jthread tidier_;                      ///< closes files of scans that have ended
};

}  // namespace foresight
