#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/sensor/lidar_line.h"
#include "hardware/emulator/lidar_faults.h"
#include "hardware/scip/scip_codec.h"

namespace foresight {

/// The mind of an emulated SCIP lidar: which state it is in and what it answers. No sockets, no
/// threads; times are on the head's clock.
class ScipDevice {
 public:
  struct Identity {
    std::string model = "UTM-30LX-EW";
    std::string serial = "E0000001";
  };

  /// Powered on at `now_s`.
  ScipDevice(const LidarModel& lidar, const Identity& identity, const LidarFaults& faults,
             double now_s);

  /// The bytes of the reply to one line of a client. `newest_line` measures the line that a single
  /// scan reports.
  std::string Answer(std::string_view request, double now_s,
                     const std::function<LidarLine()>& newest_line);
  /// A client has come: what the one before began is over.
  void BeginConnection();

  bool Streaming() const { return mode_ == Mode::kStreaming; }
  /// Turns of the mirror from one scan of the stream to the next.
  int TurnsPerScan() const { return 1 + stream_.skip; }
  /// The bytes of the stream's next scan. Ends a stream whose scans are counted.
  std::string StreamScan(const LidarLine& line);

  /// Whether it has been rebooted since the last call: the connection is gone.
  bool TakeReboot();
  void EnterAbnormalState() { abnormal_ = true; }
  /// The clock is so many seconds ahead from now on, or behind.
  void ShiftClock(double seconds) { clock_shift_s_ += seconds; }
  /// The clock shows what it showed at `time_s`, until it goes on as if it had never stood.
  void StopClock(double time_s) { clock_stopped_s_ = time_s; }
  void ResumeClock() { clock_stopped_s_.reset(); }
  /// From now on the last beams of each scan are missing.
  void LoseBeams(int beams) { faults_.missing_beams = beams; }
  /// Milliseconds, 24 bits.
  std::uint32_t ClockAt(double time_s) const;
  /// The same without faults.
  std::uint32_t HealthyClockAt(double time_s) const;
  /// Whether it refuses to work.
  bool Hindered(double now_s) const { return Hindrance(now_s).has_value(); }

 private:
  enum class Mode { kIdle, kLaserOn, kTime, kStreaming };

  std::string AnswerTime(const ScipRequest& request, double now_s);
  std::string AnswerScan(const ScipRequest& request, double now_s,
                         const std::function<LidarLine()>& newest_line);
  std::string AnswerReboot(const std::string& echo, double now_s);
  std::string AnswerVersion(const std::string& echo) const;
  std::string AnswerState(const std::string& echo, double now_s) const;
  /// The status that keeps it from working; nullopt when it can.
  std::optional<std::string_view> Hindrance(double now_s) const;
  std::string Encode(const ScipRequest& request, const LidarLine& line) const;

  ScipParameters parameters_;
  Identity identity_;
  LidarFaults faults_;
  double power_on_s_;
  std::uint32_t clock_start_ms_;
  double clock_shift_s_ = 0.0;
  std::optional<double> clock_stopped_s_;
  bool abnormal_;
  Mode mode_ = Mode::kIdle;
  ScipRequest stream_;
  int quits_ = 0;
  std::optional<double> reboot_asked_s_;
  bool rebooted_ = false;
};

}  // namespace foresight
