#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hardware/emulator/gvcp_codec.h"
#include "hardware/emulator/gvsp_codec.h"

namespace foresight {

/// Where things are in an emulated camera. Below 0xE00: where GigE Vision 1.2 puts them; above:
/// where our XML says.
namespace camera_register {
inline constexpr std::uint32_t kVersion = 0x0000;
inline constexpr std::uint32_t kDeviceMode = 0x0004;
inline constexpr std::uint32_t kMacHigh = 0x0008;
inline constexpr std::uint32_t kMacLow = 0x000C;
inline constexpr std::uint32_t kIpConfigurations = 0x0010;
inline constexpr std::uint32_t kIpConfiguration = 0x0014;
inline constexpr std::uint32_t kIpAddress = 0x0024;
inline constexpr std::uint32_t kSubnetMask = 0x0034;
inline constexpr std::uint32_t kVendor = 0x0048;  ///< 32 characters
inline constexpr std::uint32_t kModel = 0x0068;
inline constexpr std::uint32_t kDeviceVersion = 0x0088;
inline constexpr std::uint32_t kSerial = 0x00D8;  ///< 16 characters
inline constexpr std::uint32_t kXmlUrl = 0x0200;
inline constexpr std::uint32_t kInterfaces = 0x0600;
inline constexpr std::uint32_t kStreamChannels = 0x0904;
inline constexpr std::uint32_t kCapability = 0x0934;
inline constexpr std::uint32_t kHeartbeat_ms = 0x0938;
inline constexpr std::uint32_t kTickFrequencyHigh = 0x093C;
inline constexpr std::uint32_t kTickFrequencyLow = 0x0940;
inline constexpr std::uint32_t kTimestampControl = 0x0944;
inline constexpr std::uint32_t kTimestampHigh = 0x0948;
inline constexpr std::uint32_t kTimestampLow = 0x094C;
inline constexpr std::uint32_t kControlPrivilege = 0x0A00;
inline constexpr std::uint32_t kStreamPort = 0x0D00;
inline constexpr std::uint32_t kPacketSize = 0x0D04;
inline constexpr std::uint32_t kFireTestPacket = 0x80000000;  ///< bit of kPacketSize
inline constexpr std::uint32_t kPacketDelay = 0x0D08;         ///< ticks
inline constexpr std::uint32_t kStreamIp = 0x0D18;

inline constexpr std::uint32_t kWidth = 0x10000;
inline constexpr std::uint32_t kHeight = 0x10004;
inline constexpr std::uint32_t kPixelFormat = 0x10008;
inline constexpr std::uint32_t kPayloadSize = 0x1000C;
inline constexpr std::uint32_t kAcquisitionMode = 0x10010;  ///< 0 = continuous, the only one
inline constexpr std::uint32_t kAcquisitionStart = 0x10014;
inline constexpr std::uint32_t kAcquisitionStop = 0x10018;
inline constexpr std::uint32_t kTriggerMode = 0x1001C;    ///< 0 = off: free-running, 1 = on
inline constexpr std::uint32_t kTriggerSource = 0x10020;  ///< 0 = software, the only one
inline constexpr std::uint32_t kTriggerSoftware = 0x10024;
inline constexpr std::uint32_t kTriggerSelector = 0x10028;  ///< 0 = frame start, the only one
inline constexpr std::uint32_t kExposureTime = 0x10030;     ///< double, microseconds
inline constexpr std::uint32_t kGain = 0x10038;             ///< double, dB
inline constexpr std::uint32_t kFrameRate = 0x10040;        ///< double, Hz; free-running only
inline constexpr std::uint32_t kTemperature = 0x10048;      ///< double, deg C
inline constexpr std::uint32_t kXml = 0x20000;
}  // namespace camera_register

/// What a feature that is a double may be.
struct FeatureRange {
  std::uint32_t address;
  double low;
  double high;
};
inline constexpr FeatureRange kExposureRange_us{camera_register::kExposureTime, 10.0, 1e6};
inline constexpr FeatureRange kGainRange_db{camera_register::kGain, 0.0, 24.0};
inline constexpr FeatureRange kFrameRateRange_hz{camera_register::kFrameRate, 0.1, 30.0};
inline constexpr std::uint32_t kSmallestPacket = 576;
inline constexpr std::uint32_t kLargestPacket = 9000;

/// The registers of an emulated camera: what can be read, what can be written and which values are
/// taken. What a written value sets off is the device's affair.
class CameraRegisters {
 public:
  struct Identity {
    std::string vendor = "Foresight";
    std::string model = "Emulated camera";
    std::string serial = "C0000001";
  };

  CameraRegisters(int width, int height, const Identity& identity, std::uint32_t ip);

  std::uint32_t Get(std::uint32_t address) const;
  double GetDouble(std::uint32_t address) const;
  void Set(std::uint32_t address, std::uint32_t value);
  void SetDouble(std::uint32_t address, double value);
  gvsp::PixelFormat pixel_format() const;

  /// As clients see them; nullopt where there is nothing.
  std::optional<std::span<const std::uint8_t>> Read(std::uint32_t address, std::size_t count) const;
  /// One register of 32 bits.
  gvcp::AckStatus Write(std::uint32_t address, std::uint32_t value);
  /// A double of the XML, whole.
  gvcp::AckStatus WriteDouble(std::uint32_t address, double value);
  static bool IsDouble(std::uint32_t address);

 private:
  std::span<std::uint8_t> Find(std::uint32_t address, std::size_t count);
  void SetText(std::uint32_t address, const std::string& text, std::size_t room);
  void UpdatePayloadSize();

  std::vector<std::uint8_t> bootstrap_;
  std::vector<std::uint8_t> features_;
  std::vector<std::uint8_t> xml_;
};

}  // namespace foresight
