#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "hardware/api/camera.h"
#include "hardware/api/sensor_clock.h"
#include "hardware/gige/gige_session.h"

namespace foresight {

/// A GigE Vision camera with a software trigger, through Aravis.
///
/// A thread of its own holds the connection: it alone asks the camera, because every question to a
/// camera that is gone blocks for seconds. When the camera is lost it is opened anew, for as long
/// as it takes, and gets the last settings again. Errors begin with "camera ADDRESS: ".
///
/// An image that is overdue by frame_timeout_s is lost: WaitForFrame fails once for each, and the
/// camera is suspect until it answers.
class GigeCamera final : public Camera {
 public:
  /// `clock` runs in real time. Throws ContractViolation when the options do not pass their
  /// Check().
  GigeCamera(const GigeCameraOptions& options, std::shared_ptr<const SensorClock> clock);
  /// Returns at once when the camera is well. When it is gone, Aravis asks it five times in
  /// vain, 2.5 s each: up to 13 s. Stop what moves before.
  ~GigeCamera() override;

  std::string Describe() const override { return name_; }
  /// Waits at most connect_timeout_s; attempts go on after a failure. Returns at once when
  /// connected. Images that have not been handed out are forgotten.
  Status Connect() override;
  /// Waits for the camera to take them, at most configure_timeout_s. Fails with kInvalidOptions
  /// beyond the camera's limits.
  Status Configure(const CameraSettings& settings) override;
  /// Never waits for the camera. Fails while it is not connected or suspect.
  Result<std::int64_t> Trigger() override;
  /// Also fails when an image is overdue. `seq` counts the triggers, `time_s` is the middle of the
  /// exposure on the head's clock.
  Result<std::optional<CameraFrame>> WaitForFrame(std::chrono::milliseconds timeout) override;

  CameraHealth Health() const override;

 private:
  using SteadyClock = std::chrono::steady_clock;

  /// A trigger whose image is still to come.
  struct Expected {
    std::int64_t seq = 0;
    double called_s = 0.0;
    std::optional<double> sent_s;  ///< just before the camera was asked
    CameraSettings settings;
    bool overdue = false;
  };
  struct DesiredSettings {
    CameraSettings settings;
    std::int64_t number = 0;  ///< counts the requests for settings; 0 = none so far
  };

  // The thread:
  void Work(const std::stop_token& stop);
  void OpenSession(const std::stop_token& stop);
  Status BeginSession(GigeSession& session);
  void DropSession(const std::string& why);
  void Attend(const std::stop_token& stop);
  void WaitForWork(const std::stop_token& stop);
  void ApplyDesiredSettings();
  void SendTriggers();
  void TakeImages();
  void HandOn(GigeSession::ReceivedImage received);
  void ProbeIfSuspect();
  void KeepHouse();
  Status ReadClock(GigeSession& session);
  void Wake();

  // With the mutex held:
  bool MarkOverdue() const;
  double DueAt(const Expected& expected) const;
  double NextDue() const;
  std::optional<Expected> TakeExpected(double start_s);
  std::optional<Expected> TakeOldestExpected();
  void CountSession();
  Status CheckLimits(const CameraSettings& settings) const;
  tl::unexpected<Error> FailWith(const std::string& message) const;

  const GigeCameraOptions options_;
  const std::shared_ptr<const SensorClock> clock_;
  const std::string name_;  ///< "camera ADDRESS"

  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  bool wanted_ = false;
  bool connected_ = false;
  mutable bool suspect_ = false;
  mutable bool probe_due_ = false;
  bool images_waiting_ = false;  ///< in the stream of the session
  std::int64_t next_seq_ = 0;
  mutable std::deque<Expected> expected_;
  std::deque<std::int64_t> triggers_;  ///< not sent yet
  std::deque<CameraFrame> frames_;
  DesiredSettings desired_;
  std::int64_t applied_ = 0;  ///< number of the desired settings that were applied
  Status applied_status_;
  GigeSession::Limits limits_;
  CameraHealth health_;
  GigeSession::Counts earlier_;  ///< of sessions that are over

  // Of the thread alone:
  std::unique_ptr<GigeSession> session_;
  CameraClock camera_clock_;
  CameraSettings settings_;  ///< in force
  SteadyClock::time_point last_reading_;
  double backoff_s_ = 0.0;
  int sessions_ = 0;

  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace foresight
