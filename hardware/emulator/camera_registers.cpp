#include "hardware/emulator/camera_registers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "core/base/contract.h"
#include "hardware/emulator/big_endian.h"
#include "hardware/emulator/camera_xml.h"

namespace foresight {
namespace {

using gvcp::AckStatus;
using gvsp::PixelFormat;
namespace at = camera_register;

constexpr std::size_t kBootstrapBytes = 0xE00;
constexpr std::uint32_t kFirstFeature = 0x10000;
constexpr std::size_t kFeatureBytes = 0x50;

constexpr std::array kDoubles = {kExposureRange_us, kGainRange_db, kFrameRateRange_hz};

/// What a register of 32 bits takes.
AckStatus Judge(std::uint32_t address, std::uint32_t value) {
  const auto demand = [](bool fine) {
    return fine ? AckStatus::kSuccess : AckStatus::kInvalidParameter;
  };
  switch (address) {
    case at::kHeartbeat_ms:
      return demand(value >= 500);
    case at::kTimestampControl:
      return demand(value <= 3);
    case at::kControlPrivilege:
      return demand(value <= 3);
    case at::kStreamPort:
      return demand(value <= 0xFFFF);
    case at::kPacketSize: {
      const std::uint32_t size = value & 0xFFFF;
      return demand(size >= kSmallestPacket && size <= kLargestPacket);
    }
    case at::kPixelFormat:
      return demand(gvsp::BytesPerPixel(static_cast<PixelFormat>(value)) > 0);
    case at::kTriggerMode:
      return demand(value <= 1);
    case at::kAcquisitionMode:
    case at::kTriggerSource:
    case at::kTriggerSelector:
      return demand(value == 0);
    case at::kPacketDelay:
    case at::kStreamIp:
    case at::kAcquisitionStart:
    case at::kAcquisitionStop:
    case at::kTriggerSoftware:
      return AckStatus::kSuccess;
    default:
      return AckStatus::kWriteProtect;
  }
}

const FeatureRange* FindDouble(std::uint32_t address) {
  const auto found = std::find_if(kDoubles.begin(), kDoubles.end(),
                                  [&](const auto& range) { return range.address == address; });
  return found == kDoubles.end() ? nullptr : &*found;
}

}  // namespace

CameraRegisters::CameraRegisters(int width, int height, const Identity& identity, std::uint32_t ip)
    : bootstrap_(kBootstrapBytes), features_(kFeatureBytes) {
  const std::string xml = CameraXml();
  xml_.assign(xml.begin(), xml.end());
  xml_.resize((xml_.size() + 3) / 4 * 4, '\n');  // memory is read in words

  Set(at::kVersion, 0x00010002);
  Set(at::kDeviceMode, 0x80000001);  // big endian, UTF-8
  Set(at::kMacHigh, 0x0200);         // a locally administered address
  Set(at::kMacLow, ip);
  Set(at::kIpConfigurations, 0x5);  // persistent and link-local
  Set(at::kIpConfiguration, 0x5);
  Set(at::kIpAddress, ip);
  Set(at::kSubnetMask, 0xFF000000);
  SetText(at::kVendor, identity.vendor, 32);
  SetText(at::kModel, identity.model, 32);
  SetText(at::kDeviceVersion, "1.0", 32);
  SetText(at::kSerial, identity.serial, 16);
  SetText(at::kXmlUrl,
          fmt::format("Local:///foresight_camera.xml;{:X};{:X}", at::kXml, xml_.size()), 512);
  Set(at::kInterfaces, 1);
  Set(at::kStreamChannels, 1);
  Set(at::kCapability, 0x40000007);  // serial number, PACKETRESEND, WRITEMEM, concatenation
  Set(at::kHeartbeat_ms, 3000);
  Set(at::kTickFrequencyLow, 1'000'000'000);
  Set(at::kPacketSize, 1400);

  Set(at::kWidth, static_cast<std::uint32_t>(width));
  Set(at::kHeight, static_cast<std::uint32_t>(height));
  Set(at::kPixelFormat, static_cast<std::uint32_t>(PixelFormat::kRGB8));
  SetDouble(at::kExposureTime, 4000.0);
  SetDouble(at::kFrameRate, 5.0);
  UpdatePayloadSize();
}

std::span<std::uint8_t> CameraRegisters::Find(std::uint32_t address, std::size_t count) {
  const auto within = [&](std::vector<std::uint8_t>& region, std::uint32_t first) {
    return address >= first && address - first + count <= region.size()
               ? std::span(region).subspan(address - first, count)
               : std::span<std::uint8_t>();
  };
  if (address < kFirstFeature) return within(bootstrap_, 0);
  return address < at::kXml ? within(features_, kFirstFeature) : within(xml_, at::kXml);
}

std::optional<std::span<const std::uint8_t>> CameraRegisters::Read(std::uint32_t address,
                                                                   std::size_t count) const {
  const auto found = const_cast<CameraRegisters*>(this)->Find(address, count);
  if (found.empty()) return std::nullopt;
  return found;
}

std::uint32_t CameraRegisters::Get(std::uint32_t address) const {
  const auto bytes = Read(address, 4);
  FORESIGHT_EXPECTS(bytes, "a register of ours exists");
  return BigEndian32(*bytes, 0);
}

double CameraRegisters::GetDouble(std::uint32_t address) const {
  const auto bytes = Read(address, 8);
  FORESIGHT_EXPECTS(bytes, "a register of ours exists");
  return std::bit_cast<double>(BigEndianAt(*bytes, 0, 8));
}

void CameraRegisters::Set(std::uint32_t address, std::uint32_t value) {
  std::vector<std::uint8_t> bytes;
  AppendBigEndian(bytes, value, 4);
  std::copy(bytes.begin(), bytes.end(), Find(address, 4).begin());
}

void CameraRegisters::SetDouble(std::uint32_t address, double value) {
  std::vector<std::uint8_t> bytes;
  AppendBigEndian(bytes, std::bit_cast<std::uint64_t>(value), 8);
  std::copy(bytes.begin(), bytes.end(), Find(address, 8).begin());
}

void CameraRegisters::SetText(std::uint32_t address, const std::string& text, std::size_t room) {
  // The last byte stays zero: clients take it for a C string.
  const std::size_t length = std::min(text.size(), room - 1);
  std::copy_n(text.begin(), length, Find(address, room).begin());
}

PixelFormat CameraRegisters::pixel_format() const {
  return static_cast<PixelFormat>(Get(at::kPixelFormat));
}

void CameraRegisters::UpdatePayloadSize() {
  const auto bytes = static_cast<std::uint32_t>(gvsp::BytesPerPixel(pixel_format()));
  Set(at::kPayloadSize, Get(at::kWidth) * Get(at::kHeight) * bytes);
}

AckStatus CameraRegisters::Write(std::uint32_t address, std::uint32_t value) {
  if (address % 4 != 0) return AckStatus::kBadAlignment;
  if (!Read(address, 4)) return AckStatus::kInvalidAddress;
  if (const AckStatus judged = Judge(address, value); judged != AckStatus::kSuccess) return judged;
  if (address == at::kPacketSize) value &= ~at::kFireTestPacket;
  Set(address, value);
  if (address == at::kPixelFormat) UpdatePayloadSize();
  return AckStatus::kSuccess;
}

bool CameraRegisters::IsDouble(std::uint32_t address) {
  return FindDouble(address) != nullptr;
}

AckStatus CameraRegisters::WriteDouble(std::uint32_t address, double value) {
  const FeatureRange* range = FindDouble(address);
  if (!range) return AckStatus::kInvalidAddress;
  if (!(value >= range->low && value <= range->high)) return AckStatus::kInvalidParameter;
  SetDouble(address, value);
  return AckStatus::kSuccess;
}

}  // namespace foresight
