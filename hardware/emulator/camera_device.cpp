#include "hardware/emulator/camera_device.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "hardware/emulator/big_endian.h"

namespace foresight {

namespace at = camera_register;
using gvcp::AckStatus;

namespace {

constexpr std::uint32_t kLatch = 2;
constexpr std::size_t kMostRegisters = gvcp::kLargestMemoryAccess / 4;

}  // namespace

/// Carries out a request, whatever its kind.
class CameraDevice::Performer {
 public:
  Performer(CameraDevice& device, const UdpPeer& from, double now_s)
      : device_(device), from_(from), now_s_(now_s) {}

  Outcome operator()(const gvcp::Discovery&) const { return Memory(0, gvcp::kDiscoveryBytes); }

  Outcome operator()(const gvcp::ReadRegisters& read) const {
    if (read.addresses.size() > kMostRegisters) return {AckStatus::kInvalidParameter, {}};
    Outcome all;
    for (const std::uint32_t address : read.addresses) {
      const Outcome one = Memory(address, 4);
      if (one.status != AckStatus::kSuccess) return one;
      all.payload.insert(all.payload.end(), one.payload.begin(), one.payload.end());
    }
    return all;
  }

  /// The answer tells how many were written.
  Outcome operator()(const gvcp::WriteRegisters& write) const {
    Outcome outcome;
    std::uint32_t written = 0;
    for (const auto& [address, value] : write.values) {
      outcome.status = device_.WriteRegister(address, value, from_, now_s_);
      if (outcome.status != AckStatus::kSuccess) break;
      ++written;
    }
    AppendBigEndian(outcome.payload, written, 4);
    return outcome;
  }

  Outcome operator()(const gvcp::ReadMemory& read) const {
    if (read.count == 0 || read.count % 4 != 0 || read.count > gvcp::kLargestMemoryAccess)
      return {AckStatus::kInvalidParameter, {}};
    Outcome data = Memory(read.address, read.count);
    if (data.status != AckStatus::kSuccess) return data;
    Outcome outcome;
    AppendBigEndian(outcome.payload, read.address, 4);
    outcome.payload.insert(outcome.payload.end(), data.payload.begin(), data.payload.end());
    return outcome;
  }

  /// Clients write registers this way too.
  Outcome operator()(const gvcp::WriteMemory& write) const {
    const std::span<const std::uint8_t> bytes = write.bytes;
    Outcome outcome;
    if (CameraRegisters::IsDouble(write.address) && bytes.size() == 8) {
      outcome.status = device_.WriteDouble(write.address,
                                           std::bit_cast<double>(BigEndianAt(bytes, 0, 8)), from_);
    } else {
      for (std::size_t i = 0; i < bytes.size() && outcome.status == AckStatus::kSuccess; i += 4)
        outcome.status = device_.WriteRegister(write.address + static_cast<std::uint32_t>(i),
                                               BigEndian32(bytes, i), from_, now_s_);
    }
    AppendBigEndian(outcome.payload, bytes.size(), 4);
    return outcome;
  }

  Outcome operator()(const gvcp::PacketResend& resend) const {
    if (device_.controller_) device_.commands_.resends.push_back(resend);
    return {};
  }

  Outcome operator()(const gvcp::Refused& refused) const { return {refused.why, {}}; }

 private:
  Outcome Memory(std::uint32_t address, std::size_t count) const {
    if (address % 4 != 0) return {AckStatus::kBadAlignment, {}};
    device_.RefreshReadings(now_s_);
    const auto found = device_.registers_.Read(address, count);
    if (!found) return {AckStatus::kInvalidAddress, {}};
    return {AckStatus::kSuccess, {found->begin(), found->end()}};
  }

  CameraDevice& device_;
  const UdpPeer& from_;
  double now_s_;
};

CameraDevice::CameraDevice(int width, int height, const CameraRegisters::Identity& identity,
                           std::uint32_t ip, const CameraFaults& faults, double now_s)
    : faults_(faults), power_on_s_(now_s), registers_(width, height, identity, ip) {}

std::uint64_t CameraDevice::TicksAt(double time_s) const {
  const double age_s = (time_s - power_on_s_) * (1.0 + 1e-6 * faults_.clock_ppm);
  return static_cast<std::uint64_t>(std::llround(1e9 * (faults_.clock_start_s + age_s)));
}

std::vector<std::uint8_t> CameraDevice::Answer(std::span<const std::uint8_t> packet,
                                               const UdpPeer& from, double now_s) {
  PassTime(now_s);
  const auto request = gvcp::DecodeRequest(packet);
  if (!request) return {};
  if (MayWrite(from)) last_request_s_ = now_s;
  if (last_.from == from &&
      std::equal(packet.begin(), packet.end(), last_.packet.begin(), last_.packet.end()))
    return last_.answer;
  const std::vector<std::uint8_t> answer = Perform(*request, from, now_s);
  // A resend has no answer that could be lost: asked for twice, it is wanted twice.
  if (!std::holds_alternative<gvcp::PacketResend>(request->body))
    last_ = {from, {packet.begin(), packet.end()}, answer};
  return answer;
}

std::vector<std::uint8_t> CameraDevice::Perform(const gvcp::Request& request, const UdpPeer& from,
                                                double now_s) {
  const Outcome outcome = std::visit(Performer(*this, from, now_s), request.body);
  if (!request.wants_ack || std::holds_alternative<gvcp::PacketResend>(request.body)) return {};
  gvcp::Ack ack;
  ack.status = outcome.status;
  ack.command = static_cast<std::uint16_t>(gvcp::CommandOf(request) + 1);
  ack.id = request.id;
  if (ack.status == AckStatus::kSuccess) ack.payload = outcome.payload;
  return gvcp::EncodeAck(ack);
}

CameraDevice::Commands CameraDevice::TakeCommands() {
  return std::exchange(commands_, {});
}

AckStatus CameraDevice::WriteRegister(std::uint32_t address, std::uint32_t value,
                                      const UdpPeer& from, double now_s) {
  if (address == at::kControlPrivilege) return WriteControl(value, from, now_s);
  if (!MayWrite(from)) return AckStatus::kAccessDenied;
  const AckStatus written = registers_.Write(address, value);
  if (written == AckStatus::kSuccess) Follow(address, value, now_s);
  return written;
}

AckStatus CameraDevice::WriteDouble(std::uint32_t address, double value, const UdpPeer& from) {
  return MayWrite(from) ? registers_.WriteDouble(address, value) : AckStatus::kAccessDenied;
}

AckStatus CameraDevice::WriteControl(std::uint32_t value, const UdpPeer& from, double now_s) {
  if (controller_ && *controller_ != from) return AckStatus::kAccessDenied;
  const AckStatus written = registers_.Write(at::kControlPrivilege, value);
  if (written != AckStatus::kSuccess) return written;
  if (value == 0) {
    ReleaseControl();
  } else {
    controller_ = from;
    last_request_s_ = now_s;
  }
  return written;
}

/// What a written value sets off.
void CameraDevice::Follow(std::uint32_t address, std::uint32_t value, double now_s) {
  switch (address) {
    case at::kAcquisitionStart:
      return SetAcquiring(true);
    case at::kAcquisitionStop:
      return SetAcquiring(false);
    case at::kTriggerSoftware:
      if (acquiring_ && registers_.Get(at::kTriggerMode) == 1) ++commands_.triggers;
      return;
    case at::kPacketSize:
      if ((value & at::kFireTestPacket) != 0) commands_.test_packet = true;
      return;
    case at::kTimestampControl:
      if ((value & kLatch) != 0) {
        const std::uint64_t ticks = TicksAt(now_s);
        registers_.Set(at::kTimestampHigh, static_cast<std::uint32_t>(ticks >> 32U));
        registers_.Set(at::kTimestampLow, static_cast<std::uint32_t>(ticks));
      }
      return;
    default:
      return;
  }
}

void CameraDevice::PassTime(double now_s) {
  if (controller_ && now_s - last_request_s_ > 1e-3 * registers_.Get(at::kHeartbeat_ms))
    ReleaseControl();
}

void CameraDevice::ReleaseControl() {
  controller_.reset();
  SetAcquiring(false);
  registers_.Set(at::kControlPrivilege, 0);
  registers_.Set(at::kStreamPort, 0);
}

void CameraDevice::SetAcquiring(bool acquiring) {
  if (acquiring == acquiring_) return;
  acquiring_ = acquiring;
  ++acquisition_;
}

/// It warms up from 22 to 45 deg C, with a time constant of 10 minutes.
void CameraDevice::RefreshReadings(double now_s) {
  registers_.SetDouble(at::kTemperature, 45.0 - 23.0 * std::exp((power_on_s_ - now_s) / 600.0));
}

std::optional<double> CameraDevice::FreeRunPeriod() const {
  if (!acquiring_ || registers_.Get(at::kTriggerMode) == 1) return std::nullopt;
  return 1.0 / registers_.GetDouble(at::kFrameRate);
}

CameraExposure CameraDevice::Expose(double start_s) const {
  CameraExposure exposure;
  exposure.start_s = start_s;
  exposure.exposure_s = 1e-6 * registers_.GetDouble(at::kExposureTime);
  exposure.gain_db = registers_.GetDouble(at::kGain);
  exposure.format = registers_.pixel_format();
  exposure.stream.to = {registers_.Get(at::kStreamIp),
                        static_cast<std::uint16_t>(registers_.Get(at::kStreamPort))};
  exposure.stream.packet_bytes = registers_.Get(at::kPacketSize) & 0xFFFF;
  exposure.stream.packet_delay_s = 1e-9 * registers_.Get(at::kPacketDelay);
  return exposure;
}

}  // namespace foresight
