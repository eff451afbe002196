#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "hardware/emulator/emulated_drive.h"
#include "hardware/emulator/modbus_server.h"
#include "hardware/emulator/motor_faults.h"
#include "hardware/simulated/simulated_clock.h"

namespace foresight {

struct MotorEmulatorOptions {
  TcpAddress address;  ///< port 0 takes a free one
  EmulatedDriveOptions drive;
  std::vector<MotorFault> faults;  ///< planned ones; Inject adds others
};

/// A motor's drive on a TCP port: an EmulatedDrive behind Modbus TCP, turning the shaft that lidar
/// and camera see. Its encoder counts from the shaft's angle at the start until it is homed. The
/// client that wrote last commands: its requests feed the drive's watchdog, those of others that
/// only read do not.
class MotorEmulator final : private RegisterDevice {
 public:
  /// The clock runs in real time. Fails with kDevice when the port is taken.
  static Result<std::unique_ptr<MotorEmulator>> Start(std::shared_ptr<const World> world,
                                                      std::shared_ptr<SimulatedClock> clock,
                                                      std::shared_ptr<SimulatedShaft> shaft,
                                                      const MotorEmulatorOptions& options);
  /// The drive loses its power: the shaft stops.
  ~MotorEmulator() override;

  /// Where to connect.
  const TcpAddress& address() const { return server_->address(); }

  /// A fault that begins now; `after_s` is not used. Safe from any thread.
  void Inject(const MotorFault& fault);
  /// Ends all running faults.
  void ClearFaults();

  /// How often a fault changed what the shaft did or what a client read.
  int fault_effects() const;

  /// The shaft's true angle where the drive counts 0.
  double zero_rad() const;
  /// What a host would read now; does not feed the watchdog.
  cia402::TxImage State() const;

 private:
  struct Running {
    MotorFault::Kind kind;
    double end_s;
  };

  MotorEmulator(std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
                std::shared_ptr<SimulatedShaft> shaft, const MotorEmulatorOptions& options);

  std::optional<std::vector<std::uint16_t>> Read(ClientId client, std::uint16_t first,
                                                 std::uint16_t count) override;
  bool Write(ClientId client, std::uint16_t first, std::span<const std::uint16_t> values) override;

  void Work(const std::stop_token& stop);
  void Wake();  ///< with the mutex held
  void RunFaults(double time_s);
  void CountEffects(double time_s);
  bool Runs(MotorFault::Kind kind) const;
  void Begin(const MotorFault& fault, double time_s);
  void End(MotorFault::Kind kind, double time_s);

  std::shared_ptr<SimulatedClock> clock_;
  std::shared_ptr<SimulatedShaft> shaft_;
  const MotorEmulatorOptions options_;
  const double started_s_;

  mutable std::mutex mutex_;  ///< guards the drive and the faults
  EmulatedDrive drive_;
  ClientId commander_ = 0;           ///< wrote last; 0 = nobody
  std::vector<MotorFault> planned_;  ///< latest first
  std::vector<Running> running_;
  int fault_effects_ = 0;
  bool awake_ = false;
  std::condition_variable_any wake_;

  std::unique_ptr<ModbusServer> server_;
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
