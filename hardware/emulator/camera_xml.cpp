#include "hardware/emulator/camera_xml.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

#include "hardware/emulator/camera_registers.h"

namespace foresight {
namespace {

namespace at = camera_register;

/// Collects nodes, and remembers what the root category lists.
class Description {
 public:
  void Text(std::string_view name, std::uint32_t address, int length) {
    Feature(name);
    nodes_ += fmt::format(
        "<StringReg Name=\"{}\"><Address>0x{:X}</Address><Length>{}</Length>"
        "<AccessMode>RO</AccessMode><pPort>Device</pPort></StringReg>\n",
        name, address, length);
  }

  void ReadOnly(std::string_view name, std::uint32_t address) {
    Feature(name);
    Register(name, address, "RO");
  }

  void Integer(std::string_view name, std::uint32_t address, std::uint32_t low, std::uint32_t high,
               std::uint32_t step) {
    Feature(name);
    nodes_ += fmt::format(
        "<Integer Name=\"{0}\"><pValue>{0}Reg</pValue><Min>{1}</Min><Max>{2}</Max><Inc>{3}</Inc>"
        "</Integer>\n",
        name, low, high, step);
    Register(fmt::format("{}Reg", name), address, "RW");
  }

  void Command(std::string_view name, std::uint32_t address, std::uint32_t value = 1) {
    Feature(name);
    nodes_ += fmt::format(
        "<Command Name=\"{0}\"><pValue>{0}Reg</pValue><CommandValue>{1}</CommandValue></Command>\n",
        name, value);
    Register(fmt::format("{}Reg", name), address, "WO");
  }

  void Choice(std::string_view name, std::uint32_t address,
              const std::vector<std::pair<std::string_view, std::uint32_t>>& entries) {
    Feature(name);
    nodes_ += fmt::format("<Enumeration Name=\"{}\">", name);
    for (const auto& [entry, value] : entries)
      nodes_ += fmt::format("<EnumEntry Name=\"{}\"><Value>{}</Value></EnumEntry>", entry, value);
    nodes_ += fmt::format("<pValue>{}Reg</pValue></Enumeration>\n", name);
    Register(fmt::format("{}Reg", name), address, "RW");
  }

  void Real(std::string_view name, const FeatureRange& range, std::string_view unit) {
    Feature(name);
    nodes_ += fmt::format(
        "<Float Name=\"{0}\"><pValue>{0}Reg</pValue><Min>{1}</Min><Max>{2}</Max><Unit>{3}</Unit>"
        "</Float>\n",
        name, range.low, range.high, unit);
    RealRegister(fmt::format("{}Reg", name), range.address, "RW");
  }

  void RealReadOnly(std::string_view name, std::uint32_t address) {
    Feature(name);
    RealRegister(name, address, "RO");
  }

  /// Bit 0 is the highest, as GigE Vision counts.
  void Bits(std::string_view name, std::uint32_t address, int low, int high,
            std::string_view mode) {
    nodes_ += fmt::format(
        "<MaskedIntReg Name=\"{}\"><Address>0x{:X}</Address><Length>4</Length>"
        "<AccessMode>{}</AccessMode><pPort>Device</pPort><Cachable>NoCache</Cachable>"
        "<LSB>{}</LSB><MSB>{}</MSB><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>"
        "</MaskedIntReg>\n",
        name, address, mode, low, high);
  }

  void Feature(std::string_view name) { features_ += fmt::format("<pFeature>{}</pFeature>", name); }
  void Node(std::string_view xml) { nodes_ += xml; }

  std::string Finish() const {
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
           "<RegisterDescription ModelName=\"EmulatedCamera\" VendorName=\"Foresight\" "
           "ToolTip=\"A camera that looks into a simulated world\" StandardNameSpace=\"GEV\" "
           "SchemaMajorVersion=\"1\" SchemaMinorVersion=\"1\" SchemaSubMinorVersion=\"0\" "
           "MajorVersion=\"1\" MinorVersion=\"0\" SubMinorVersion=\"0\" "
           "ProductGuid=\"5A6F2C1E-0D0B-4E0A-9E57-7A1C3D5B9F01\" "
           "VersionGuid=\"5A6F2C1E-0D0B-4E0A-9E57-7A1C3D5B9F02\" "
           "xmlns=\"http://www.genicam.org/GenApi/Version_1_1\">\n"
           "<Category Name=\"Root\" NameSpace=\"Standard\">" +
           features_ + "</Category>\n" + nodes_ +
           "<Port Name=\"Device\" NameSpace=\"Standard\"/>\n" + "</RegisterDescription>\n";
  }

 private:
  void Register(std::string_view name, std::uint32_t address, std::string_view mode) {
    nodes_ += fmt::format(
        "<IntReg Name=\"{}\"><Address>0x{:X}</Address><Length>4</Length><AccessMode>{}</AccessMode>"
        "<pPort>Device</pPort><Cachable>NoCache</Cachable><Sign>Unsigned</Sign>"
        "<Endianess>BigEndian</Endianess></IntReg>\n",
        name, address, mode);
  }
  void RealRegister(std::string_view name, std::uint32_t address, std::string_view mode) {
    nodes_ += fmt::format(
        "<FloatReg Name=\"{}\"><Address>0x{:X}</Address><Length>8</Length>"
        "<AccessMode>{}</AccessMode><pPort>Device</pPort><Cachable>NoCache</Cachable>"
        "<Endianess>BigEndian</Endianess></FloatReg>\n",
        name, address, mode);
  }

  std::string features_;
  std::string nodes_;
};

void DescribeTransport(Description& xml) {
  xml.ReadOnly("PayloadSize", at::kPayloadSize);
  xml.Integer("GevHeartbeatTimeout", at::kHeartbeat_ms, 500, 60000, 1);
  xml.Command("GevTimestampControlLatch", at::kTimestampControl, 2);
  xml.Feature("GevSCPSPacketSize");
  xml.Node(
      fmt::format("<Integer Name=\"GevSCPSPacketSize\"><pValue>GevSCPSPacketSizeReg</pValue>"
                  "<Min>{}</Min><Max>{}</Max><Inc>4</Inc></Integer>\n",
                  kSmallestPacket, kLargestPacket));
  xml.Bits("GevSCPSPacketSizeReg", at::kPacketSize, 31, 16, "RW");
  xml.Feature("GevSCPSFireTestPacket");
  xml.Node(
      "<Command Name=\"GevSCPSFireTestPacket\"><pValue>GevSCPSFireTestPacketReg</pValue>"
      "<CommandValue>1</CommandValue></Command>\n");
  xml.Bits("GevSCPSFireTestPacketReg", at::kPacketSize, 0, 0, "RW");
  xml.Integer("GevSCPD", at::kPacketDelay, 0, 1'000'000, 1);
  xml.Node("<Integer Name=\"TLParamsLocked\"><Value>0</Value><Min>0</Min><Max>1</Max></Integer>\n");
}

}  // namespace

std::string CameraXml() {
  using gvsp::PixelFormat;
  Description xml;
  xml.Text("DeviceVendorName", at::kVendor, 32);
  xml.Text("DeviceModelName", at::kModel, 32);
  xml.Text("DeviceVersion", at::kDeviceVersion, 32);
  xml.Text("DeviceSerialNumber", at::kSerial, 16);
  xml.RealReadOnly("DeviceTemperature", at::kTemperature);
  xml.ReadOnly("Width", at::kWidth);
  xml.ReadOnly("Height", at::kHeight);
  xml.ReadOnly("SensorWidth", at::kWidth);
  xml.ReadOnly("SensorHeight", at::kHeight);
  xml.Choice("PixelFormat", at::kPixelFormat,
             {{"Mono8", static_cast<std::uint32_t>(PixelFormat::kMono8)},
              {"BayerRG8", static_cast<std::uint32_t>(PixelFormat::kBayerRG8)},
              {"RGB8", static_cast<std::uint32_t>(PixelFormat::kRGB8)}});
  xml.Choice("AcquisitionMode", at::kAcquisitionMode, {{"Continuous", 0}});
  xml.Command("AcquisitionStart", at::kAcquisitionStart);
  xml.Command("AcquisitionStop", at::kAcquisitionStop);
  xml.Real("AcquisitionFrameRate", kFrameRateRange_hz, "Hz");
  xml.Choice("TriggerSelector", at::kTriggerSelector, {{"FrameStart", 0}});
  xml.Choice("TriggerMode", at::kTriggerMode, {{"Off", 0}, {"On", 1}});
  xml.Choice("TriggerSource", at::kTriggerSource, {{"Software", 0}});
  xml.Command("TriggerSoftware", at::kTriggerSoftware);
  xml.Real("ExposureTime", kExposureRange_us, "us");
  xml.Real("Gain", kGainRange_db, "dB");
  DescribeTransport(xml);
  return xml.Finish();
}

}  // namespace foresight
