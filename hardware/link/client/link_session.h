#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "hardware/link/client/channel_race.h"
#include "hardware/link/client/desk_clock.h"
#include "hardware/link/protocol/messages.h"
#include "sensor_head.grpc.pb.h"

namespace foresight {

/// What all threads of a station's end share: the way to the head, and who we are there. Safe from
/// any thread.
class LinkSession {
 public:
  /// `wants_control`: whether Begin() takes it.
  LinkSession(std::vector<ChannelMaker> channels, std::string address, bool wants_control = true);

  /// For a call with this context: of a channel that is connected, where one is by the context's
  /// deadline.
  std::shared_ptr<link::SensorHead::Stub> stub(const grpc::ClientContext& context);
  bool Connected() const { return race_.Connected(); }
  /// Whether calls would go another way than this one's now.
  bool LeftBehind(const std::shared_ptr<link::SensorHead::Stub>& stub) {
    return stub != CurrentStub();
  }
  /// As ChannelRace has them.
  void Doubt() { race_.Doubt(); }
  void Trust() { race_.Trust(); }
  /// For a call without a deadline: waits until a channel is connected; nullptr = stopped before.
  std::shared_ptr<link::SensorHead::Stub> WaitForStub(const std::stop_token& stop);
  const std::string& address() const { return address_; }

  /// A call's context: the protocol's version and, where `timeout` is positive, a deadline until
  /// which the call also waits for the connection.
  static std::unique_ptr<grpc::ClientContext> Context(std::chrono::milliseconds timeout);
  /// What gRPC says of a call that failed, in words that name the head.
  Error ToError(const grpc::Status& status, const char* what) const;

  /// Identifies both sides to each other and takes control, where the certificate may operate,
  /// nobody else has it, and it was not given away here.
  Status Begin(std::chrono::milliseconds timeout);
  /// That somebody else has control is no failure: this station looks on.
  Status TakeControl(std::chrono::milliseconds timeout);
  /// To `successor`, or empty: to whoever takes it. Fails with kState where we do not have it.
  Status GiveControl(const std::string& successor, std::chrono::milliseconds timeout);
  /// Whether control is to be ours when nobody has it.
  bool WantsControl() const;

  link::IdentifyReply HeadIdentity() const;
  std::string Token() const;
  std::string Holder() const;
  /// Who has control, as the head said at `desk_time_s`.
  void HeardControl(const std::string& holder, double desk_time_s);
  /// The desk's time of a message that just came.
  void Heard(double desk_time_s);
  double DeskTime() const;
  /// Of the last sign of life, s; 0 = not known yet.
  double RoundTrip() const { return round_trip_s_; }
  void SetRoundTrip(double seconds) { round_trip_s_ = seconds; }
  /// Seconds of this computer's clock.
  static double Now();

 private:
  std::shared_ptr<link::SensorHead::Stub> CurrentStub();

  const std::string address_;
  ChannelRace race_;
  std::atomic<double> round_trip_s_{0.0};
  mutable std::mutex mutex_;                ///< guards what follows
  std::shared_ptr<grpc::Channel> channel_;  ///< that stub_ is for
  std::shared_ptr<link::SensorHead::Stub> stub_;
  link::IdentifyReply identity_;
  std::string token_;
  std::string holder_;
  bool wants_control_;
  double control_changed_desk_s_ = 0.0;
  DeskClock clock_;
};

}  // namespace foresight
