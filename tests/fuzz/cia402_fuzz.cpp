// Whatever registers a drive shows, our procedures end, and write within the drive's image.
#include <cstddef>
#include <cstdint>
#include <span>

#include "hardware/motor/drive_procedure.h"
#include "tests/fuzz/require.h"

namespace {

using namespace foresight;
using cia402::RxImage;
using cia402::TxImage;
using cia402::WordOrder;
using Bytes = std::span<const std::uint8_t>;

template <class Image>
typename Image::Registers Registers(Bytes& bytes) {
  typename Image::Registers registers{};
  for (std::uint16_t& value : registers) {
    if (bytes.size() < 2) break;
    value = static_cast<std::uint16_t>(bytes[0] << 8U | bytes[1]);
    bytes = bytes.subspan(2);
  }
  return registers;
}

/// Pads are lost once; what an image holds is not.
template <class Image>
void KeepImage(Bytes bytes, WordOrder order) {
  const Image image = Image::Decode(Registers<Image>(bytes), order);
  Require(Image::Decode(image.Encode(order), order) == image, "an image is itself");
}

void Follow(DriveProcedure procedure, Bytes bytes, WordOrder order) {
  double time_s = 0.0;
  while (!bytes.empty()) {
    time_s += 0.01 * (bytes[0] % 32);
    bytes = bytes.subspan(1);
    const TxImage drive = TxImage::Decode(Registers<TxImage>(bytes), order);
    DriveWrites writes;
    const Result<bool> ended = procedure.Step(time_s, drive, writes);
    for (const DriveWrite& write : writes)
      Require(write.first >= RxImage::kFirst && !write.values.empty() &&
                  write.first + write.values.size() <= RxImage::kFirst + RxImage::kCount,
              "writes stay within the drive's registers");
    Require(ended.has_value() || !ended.error().message.empty(), "an error says what");
    if (!ended || *ended) return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Bytes bytes(data + 1, size - 1);
  const WordOrder order = data[0] % 2 == 0 ? WordOrder::kHighFirst : WordOrder::kLowFirst;
  KeepImage<TxImage>(bytes, order);
  KeepImage<RxImage>(bytes, order);
  HomingProfile homing;
  homing.search_speed = 1000;
  homing.edge_speed = 50;
  homing.acceleration = 20000;
  const MoveProfile move{.target = -1500, .speed = 500, .acceleration = 20000, .window = 2};
  switch (data[0] / 2 % 3) {
    case 0:
      Follow(HomingProcedure(homing, order), bytes, order);
      break;
    case 1:
      Follow(MoveProcedure(move, order), bytes, order);
      break;
    default:
      Follow(StopProcedure(1.0), bytes, order);
  }
  return 0;
}
