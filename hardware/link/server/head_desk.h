#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "hardware/api/moving_stand.h"
#include "hardware/api/sensor_head.h"
#include "hardware/link/robot/pose_gate.h"
#include "hardware/link/server/burst_desk.h"
#include "hardware/link/server/command_log.h"
#include "hardware/link/server/control_lease.h"
#include "hardware/link/server/scan_shelf.h"
#include "hardware/link/server/stop_shelf.h"
#include "sensor_head.pb.h"

namespace foresight {

/// Takes the stations' commands for a head, whatever brings them. It decides whether a command is
/// carried out: the sender has control, the command is in time and for this run of the program, and
/// it did not come before. Safe from any thread.
class HeadDesk {
 public:
  struct Options {
    double lease_s = ControlLease::kUsualLease_s;
    bool simulated = false;
    PoseGate* gate = nullptr;  ///< to the robot; null = there is none. Outlives the desk.
    double burst_bytes_per_s = BurstDesk::kUsualBytesPerS;  ///< 0 = no bursts
    /// Of a simulated world; null = it is carried, as every real one is. Outlives the desk.
    MovingStand* stand = nullptr;
  };

  /// `shelf` outlives the desk.
  HeadDesk(std::shared_ptr<SensorHead> head, ScanShelf& shelf, const Options& options);

  /// What the desk knows of who calls, from the certificate.
  struct Peer {
    std::string name;
    bool may_operate = false;
  };

  link::IdentifyReply Identify(const Peer& peer) const;
  link::ControlReply TakeControl(const link::ControlRequest& request, const Peer& peer);
  link::ControlReply ReleaseControl(const link::ReleaseRequest& request);
  link::Outcome Execute(const link::Command& command, const Peer& peer);
  /// Any operator may stop the head, with control or without.
  /// What moves the head and was given before `pressed_s` is refused from now on, however late it
  /// comes: a scan that waited in a broken link does not begin after the stop.
  /// @param pressed_s Time() when it was pressed, as far as the station knows it; 0 = now
  link::Outcome Stop(const Peer& peer, double pressed_s = 0.0);
  /// Hands an accepted pose on to the robot, and waits for its answer.
  link::PoseReply PublishPose(const link::PoseRequest& request, const Peer& peer);
  /// Renews the lease; the head hears that somebody is there. False for who has no control.
  bool SignOfLife(const std::string& token);

  /// Puts the live view in place of another station's.
  Status StartLiveView(const LiveViewOptions& options, std::shared_ptr<LiveViewSink> sink);
  bool ShowsTo(const LiveViewSink* sink) const;
  /// Unless another one has replaced it.
  void StopLiveView(const LiveViewSink* sink);
  /// Of the last run of stops; nullptr where there was another one since, or none.
  std::shared_ptr<StopShelf> Stops(const std::string& id) const;

  link::Status Now(bool with_health) const;
  const std::string& boot_id() const { return boot_id_; }
  std::string Holder() const { return lease_.Holder(Time()); }
  bool HasControl(const std::string& token) const { return lease_.Holds(token, Time()); }
  /// The rig in force; fails with kInvalidInput where `rig_id` is another one's and not empty.
  Result<std::string> RigYaml(const std::string& rig_id) const;
  /// nullptr where it is carried.
  const MovingStand* Stand() const { return options_.stand; }
  /// Seconds since the desk was made.
  double Time() const;

  ScanShelf& shelf() { return shelf_; }
  BurstDesk& bursts() { return bursts_; }
  SensorHead& head() { return *head_; }

 private:
  Status Check(const link::Command& command, const Peer& peer) const;
  Status Carry(const link::Command& command);
  /// Whether a stop was pressed after the command was given.
  bool Stopped(const link::Command& command) const;
  Status StartScan(const link::StartScan& start);
  Status EndScan(const link::EndScan& end);
  HeadFacts Facts() const;
  Status SetRig(const link::SetRig& set);
  Status StartStops(const link::StartStops& start);
  Status MoveStand(const link::MoveStand& move);

  const std::shared_ptr<SensorHead> head_;
  ScanShelf& shelf_;
  const Options options_;
  const std::string boot_id_;
  const std::chrono::steady_clock::time_point start_;
  ControlLease lease_;
  BurstDesk bursts_;

  std::atomic<double> stopped_s_ = -1.0;  ///< when the last stop was pressed
  std::mutex commands_;                   ///< one command at a time; guards the log
  CommandLog<link::Outcome> log_;
  mutable std::mutex names_;  ///< guards what follows
  std::string scan_id_;       ///< of the running or last scan
  std::string rig_id_;
  const LiveViewSink* shown_to_ = nullptr;
  std::shared_ptr<StopShelf> stops_;
};

/// Fails with kInvalidInput where it is not 1 to 64 letters, digits and dashes.
Status CheckId(const char* what, const std::string& id);

}  // namespace foresight
