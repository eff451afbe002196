#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hardware/api/motor.h"
#include "hardware/api/sensor_clock.h"
#include "hardware/motor/drive_procedure.h"
#include "hardware/motor/modbus_link.h"
#include "hardware/motor/modbus_motor_options.h"
#include "hardware/motor/round_trips.h"

namespace foresight {

/// A CiA 402 drive over Modbus TCP. One thread owns the connection: it polls the encoder, carries
/// out what the callers asked for, and reconnects. No call but Connect and the destructor waits for
/// the drive: what goes wrong shows in Moving() and Position(), which fail until the operator homes
/// again. Every error stops the motor; a drive that lost us stops by its own watchdog.
///
/// The reference is lost with the connection (the drive may have lost its power) and with a fault.
/// Only StartHoming clears a fault.
class ModbusMotor final : public Motor {
 public:
  /// `clock` runs in real time. Throws ContractViolation when the options do not pass their
  /// Check().
  ModbusMotor(const ModbusMotorOptions& options, std::shared_ptr<SensorClock> clock);
  ~ModbusMotor() override;

  std::string Describe() const override { return name_; }
  /// Waits for the connection, at most a second or so. A drive that is not CiA 402 is refused.
  /// Nothing moves.
  Status Connect() override;
  Status StartHoming() override;
  bool Homed() const override;
  /// Also fails with kDevice beyond the limits of the options: nothing moves then.
  Status StartMove(double angle_rad, double speed_rad_s) override;
  Result<bool> Moving() override;
  /// The last sample, carried on to now by the drive's speed.
  Result<MotorSample> Position() override;
  std::vector<MotorSample> TakeTrack() override;
  void QuickStop() override;
  MotorHealth Health() const override;

 private:
  using WallClock = std::chrono::steady_clock;

  enum class Job { kHoming, kMove, kStop };
  struct Task {
    Job job;
    DriveProcedure procedure;
  };
  struct Fault {
    std::string message;
    bool of_link;  ///< over when the link is back and the operator connects again
  };
  struct Last {
    MotorSample sample;
    double speed_rad_s = 0.0;
  };

  // The thread.
  void Work(const std::stop_token& stop);
  void KeepConnected(const std::stop_token& stop);
  Status OpenLink();
  void TakeTask();
  void Poll();
  void Keep(const cia402::TxImage& drive, double sent_s, double answered_s);
  void WatchForFault(const cia402::TxImage& drive);
  void Continue(const cia402::TxImage& drive);
  bool Write(const DriveWrites& writes);
  void FinishTask();
  void StopAfter(const std::string& message);
  void LoseLink(const std::string& message);
  double PollRate_hz() const;
  void Rest(const std::stop_token& stop, WallClock::time_point until);

  // All below: with the mutex held.
  Status CheckReady() const;
  void Post(Job job, DriveProcedure procedure);
  std::string With(const std::string& message) const;

  std::int32_t Counts(double angle_rad) const;

  const ModbusMotorOptions options_;
  const std::shared_ptr<SensorClock> clock_;
  const std::string name_;
  const double count_rad_;

  // The thread's own.
  ModbusLink link_;
  std::optional<Task> task_;
  WallClock::time_point next_poll_;
  WallClock::time_point last_active_;  ///< when the motor last turned or had something to do
  std::chrono::milliseconds backoff_{0};
  int connections_ = 0;

  mutable std::mutex mutex_;  ///< guards all below
  std::condition_variable_any wake_;
  std::condition_variable changed_;  ///< an attempt to connect has ended
  bool connected_ = false;
  bool connect_now_ = false;
  int attempts_ = 0;
  std::string last_attempt_;
  bool homed_ = false;
  bool busy_ = false;            ///< moving, or asked to
  bool stop_requested_ = false;  ///< before everything else
  std::optional<Task> posted_;
  std::optional<Fault> fault_;
  std::optional<Last> last_;
  std::deque<MotorSample> track_;
  RoundTrips round_trips_;
  MotorHealth health_;

  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace foresight
