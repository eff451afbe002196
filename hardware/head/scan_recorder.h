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
class ScanRecorder final : public ScanSink {
 public:
  explicit ScanRecorder(std::shared_ptr<MissionFile> mission);
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

  /// Waits until everything handed over so far is on the disk. Returns the id of the newest scan,
  /// or why it could not be written.
  Result<std::int64_t> WaitUntilWritten();

 private:
  struct End {
    ScanState state;
    std::string reason;
  };
  using Piece =
      std::variant<Scan, LidarLine, std::vector<MotorSample>, CameraFrame, EventRecord, End, Error>;

  void Push(Piece piece, std::size_t bytes);
  void Work(const std::stop_token& stop);
  void WriteAll(std::deque<Piece>& pieces);
  Status Write(const Piece& piece);
  Status WriteHeader(const Scan& header);
  void GiveUp(const Error& error);
  std::string WhatWasKept(std::int64_t id) const;

  std::shared_ptr<MissionFile> mission_;

  // The writing thread's own:
  std::optional<std::int64_t> running_;
  int planned_lines_ = 0;
  int begun_ = 0;  ///< scans whose header was written, or was to be
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
