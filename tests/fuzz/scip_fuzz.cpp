// Whatever a lidar or a client sends, both ends survive it; what decodes must encode to what
// decodes to the same.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hardware/emulator/scip_device.h"
#include "hardware/scip/scip_codec.h"
#include "hardware/scip/scip_parser.h"
#include "tests/fuzz/require.h"

namespace {

using namespace foresight;

void DecodeReplies(std::string_view bytes, std::size_t split) {
  ScipParser parser;
  parser.Push(bytes.substr(0, split));
  parser.Push(bytes.substr(split));
  while (const auto reply = parser.Take()) {
    static_cast<void>(DecodeScipTime(*reply));
    if (const auto info = DecodeScipInfo(*reply)) static_cast<void>(DecodeScipParameters(*info));
    const auto scan = DecodeScipScan(*reply);
    if (!scan) continue;
    ScipParser again;
    again.Push(EncodeScipScan(*scan));
    const auto copy = again.Take();
    Require(copy && DecodeScipScan(*copy) == *scan, "encoding a scan loses nothing");
  }
}

void AnswerRequests(std::string_view bytes) {
  LidarModel model;
  model.beams = 61;
  ScipDevice device(model, {}, {}, 0.0);
  ScipRequestReader reader;
  reader.Push(bytes);
  double now_s = 0.0;
  while (const auto request = reader.Take()) {
    now_s += 0.1;
    LidarLine line;
    line.time_s = now_s;
    line.range_mm.assign(61, 1000);
    line.intensity.assign(61, 100);
    static_cast<void>(device.Answer(*request, now_s, [&] { return line; }));
    if (device.Streaming()) Require(!device.StreamScan(line).empty(), "a stream has scans");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  DecodeReplies(bytes, data[0] * bytes.size() / 256);
  AnswerRequests(bytes);
  return 0;
}
