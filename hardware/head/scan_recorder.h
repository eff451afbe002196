#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "core/mission/mission_file.h"
#include "hardware/api/sensor_head.h"
#include "hardware/head/disk_reserve.h"

namespace foresight {

/// Writes scans into a mission file from a thread of its own, so the lidar never waits for the
/// disk. After the first failure nothing more of that scan is written; what is on the disk stays
/// readable and says how many lines were kept, and Failure() tells the head to end the sweep.
///
/// `then`, where there is one, hears the scan as the file has it: each piece when it is on the
/// disk, nothing of what was not written, and the end that the file states. From the recorder's
/// thread.
class ScanRecorder final : public ScanSink {
 public:
  explicit ScanRecorder(std::shared_ptr<MissionFile> mission,
                        std::shared_ptr<ScanSink> then = nullptr);
  /// Writes what is waiting; a scan that has not ended becomes interrupted.
  ~ScanRecorder() override;

  void OnScanStarted(const Scan& header) override;
  void OnLine(const LidarLine& line) override;
  void OnMotorSamples(std::span<const MotorSample> samples) override;
  void OnFrame(const CameraFrame& frame) override;
  /// "m.foresight: the disk is full: 212 of 480 lines were kept".
  std::optional<std::string> Failure() const override;
  /// Becomes an event of the mission, a warning where a device had trouble.
  void OnDeviceHealth(const HeadHealth& at_start, const HeadHealth& at_end) override;
  void OnScanEnded(ScanState state, const std::string& reason) override;
  Status WaitUntilKept() override;

  /// Waits until everything handed over so far is on the disk. Returns the id of the newest scan,
  /// or why it could not be written.
  Result<std::int64_t> WaitUntilWritten();

 private:
  struct End {
    ScanState state;
    std::string reason;
  };
  struct Health {
    HeadHealth at_start;
    HeadHealth at_end;
  };
  using Piece =
      std::variant<Scan, LidarLine, std::vector<MotorSample>, CameraFrame, Health, End, Error>;

  void Push(Piece piece, std::size_t bytes);
  void Work(const std::stop_token& stop);
  void WriteAll(const std::deque<Piece>& pieces);
  Status Write(const Piece& piece);
  Status WriteHeader(const Scan& header);
  Status WriteHealth(std::int64_t scan_id, const Health& health);
  End GiveUp(const Error& error);
  void HandOn(const Piece& piece);
  void Tell(const Piece& piece);
  std::string WhatWasKept(std::int64_t id) const;

  const std::shared_ptr<MissionFile> mission_;
  const std::shared_ptr<ScanSink> then_;  ///< may be null

  // The writing thread's own:
  std::optional<std::int64_t> running_;
  int planned_lines_ = 0;
  int begun_ = 0;            ///< scans whose header was written, or was to be
  bool then_hears_ = false;  ///< it heard the start of a scan and not its end
  DiskReserve reserve_;

  mutable std::mutex mutex_;            ///< guards what follows
  int started_ = 0;                     ///< scans that were handed over
  std::optional<std::string> failure_;  ///< of the scan that was handed over last
  std::deque<Piece> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool overflowed_ = false;  ///< the rest of this scan is not taken
  bool idle_ = true;
  Result<std::int64_t> outcome_;
  std::condition_variable_any wake_;
  std::condition_variable_any written_;
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
