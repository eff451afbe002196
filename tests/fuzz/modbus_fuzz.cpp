// Whatever a host sends to the emulated drive, the drive survives it and answers in whole frames.
// And whatever a drive answers, our host reads what it asked for or reports an error.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hardware/emulator/emulated_drive.h"
#include "hardware/emulator/modbus_frame.h"
#include "hardware/motor/modbus_link.h"
#include "hardware/net/tcp_listener.h"
#include "tests/fuzz/require.h"
#include "tests/hardware/tiny_head.h"

namespace {

using namespace foresight;
using cia402::RxImage;
using cia402::TxImage;
using Bytes = std::span<const std::uint8_t>;

/// A drive's two register images, 50 ms after the request before.
class DriveBank final : public RegisterBank {
 public:
  std::optional<std::vector<std::uint16_t>> Read(std::uint16_t first,
                                                 std::uint16_t count) override {
    if (first >= TxImage::kFirst && first + count <= TxImage::kFirst + TxImage::kCount) {
      const auto image = drive_.Read(Now()).Encode(kOrder);
      return std::vector(image.begin() + (first - TxImage::kFirst),
                         image.begin() + (first - TxImage::kFirst + count));
    }
    return std::nullopt;
  }
  bool Write(std::uint16_t first, std::span<const std::uint16_t> values) override {
    if (first < RxImage::kFirst || first + values.size() > RxImage::kFirst + RxImage::kCount)
      return false;
    RxImage::Registers image = drive_.written().Encode(kOrder);
    std::copy(values.begin(), values.end(), image.begin() + (first - RxImage::kFirst));
    drive_.Write(Now(), RxImage::Decode(image, kOrder));
    return true;
  }

 private:
  static constexpr auto kOrder = cia402::WordOrder::kHighFirst;

  double Now() {
    time_s_ += 0.05;
    drive_.Run(time_s_);
    return time_s_;
  }
  static const std::shared_ptr<const World>& WorldOfAll() {
    static const auto kWorld = TinyWorld();
    return kWorld;
  }

  double time_s_ = 0.0;
  EmulatedDrive drive_{WorldOfAll(), std::make_shared<SimulatedShaft>(0.05), {}, 0.0};
};

void AnswerRequests(Bytes stream) {
  DriveBank bank;
  for (;;) {
    const auto length = modbus::FrameLength(stream);
    if (!length || *length == 0 || stream.size() < *length || *length < 8) return;
    const auto answer = modbus::Answer(stream.first(*length), bank);
    Require(modbus::FrameLength(answer) == answer.size(), "an answer is one whole frame");
    Require(std::equal(answer.begin(), answer.begin() + 4, stream.begin()) &&
                (answer[7] & 0x7F) == (stream[7] & 0x7F),
            "an answer belongs to its request");
    stream = stream.subspan(*length);
  }
}

/// The drive says `answer` and goes.
void ReadAnswer(Bytes answer, std::size_t count) {
  static TcpListener listener = TcpListener::Listen({"127.0.0.1", 0}).value();
  ModbusLink link("127.0.0.1", listener.address().port, std::chrono::milliseconds(20));
  if (!link.Connect()) return;
  auto drive = listener.Accept(std::chrono::seconds(1));
  if (!drive || !*drive) return;
  static_cast<void>((*drive)->Send(std::as_bytes(answer), std::chrono::seconds(1)));
  (*drive)->Close();
  constexpr std::uint16_t kUntouched = 0xA5C3;
  std::vector<std::uint16_t> registers(count + 300, kUntouched);
  const Status read = link.Read(TxImage::kFirst, std::span(registers).first(count));
  Require(std::all_of(registers.begin() + static_cast<std::ptrdiff_t>(count), registers.end(),
                      [](std::uint16_t value) { return value == kUntouched; }),
          "an answer fills what was asked for and nothing else");
  Require(!read || answer.size() >= 9 + 2 * count, "what was read was sent");
}

/// The same behind a header that is right.
void ReadFramedAnswer(Bytes pdu, std::size_t count) {
  const std::size_t length = std::min<std::size_t>(pdu.size(), 253) + 1;
  std::vector<std::uint8_t> answer = {0, 1, 0, 0, 0, static_cast<std::uint8_t>(length), 1};
  answer.insert(answer.end(), pdu.begin(), pdu.begin() + static_cast<std::ptrdiff_t>(length - 1));
  ReadAnswer(answer, count);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const Bytes rest(data + 2, size - 2);
  const std::size_t count = 1 + data[1] % 12;
  switch (data[0] % 4) {
    case 0:
      ReadAnswer(rest, count);
      break;
    case 1:
      ReadFramedAnswer(rest, count);
      break;
    default:
      AnswerRequests(rest);
  }
  return 0;
}
