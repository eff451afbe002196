// Whatever a client sends to a camera, it survives; what decodes must encode to what decodes to the
// same.
#include <cstddef>
#include <cstdint>
#include <span>

#include "hardware/emulator/camera_device.h"
#include "hardware/emulator/gvsp_codec.h"
#include "tests/fuzz/require.h"

namespace {

using namespace foresight;
using Bytes = std::span<const std::uint8_t>;

void DecodeRequests(Bytes packet) {
  const auto request = gvcp::DecodeRequest(packet);
  if (!request) return;
  if (!std::holds_alternative<gvcp::Refused>(request->body))
    Require(gvcp::DecodeRequest(gvcp::EncodeRequest(*request)) == request, "a request is itself");
  static_cast<void>(gvcp::DecodeAck(packet));
}

/// Packets of at most 64 bytes, from the client in control and from another.
void AskDevice(Bytes bytes) {
  CameraDevice device(32, 24, {}, 0x7F000002, {}, 0.0);
  const UdpPeer host{1, 1};
  gvcp::Request control;
  control.id = 1;
  control.body = gvcp::WriteRegisters{{{camera_register::kControlPrivilege, 2}}};
  static_cast<void>(device.Answer(gvcp::EncodeRequest(control), host, 0.0));
  double now_s = 0.0;
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(bytes[0] % 64, bytes.size() - 1);
    const UdpPeer from{1, static_cast<std::uint16_t>(1 + bytes[0] / 128)};
    const auto answer = device.Answer(bytes.subspan(1, size), from, now_s += 0.01);
    Require(answer.empty() || gvcp::DecodeAck(answer).has_value(), "an answer is an acknowledge");
    const CameraExposure exposure = device.Expose(now_s);
    Require(exposure.exposure_s > 0.0 && exposure.stream.packet_bytes > gvsp::kOverheadBytes &&
                gvsp::BytesPerPixel(exposure.format) > 0,
            "settings stay within their limits");
    static_cast<void>(device.TakeCommands());
    bytes = bytes.subspan(1 + size);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes bytes(data, size);
  DecodeRequests(bytes);
  AskDevice(bytes);
  return 0;
}
