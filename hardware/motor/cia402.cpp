#include "hardware/motor/cia402.h"

namespace foresight::cia402 {
namespace {

/// Two registers of an image, by their offset in it.
template <std::size_t kOffset, class Registers>
auto Pair(Registers& registers) {
  return std::span(registers).template subspan<kOffset, 2>();
}

/// An 8-bit object shares its register with a pad in the high byte.
std::uint16_t PutByte(std::int8_t value) {
  return static_cast<std::uint8_t>(value);
}
std::int8_t GetByte(std::uint16_t word) {
  return static_cast<std::int8_t>(word & 0xFFU);
}

}  // namespace

DriveState StateOf(std::uint16_t status) {
  switch (status & 0x4FU) {
    case 0x00:
      return DriveState::kNotReady;
    case 0x40:
      return DriveState::kSwitchOnDisabled;
    case 0x0F:
      return DriveState::kFaultReaction;
    case 0x08:
      return DriveState::kFault;
    default:
      break;
  }
  switch (status & 0x6FU) {
    case 0x21:
      return DriveState::kReadyToSwitchOn;
    case 0x23:
      return DriveState::kSwitchedOn;
    case 0x27:
      return DriveState::kOperationEnabled;
    case 0x07:
      return DriveState::kQuickStopActive;
    default:
      return DriveState::kUnknown;
  }
}

const char* ToString(DriveState state) {
  switch (state) {
    case DriveState::kNotReady:
      return "not ready";
    case DriveState::kSwitchOnDisabled:
      return "switch-on disabled";
    case DriveState::kReadyToSwitchOn:
      return "ready to switch on";
    case DriveState::kSwitchedOn:
      return "switched on";
    case DriveState::kOperationEnabled:
      return "operation enabled";
    case DriveState::kQuickStopActive:
      return "quick stop active";
    case DriveState::kFaultReaction:
      return "fault reaction active";
    case DriveState::kFault:
      return "fault";
    case DriveState::kUnknown:
      break;
  }
  return "unknown state";
}

std::uint16_t TowardsOperation(DriveState state) {
  switch (state) {
    case DriveState::kSwitchOnDisabled:
      return control::kShutdown;
    case DriveState::kReadyToSwitchOn:
      return control::kSwitchOn;
    case DriveState::kSwitchedOn:
    case DriveState::kQuickStopActive:  // keeps its torque on the way, which 00h would not
    case DriveState::kOperationEnabled:
      return control::kEnableOperation;
    default:
      return control::kDisableVoltage;
  }
}

const char* ErrorText(std::uint16_t code) {
  switch (code) {
    case 0x2310:
      return "over-current";
    case 0x3110:
      return "supply voltage too high";
    case 0x3120:
      return "supply voltage too low";
    case 0x4310:
      return "drive too hot";
    case 0x7305:
      return "encoder error";
    case 0x8130:
      return "drive lost its host";
    case kFollowingError:
      return "following error";
    case 0x8612:
      return "limit exceeded";
    default:
      return "drive error";
  }
}

void PutLong(std::span<std::uint16_t, 2> registers, std::int32_t value, WordOrder order) {
  const auto bits = static_cast<std::uint32_t>(value);
  const auto high = static_cast<std::uint16_t>(bits >> 16U);
  const auto low = static_cast<std::uint16_t>(bits & 0xFFFFU);
  const bool high_first = order == WordOrder::kHighFirst;
  registers[0] = high_first ? high : low;
  registers[1] = high_first ? low : high;
}

std::int32_t GetLong(std::span<const std::uint16_t, 2> registers, WordOrder order) {
  const bool high_first = order == WordOrder::kHighFirst;
  const std::uint32_t high = registers[high_first ? 0 : 1];
  const std::uint32_t low = registers[high_first ? 1 : 0];
  return static_cast<std::int32_t>(high << 16U | low);
}

TxImage::Registers TxImage::Encode(WordOrder order) const {
  Registers r{};
  r[0] = status;
  r[1] = PutByte(static_cast<std::int8_t>(mode));
  PutLong(Pair<2>(r), position, order);
  PutLong(Pair<4>(r), velocity, order);
  r[6] = error_code;
  PutLong(Pair<8>(r), static_cast<std::int32_t>(inputs), order);
  return r;
}

TxImage TxImage::Decode(const Registers& r, WordOrder order) {
  TxImage image;
  image.status = r[0];
  image.mode = static_cast<Mode>(GetByte(r[1]));
  image.position = GetLong(Pair<2>(r), order);
  image.velocity = GetLong(Pair<4>(r), order);
  image.error_code = r[6];
  image.inputs = static_cast<std::uint32_t>(GetLong(Pair<8>(r), order));
  return image;
}

RxImage::Registers RxImage::Encode(WordOrder order) const {
  Registers r{};
  r[0] = control;
  r[1] = PutByte(static_cast<std::int8_t>(mode));
  PutLong(Pair<2>(r), target, order);
  PutLong(Pair<4>(r), speed, order);
  PutLong(Pair<6>(r), acceleration, order);
  PutLong(Pair<8>(r), deceleration, order);
  PutLong(Pair<10>(r), home_offset, order);
  r[12] = PutByte(homing_method);
  PutLong(Pair<14>(r), homing_search_speed, order);
  PutLong(Pair<16>(r), homing_edge_speed, order);
  PutLong(Pair<18>(r), homing_acceleration, order);
  return r;
}

RxImage RxImage::Decode(const Registers& r, WordOrder order) {
  RxImage image;
  image.control = r[0];
  image.mode = static_cast<Mode>(GetByte(r[1]));
  image.target = GetLong(Pair<2>(r), order);
  image.speed = GetLong(Pair<4>(r), order);
  image.acceleration = GetLong(Pair<6>(r), order);
  image.deceleration = GetLong(Pair<8>(r), order);
  image.home_offset = GetLong(Pair<10>(r), order);
  image.homing_method = GetByte(r[12]);
  image.homing_search_speed = GetLong(Pair<14>(r), order);
  image.homing_edge_speed = GetLong(Pair<16>(r), order);
  image.homing_acceleration = GetLong(Pair<18>(r), order);
  return image;
}

}  // namespace foresight::cia402
