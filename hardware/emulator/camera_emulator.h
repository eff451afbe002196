#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/simulation/world.h"
#include "hardware/emulator/camera_device.h"
#include "hardware/emulator/gvsp_ring.h"
#include "hardware/net/udp_socket.h"
#include "hardware/net/wake_up.h"
#include "hardware/simulated/simulated_clock.h"
#include "hardware/simulated/simulated_shaft.h"

namespace foresight {

struct CameraEmulatorOptions {
  /// The port is GigE Vision's and cannot be chosen, so several cameras have several addresses.
  std::string address = "127.0.0.1";
  CameraRegisters::Identity identity;
  CameraFaults faults;
};

/// A GigE Vision camera on UDP ports: what the simulated camera takes, in the packets of a real one
/// and at the rate of a gigabit link. One thread answers requests, another renders and sends: an
/// image that takes a second to render delays no heartbeat. Injections act on the running device
/// and may be called from any thread.
class CameraEmulator {
 public:
  /// From the end of the exposure to the first packet.
  static constexpr double kReadout_s = 0.03;

  /// `clock` runs in real time and is the head's; the device has a clock of its own. Fails with
  /// kDevice when the port is taken, kInvalidOptions for bad faults.
  static Result<std::unique_ptr<CameraEmulator>> Start(std::shared_ptr<const World> world,
                                                       std::shared_ptr<SimulatedClock> clock,
                                                       std::shared_ptr<const SimulatedShaft> shaft,
                                                       const CameraEmulatorOptions& options);
  ~CameraEmulator();

  const std::string& address() const { return control_.address().host; }

  /// From now on such a fraction of the stream's packets is lost.
  void InjectPacketLoss(double fraction);
  /// From now on nothing is answered or sent for so long, as with the cable pulled.
  void InjectVanish(double seconds);
  /// The next triggers are acknowledged and ignored.
  void InjectIgnoredTriggers(int triggers);
  /// The next images leave late.
  void InjectSlowFrames(int frames, double seconds);

  /// Ends all that was injected.
  void ClearFaults();

  /// An image as it truly was taken.
  struct Taken {
    std::int64_t seq = 0;   ///< of World::CaptureImage
    double middle_s = 0.0;  ///< of the exposure, on the head's clock
    double exposure_s = 0.0;
    double gain_db = 0.0;
    gvsp::PixelFormat format = gvsp::PixelFormat::kRGB8;
  };
  /// All of them, in order.
  std::vector<Taken> taken() const;

  struct Counts {
    int frames = 0;  ///< sent
    int ignored_triggers = 0;
    std::int64_t packets = 0;  ///< with the lost ones
    std::int64_t lost_packets = 0;
    std::int64_t resent_packets = 0;
    std::int64_t fault_effects = 0;  ///< how often a fault changed what the client got
  };
  Counts counts() const;

 private:
  /// An image on its way through the camera.
  struct Job {
    CameraExposure exposure;
    std::int64_t seq = 0;
    std::uint64_t timestamp = 0;
    int acquisition = 0;
    double late_s = 0.0;
  };
  struct Injections {
    double loss_ratio = 0.0;
    double gone_until_s = 0.0;
    int ignored_triggers = 0;
    int slow_frames = 0;
    double slow_s = 0.0;
  };

  CameraEmulator(std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
                 std::shared_ptr<const SimulatedShaft> shaft, const CameraEmulatorOptions& options,
                 UdpSocket control, UdpSocket stream);

  // The thread that answers:
  void Serve(const std::stop_token& stop);
  void HandleRequest(std::span<const std::uint8_t> packet, const UdpPeer& from);
  void ApplyCommands();
  void Trigger(double now_s);
  void Resend(const gvcp::PacketResend& resend);
  void SendTestPacket();
  void FinishAcquisition();

  // The thread that renders:
  void Work(const std::stop_token& stop);
  void Deliver(const Job& job, const std::stop_token& stop);
  void SendFrame(const GvspFrame& frame, const CameraStreamSetup& setup,
                 const std::stop_token& stop);

  // Of both:
  bool GoneAt(double time_s) const;
  /// Whether what is asked or sent now is lost because the camera is gone.
  bool LosesAt(double time_s);
  /// `round` counts how often this packet has been sent before.
  void SendPacket(const GvspFrame& frame, std::uint32_t number, const UdpPeer& to,
                  std::int64_t round);
  bool Current(int acquisition) const;

  const std::shared_ptr<const World> world_;
  const std::shared_ptr<SimulatedClock> clock_;
  const std::shared_ptr<const SimulatedShaft> shaft_;
  const CameraFaults faults_;
  const double power_on_s_;
  UdpSocket control_;
  UdpSocket stream_;
  const WakeUp wake_;
  GvspRing ring_;

  mutable std::mutex mutex_;
  std::condition_variable_any work_;
  std::deque<Job> jobs_;
  int acquisition_ = 0;  ///< the device's
  Injections injections_;
  Counts counts_;
  std::vector<Taken> taken_;

  // Of the answering thread alone:
  CameraDevice device_;
  std::int64_t next_seq_ = 0;
  std::int64_t resend_rounds_ = 0;
  double next_free_run_s_ = 0.0;
  // Of the rendering thread alone:
  std::uint16_t next_block_;
  int block_acquisition_ = -1;

  std::jthread renderer_;
  std::jthread server_;  ///< last: they use all of the above
};

}  // namespace foresight
