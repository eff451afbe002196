#include "hardware/emulator/modbus_frame.h"

#include "core/base/contract.h"

namespace foresight::modbus {
namespace {

constexpr std::size_t kHeader = 7;  ///< transaction, protocol, length, unit
constexpr std::size_t kLargestLength = 254;
constexpr std::uint16_t kMostRead = 125;
constexpr std::uint16_t kMostWritten = 123;
constexpr std::uint16_t kMostWrittenWhileReading = 121;

enum Function : std::uint8_t {
  kReadHolding = 0x03,
  kReadInput = 0x04,
  kWriteOne = 0x06,
  kWriteMany = 0x10,
  kReadWrite = 0x17,
};
enum Exception : std::uint8_t { kIllegalFunction = 1, kIllegalAddress = 2, kIllegalValue = 3 };

using Pdu = std::vector<std::uint8_t>;

std::uint16_t Word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8U | bytes[at + 1]);
}

void Append(Pdu& pdu, std::uint16_t word) {
  pdu.push_back(static_cast<std::uint8_t>(word >> 8U));
  pdu.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}

Pdu Refuse(std::uint8_t function, Exception why) {
  return {static_cast<std::uint8_t>(function | 0x80U), why};
}

std::vector<std::uint16_t> Words(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint16_t> words(bytes.size() / 2);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = Word(bytes, 2 * i);
  return words;
}

Pdu AnswerRead(std::uint8_t function, std::uint16_t first, std::uint16_t count,
               RegisterBank& bank) {
  const auto values = bank.Read(first, count);
  if (!values) return Refuse(function, kIllegalAddress);
  Pdu answer = {function, static_cast<std::uint8_t>(2 * count)};
  for (const std::uint16_t value : *values) Append(answer, value);
  return answer;
}

Pdu Read(std::span<const std::uint8_t> pdu, RegisterBank& bank) {
  if (pdu.size() != 5) return Refuse(pdu[0], kIllegalValue);
  const std::uint16_t count = Word(pdu, 3);
  if (count < 1 || count > kMostRead) return Refuse(pdu[0], kIllegalValue);
  return AnswerRead(pdu[0], Word(pdu, 1), count, bank);
}

Pdu WriteOne(std::span<const std::uint8_t> pdu, RegisterBank& bank) {
  if (pdu.size() != 5) return Refuse(pdu[0], kIllegalValue);
  const std::uint16_t value = Word(pdu, 3);
  if (!bank.Write(Word(pdu, 1), {&value, 1})) return Refuse(pdu[0], kIllegalAddress);
  return {pdu.begin(), pdu.end()};
}

Pdu WriteMany(std::span<const std::uint8_t> pdu, RegisterBank& bank) {
  if (pdu.size() < 6) return Refuse(pdu[0], kIllegalValue);
  const std::uint16_t count = Word(pdu, 3);
  if (count < 1 || count > kMostWritten || pdu[5] != 2 * count || pdu.size() != 6U + 2U * count)
    return Refuse(pdu[0], kIllegalValue);
  if (!bank.Write(Word(pdu, 1), Words(pdu.subspan(6)))) return Refuse(pdu[0], kIllegalAddress);
  return {pdu.begin(), pdu.begin() + 5};
}

/// Writes first, then reads, as the specification says.
Pdu ReadWrite(std::span<const std::uint8_t> pdu, RegisterBank& bank) {
  if (pdu.size() < 10) return Refuse(pdu[0], kIllegalValue);
  const std::uint16_t read_count = Word(pdu, 3);
  const std::uint16_t write_count = Word(pdu, 7);
  if (read_count < 1 || read_count > kMostRead || write_count < 1 ||
      write_count > kMostWrittenWhileReading || pdu[9] != 2 * write_count ||
      pdu.size() != 10U + 2U * write_count)
    return Refuse(pdu[0], kIllegalValue);
  if (!bank.Read(Word(pdu, 1), read_count) || !bank.Write(Word(pdu, 5), Words(pdu.subspan(10))))
    return Refuse(pdu[0], kIllegalAddress);
  return AnswerRead(pdu[0], Word(pdu, 1), read_count, bank);
}

Pdu AnswerPdu(std::span<const std::uint8_t> pdu, RegisterBank& bank) {
  switch (pdu[0]) {
    case kReadHolding:
    case kReadInput:
      return Read(pdu, bank);
    case kWriteOne:
      return WriteOne(pdu, bank);
    case kWriteMany:
      return WriteMany(pdu, bank);
    case kReadWrite:
      return ReadWrite(pdu, bank);
    default:
      return Refuse(pdu[0], kIllegalFunction);
  }
}

}  // namespace

std::optional<std::size_t> FrameLength(std::span<const std::uint8_t> stream) {
  if (stream.size() < 6) return 0;
  const std::uint16_t protocol = Word(stream, 2);
  const std::uint16_t length = Word(stream, 4);  // unit and PDU
  if (protocol != 0 || length < 2 || length > kLargestLength) return std::nullopt;
  return 6U + length;
}

std::vector<std::uint8_t> Answer(std::span<const std::uint8_t> request, RegisterBank& bank) {
  FORESIGHT_EXPECTS(request.size() > kHeader && FrameLength(request) == request.size(),
                    "a request is answered when all of it is there");
  const Pdu pdu = AnswerPdu(request.subspan(kHeader), bank);
  std::vector<std::uint8_t> answer(request.begin(), request.begin() + 4);
  Append(answer, static_cast<std::uint16_t>(pdu.size() + 1));
  answer.push_back(request[6]);
  answer.insert(answer.end(), pdu.begin(), pdu.end());
  return answer;
}

}  // namespace foresight::modbus
