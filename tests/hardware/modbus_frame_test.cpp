// The emulator's Modbus TCP against bytes written out from the specification.
#include "hardware/emulator/modbus_frame.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.h"

namespace foresight::modbus {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Registers 5000 to 5009 and 6000 to 6019.
class TwoBlocks final : public RegisterBank {
 public:
  TwoBlocks() {
    for (std::uint16_t at = 5000; at < 5010; ++at) values[at] = 0;
    for (std::uint16_t at = 6000; at < 6020; ++at) values[at] = 0;
  }
  std::optional<std::vector<std::uint16_t>> Read(std::uint16_t first,
                                                 std::uint16_t count) override {
    std::vector<std::uint16_t> read;
    for (int at = first; at < first + count; ++at) {
      if (!values.count(at)) return std::nullopt;
      read.push_back(values[at]);
    }
    return read;
  }
  bool Write(std::uint16_t first, std::span<const std::uint16_t> written) override {
    for (std::size_t i = 0; i < written.size(); ++i)
      if (first < 6000 || !values.count(first + static_cast<int>(i))) return false;
    for (std::size_t i = 0; i < written.size(); ++i)
      values[first + static_cast<int>(i)] = written[i];
    return true;
  }
  std::map<int, std::uint16_t> values;
};

TEST(ModbusFrame, AnswersAReadOfTenRegisters) {
  TwoBlocks bank;
  bank.values[5000] = 0x0637;
  bank.values[5009] = 0x0004;
  const Bytes request = {0x00, 0x01, 0x00, 0x00, 0x00, 0x06, 0x01, 0x03, 0x13, 0x88, 0x00, 0x0A};
  const Bytes expected = {0x00, 0x01, 0x00, 0x00, 0x00, 0x17, 0x01, 0x03, 0x14, 0x06,
                          0x37, 0,    0,    0,    0,    0,    0,    0,    0,    0,
                          0,    0,    0,    0,    0,    0,    0,    0x00, 0x04};
  EXPECT_EQ(Answer(request, bank), expected);
}

TEST(ModbusFrame, EchoesAControlwordThatItWrote) {
  TwoBlocks bank;
  const Bytes request = {0x00, 0x02, 0x00, 0x00, 0x00, 0x06, 0x01, 0x06, 0x17, 0x70, 0x00, 0x06};
  EXPECT_EQ(Answer(request, bank), request);
  EXPECT_EQ(bank.values[6000], 0x0006);
}

TEST(ModbusFrame, WritesTheTargetOf1500CountsDown) {
  TwoBlocks bank;
  const Bytes request = {0x00, 0x03, 0x00, 0x00, 0x00, 0x0B, 0x01, 0x10, 0x17,
                         0x72, 0x00, 0x02, 0x04, 0xFF, 0xFF, 0xFA, 0x24};
  const Bytes expected = {0x00, 0x03, 0x00, 0x00, 0x00, 0x06, 0x01, 0x10, 0x17, 0x72, 0x00, 0x02};
  EXPECT_EQ(Answer(request, bank), expected);
  EXPECT_EQ(bank.values[6002], 0xFFFF);
  EXPECT_EQ(bank.values[6003], 0xFA24);
}

TEST(ModbusFrame, WritesBeforeItReadsInOneRequest) {
  TwoBlocks bank;
  const Bytes request = {0x00, 0x04, 0x00, 0x00, 0x00, 0x0D, 0x01, 0x17, 0x17, 0x70,
                         0x00, 0x01, 0x17, 0x70, 0x00, 0x01, 0x02, 0x00, 0x0F};
  const Bytes expected = {0x00, 0x04, 0x00, 0x00, 0x00, 0x05, 0x01, 0x17, 0x02, 0x00, 0x0F};
  EXPECT_EQ(Answer(request, bank), expected);
}

struct Refused {
  const char* what;
  Bytes pdu;
  std::uint8_t exception;
};

class ModbusException : public testing::TestWithParam<Refused> {};

TEST_P(ModbusException, NamesTheReason) {
  TwoBlocks bank;
  Bytes request = {0x12, 0x34, 0x00, 0x00, 0x00, 0, 0x01};
  request[5] = static_cast<std::uint8_t>(GetParam().pdu.size() + 1);
  request.insert(request.end(), GetParam().pdu.begin(), GetParam().pdu.end());
  const Bytes expected = {0x12,
                          0x34,
                          0x00,
                          0x00,
                          0x00,
                          0x03,
                          0x01,
                          static_cast<std::uint8_t>(GetParam().pdu[0] | 0x80),
                          GetParam().exception};
  EXPECT_EQ(Answer(request, bank), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Requests, ModbusException,
    testing::Values(Refused{"ReadCoils", {0x01, 0x13, 0x88, 0x00, 0x01}, 1},
                    Refused{"ObjectAccess", {0x2B, 0x0D, 0x00}, 1},
                    Refused{"BeyondTheLast", {0x03, 0x13, 0x88, 0x00, 0x0B}, 2},
                    Refused{"WriteOfAStatus", {0x06, 0x13, 0x88, 0x00, 0x00}, 2},
                    Refused{"NoRegisters", {0x03, 0x13, 0x88, 0x00, 0x00}, 3},
                    Refused{"TooManyRegisters", {0x03, 0x13, 0x88, 0x00, 0x7E}, 3},
                    Refused{"ByteCountThatDoesNotFit", {0x10, 0x17, 0x72, 0, 2, 3, 0, 0, 0}, 3},
                    Refused{"CutShort", {0x03, 0x13}, 3}),
    [](const auto& request) { return std::string(request.param.what); });

TEST(ModbusFrame, WritesNothingWhenOneRegisterIsNotThere) {
  TwoBlocks bank;
  const Bytes request = {0, 1, 0, 0, 0, 0x0B, 1, 0x10, 0x17, 0x83, 0, 2, 4, 0, 7, 0, 7};
  EXPECT_EQ(Answer(request, bank)[7], 0x90);
  EXPECT_EQ(bank.values[6019], 0);
}

TEST(ModbusFrame, AnswersAnyDamagedRequestWithAFrameOfItsOwn) {
  TwoBlocks bank;
  Random random(11);
  const Bytes functions = {0x03, 0x04, 0x06, 0x10, 0x17, 0x2B, 0x00, 0xFF};
  for (int i = 0; i < 20000; ++i) {
    Bytes request(static_cast<std::size_t>(8 + random.Index(250)));
    for (std::uint8_t& byte : request) byte = static_cast<std::uint8_t>(random.Index(256));
    request[2] = request[3] = request[4] = 0;
    request[5] = static_cast<std::uint8_t>(request.size() - 6);
    request[7] = functions[static_cast<std::size_t>(random.Index(8))];
    // Half of them reach registers that are there.
    if (request.size() > 9 && random.Index(2) == 0) {
      request[8] = 0x17;
      request[9] = 0x70;
    }
    const Bytes answer = Answer(request, bank);
    ASSERT_EQ(FrameLength(answer), answer.size()) << "request " << i;
    ASSERT_EQ(answer[7] & 0x7F, request[7] & 0x7F) << "request " << i;
  }
}

TEST(ModbusFrame, TellsTheLengthOnceTheHeaderIsThere) {
  const Bytes start = {0x00, 0x01, 0x00, 0x00, 0x00, 0x06};
  EXPECT_EQ(FrameLength(std::span(start).first(5)), 0U);
  EXPECT_EQ(FrameLength(start), 12U);
}

TEST(ModbusFrame, TakesNothingElseForModbus) {
  EXPECT_EQ(FrameLength(Bytes{'G', 'E', 'T', ' ', '/', ' '}), std::nullopt);
  EXPECT_EQ(FrameLength(Bytes{0, 1, 0, 0, 0xFF, 0xFF}), std::nullopt);
}

}  // namespace
}  // namespace foresight::modbus
