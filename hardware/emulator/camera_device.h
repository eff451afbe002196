#pragma once

#include <optional>
#include <vector>

#include "hardware/emulator/camera_faults.h"
#include "hardware/emulator/camera_registers.h"
#include "hardware/net/udp_socket.h"

namespace foresight {

/// Where a camera sends its images, and in what pieces.
struct CameraStreamSetup {
  UdpPeer to;
  std::size_t packet_bytes = 0;  ///< with all headers
  double packet_delay_s = 0.0;
};

/// An image that is to be taken.
struct CameraExposure {
  double start_s = 0.0;  ///< head's clock
  double exposure_s = 0.0;
  double gain_db = 0.0;
  gvsp::PixelFormat format = gvsp::PixelFormat::kRGB8;
  CameraStreamSetup stream;
};

/// The mind of an emulated GigE Vision camera: who controls it, what its registers hold and what it
/// answers. No sockets, no threads; times are on the head's clock.
class CameraDevice {
 public:
  /// What requests have set off.
  struct Commands {
    int triggers = 0;
    bool test_packet = false;
    std::vector<gvcp::PacketResend> resends;
  };

  /// Powered on at `now_s`.
  CameraDevice(int width, int height, const CameraRegisters::Identity& identity, std::uint32_t ip,
               const CameraFaults& faults, double now_s);

  /// The bytes of the answer; empty = none. A request that is repeated, because its answer was
  /// lost, is answered again and not carried out again.
  std::vector<std::uint8_t> Answer(std::span<const std::uint8_t> packet, const UdpPeer& from,
                                   double now_s);
  Commands TakeCommands();
  /// Whoever controls it and is silent for longer than the heartbeat loses it; that ends the
  /// stream.
  void PassTime(double now_s);

  bool acquiring() const { return acquiring_; }
  /// Counts the times that an acquisition began or ended.
  int acquisition() const { return acquisition_; }
  /// Seconds between images when it runs freely.
  std::optional<double> FreeRunPeriod() const;
  /// With the settings in force.
  CameraExposure Expose(double start_s) const;
  std::uint64_t TicksAt(double time_s) const;
  const CameraRegisters& registers() const { return registers_; }

 private:
  struct Outcome {
    gvcp::AckStatus status = gvcp::AckStatus::kSuccess;
    std::vector<std::uint8_t> payload;
  };
  struct Repeatable {
    UdpPeer from;
    std::vector<std::uint8_t> packet;
    std::vector<std::uint8_t> answer;
  };
  class Performer;

  std::vector<std::uint8_t> Perform(const gvcp::Request& request, const UdpPeer& from,
                                    double now_s);
  gvcp::AckStatus WriteRegister(std::uint32_t address, std::uint32_t value, const UdpPeer& from,
                                double now_s);
  gvcp::AckStatus WriteDouble(std::uint32_t address, double value, const UdpPeer& from);
  gvcp::AckStatus WriteControl(std::uint32_t value, const UdpPeer& from, double now_s);
  void Follow(std::uint32_t address, std::uint32_t value, double now_s);
  void RefreshReadings(double now_s);
  void SetAcquiring(bool acquiring);
  void ReleaseControl();
  bool MayWrite(const UdpPeer& from) const { return controller_ && *controller_ == from; }

  CameraFaults faults_;
  double power_on_s_;
  CameraRegisters registers_;
  std::optional<UdpPeer> controller_;
  double last_request_s_ = 0.0;  ///< of the controller
  bool acquiring_ = false;
  int acquisition_ = 0;
  Commands commands_;
  Repeatable last_;
};

}  // namespace foresight
