#pragma once

#include <memory>
#include <mutex>
#include <thread>

#include "core/simulation/world.h"
#include "hardware/emulator/lidar_faults.h"
#include "hardware/emulator/scip_device.h"
#include "hardware/net/tcp_listener.h"
#include "hardware/net/wake_up.h"
#include "hardware/simulated/simulated_clock.h"
#include "hardware/simulated/simulated_shaft.h"

namespace foresight {

struct ScipEmulatorOptions {
  TcpAddress address;  ///< default: a free port of 127.0.0.1
  ScipDevice::Identity identity;
  LidarFaults faults;
};

/// A lidar on a TCP port: what the simulated lidar measures, in the bytes of the real one and at
/// its pace. Serves one client; others are refused meanwhile. Injections act on the running device
/// and may be called from any thread.
class ScipEmulator {
 public:
  /// `clock` runs in real time and is the head's; the device has a clock of its own. Fails with
  /// kDevice when it cannot listen, kInvalidOptions for bad faults.
  static Result<std::unique_ptr<ScipEmulator>> Start(std::shared_ptr<const World> world,
                                                     std::shared_ptr<SimulatedClock> clock,
                                                     std::shared_ptr<const SimulatedShaft> shaft,
                                                     const ScipEmulatorOptions& options);
  ~ScipEmulator();

  const TcpAddress& address() const { return address_; }

  /// From now on the stream is silent for so long; requests are answered. A reboot ends it.
  void InjectStall(double seconds);
  /// From now on nothing at all is answered for so long.
  void InjectSilence(double seconds);
  /// Resets the connection.
  void InjectReset();
  /// Flips a bit in each of the next scans.
  void InjectCorruptScans(int scans);
  /// The device's clock jumps, ahead or back.
  void InjectClockJump(double seconds);
  /// The device's clock stands still for so long.
  void InjectStoppedClock(double seconds);
  /// The next scans lack their last beams; all sums are right.
  void InjectMissingBeams(int beams, int scans);
  /// Refuses to work until rebooted; a running stream ends.
  void InjectAbnormalState();

  /// Forgets what was injected and has not happened yet.
  void ClearFaults();

  struct Counts {
    int clients = 0;
    int scans = 0;  ///< sent, corrupted ones too
    int corrupted = 0;
    int skipped = 0;  ///< not sent because this process came too late
    int reboots = 0;
    int fault_effects = 0;  ///< how often a fault changed what the client got
  };
  Counts counts() const;

 private:
  ScipEmulator(std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
               std::shared_ptr<const SimulatedShaft> shaft, const ScipEmulatorOptions& options,
               TcpListener listener);

  /// What was injected and has not been looked at.
  struct Injections {
    double stalled_until_s = 0.0;
    double silent_until_s = 0.0;
    bool reset = false;
    bool abnormal = false;
    int corrupt_scans = 0;
    double clock_jump_s = 0.0;
    double clock_stops_until_s = 0.0;
    int missing_beams = 0;
    int short_scans = 0;
  };

  void Work(const std::stop_token& stop);
  void ServeClient(TcpSocket& client, const std::stop_token& stop);
  Status HandleRequest(TcpSocket& client, std::string_view bytes);
  Status SendDueLine(TcpSocket& client);
  Status Send(TcpSocket& client, std::string_view bytes);
  void CountEffect();
  bool FollowInjections(TcpSocket& client);
  void ApplyFaultsOfTurn(std::int64_t turn);
  void EndReboot(TcpSocket& client);
  LidarLine MeasureTurn(std::int64_t turn) const;
  double TurnReady_s(std::int64_t turn) const;
  std::int64_t NextTurn() const;  ///< not begun yet
  std::int64_t LastTurn() const;  ///< complete

  const std::shared_ptr<const World> world_;
  const std::shared_ptr<SimulatedClock> clock_;
  const std::shared_ptr<const SimulatedShaft> shaft_;
  const LidarFaults faults_;
  TcpListener listener_;
  const TcpAddress address_;
  const WakeUp wake_;

  mutable std::mutex mutex_;
  Injections injections_;
  Counts counts_;

  // Of the thread alone:
  ScipDevice device_;
  ScipRequestReader reader_;
  std::int64_t next_turn_ = 0;
  bool clock_stopped_ = false;

  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace foresight
