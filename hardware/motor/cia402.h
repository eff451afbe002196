#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

/// A drive as CiA 402 describes it, and how its objects lie in Modbus registers. Pure values, no
/// transport: driver and emulator share these two facts and nothing else. docs/protocols.md.
namespace foresight::cia402 {

/// Object 6041h tells it by its low bits.
enum class DriveState {
  kNotReady,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReaction,
  kFault,
  kUnknown,  ///< bits that no state has: probably not a CiA 402 drive
};
DriveState StateOf(std::uint16_t status);
/// "switch-on disabled", "operation enabled", ...
const char* ToString(DriveState state);

/// Bits of the statusword that are not part of the state.
namespace status {
inline constexpr std::uint16_t kVoltage = 1U << 4;
inline constexpr std::uint16_t kWarning = 1U << 7;
inline constexpr std::uint16_t kRemote = 1U << 9;
inline constexpr std::uint16_t kTargetReached = 1U << 10;
inline constexpr std::uint16_t kInternalLimit = 1U << 11;
inline constexpr std::uint16_t kSetPointAcknowledged = 1U << 12;  ///< in profile position
inline constexpr std::uint16_t kHomingAttained = 1U << 12;        ///< in homing
inline constexpr std::uint16_t kHomingError = 1U << 13;           ///< in homing
}  // namespace status

/// Words for object 6040h.
namespace control {
inline constexpr std::uint16_t kDisableVoltage = 0x00;
inline constexpr std::uint16_t kShutdown = 0x06;
inline constexpr std::uint16_t kSwitchOn = 0x07;
inline constexpr std::uint16_t kQuickStop = 0x0B;
inline constexpr std::uint16_t kEnableOperation = 0x0F;
inline constexpr std::uint16_t kFaultReset = 0x80;  ///< acts on its rising edge
// Bits to add to kEnableOperation.
inline constexpr std::uint16_t kNewSetPoint = 1U << 4;
inline constexpr std::uint16_t kStartHoming = 1U << 4;
inline constexpr std::uint16_t kChangeAtOnce = 1U << 5;
inline constexpr std::uint16_t kHalt = 1U << 8;
}  // namespace control

/// The word that brings a drive one state closer to operation enabled. A fault is left to the
/// operator: kDisableVoltage.
std::uint16_t TowardsOperation(DriveState state);

/// Objects 6060h (wanted) and 6061h (in force).
enum class Mode : std::int8_t { kNone = 0, kProfilePosition = 1, kHoming = 6 };

inline constexpr std::uint16_t kFollowingError = 0x8611;  ///< object 603Fh
/// "following error", or "drive error" for a code that is not known here.
const char* ErrorText(std::uint16_t code);

inline constexpr std::uint32_t kHomeSwitchInput = 1U << 2;  ///< in object 60FDh

/// Which half of a 32-bit object comes first. Not verified on a drive: read docs/protocols.md.
enum class WordOrder { kHighFirst, kLowFirst };

void PutLong(std::span<std::uint16_t, 2> registers, std::int32_t value, WordOrder order);
std::int32_t GetLong(std::span<const std::uint16_t, 2> registers, WordOrder order);

/// Drive to host, registers 5000 to 5009.
struct TxImage {
  static constexpr std::uint16_t kFirst = 5000;
  static constexpr std::uint16_t kCount = 10;
  using Registers = std::array<std::uint16_t, kCount>;

  std::uint16_t status = 0;      ///< 6041h
  Mode mode = Mode::kNone;       ///< 6061h
  std::int32_t position = 0;     ///< 6064h, counts
  std::int32_t velocity = 0;     ///< 606Ch, counts/s
  std::uint16_t error_code = 0;  ///< 603Fh
  std::uint32_t inputs = 0;      ///< 60FDh

  DriveState state() const { return StateOf(status); }
  Registers Encode(WordOrder order) const;
  static TxImage Decode(const Registers& registers, WordOrder order);
  bool operator==(const TxImage&) const = default;
};

/// Host to drive, registers 6000 to 6019.
struct RxImage {
  static constexpr std::uint16_t kFirst = 6000;
  static constexpr std::uint16_t kCount = 20;
  using Registers = std::array<std::uint16_t, kCount>;
  /// First registers of the parts that are written one by one.
  static constexpr std::uint16_t kControl = 6000;
  static constexpr std::uint16_t kMode = 6001;
  static constexpr std::uint16_t kProfile = 6002;  ///< target, speed, both accelerations
  static constexpr std::uint16_t kProfileCount = 8;
  static constexpr std::uint16_t kHoming = 6010;  ///< offset, method, speeds, acceleration
  static constexpr std::uint16_t kHomingCount = 10;

  std::uint16_t control = 0;             ///< 6040h
  Mode mode = Mode::kNone;               ///< 6060h
  std::int32_t target = 0;               ///< 607Ah, counts
  std::int32_t speed = 0;                ///< 6081h, counts/s
  std::int32_t acceleration = 0;         ///< 6083h, counts/s^2
  std::int32_t deceleration = 0;         ///< 6084h, counts/s^2
  std::int32_t home_offset = 0;          ///< 607Ch, counts
  std::int8_t homing_method = 0;         ///< 6098h
  std::int32_t homing_search_speed = 0;  ///< 6099h:1, counts/s
  std::int32_t homing_edge_speed = 0;    ///< 6099h:2, counts/s
  std::int32_t homing_acceleration = 0;  ///< 609Ah, counts/s^2

  Registers Encode(WordOrder order) const;
  static RxImage Decode(const Registers& registers, WordOrder order);
  bool operator==(const RxImage&) const = default;
};

}  // namespace foresight::cia402
