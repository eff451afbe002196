#include <gtest/gtest.h>

#include "hardware/motor/cia402.h"

namespace foresight::cia402 {
namespace {

TEST(Cia402, KnowsTheStatesOfARealTrialByTheirStatuswords) {
  EXPECT_EQ(StateOf(0x0650), DriveState::kSwitchOnDisabled);
  EXPECT_EQ(StateOf(0x0631), DriveState::kReadyToSwitchOn);
  EXPECT_EQ(StateOf(0x0633), DriveState::kSwitchedOn);
  EXPECT_EQ(StateOf(0x0637), DriveState::kOperationEnabled);
  EXPECT_EQ(StateOf(0x0217), DriveState::kQuickStopActive);
  EXPECT_EQ(StateOf(0x0618), DriveState::kFault);
}

TEST(Cia402, KnowsAStateWhateverTheOtherBitsSay) {
  constexpr std::uint16_t kOthers = 0xFF90;  // all bits outside the mask 6Fh
  EXPECT_EQ(StateOf(0x0000 | kOthers), DriveState::kNotReady);
  EXPECT_EQ(StateOf(0x0040 | 0x20 | kOthers), DriveState::kSwitchOnDisabled);
  EXPECT_EQ(StateOf(0x0021 | kOthers), DriveState::kReadyToSwitchOn);
  EXPECT_EQ(StateOf(0x0023 | kOthers), DriveState::kSwitchedOn);
  EXPECT_EQ(StateOf(0x0027 | kOthers), DriveState::kOperationEnabled);
  EXPECT_EQ(StateOf(0x0007 | kOthers), DriveState::kQuickStopActive);
  EXPECT_EQ(StateOf(0x000F | 0x20 | kOthers), DriveState::kFaultReaction);
  EXPECT_EQ(StateOf(0x0008 | 0x20 | kOthers), DriveState::kFault);
}

TEST(Cia402, CallsBitsThatNoStateHasUnknown) {
  EXPECT_EQ(StateOf(0x0005), DriveState::kUnknown);
  EXPECT_EQ(StateOf(0xFFFF), DriveState::kUnknown);
}

TEST(Cia402, WalksFromSwitchOnDisabledToOperationByTheStandardsWords) {
  EXPECT_EQ(TowardsOperation(DriveState::kSwitchOnDisabled), 0x06);
  EXPECT_EQ(TowardsOperation(DriveState::kReadyToSwitchOn), 0x07);
  EXPECT_EQ(TowardsOperation(DriveState::kSwitchedOn), 0x0F);
}

TEST(Cia402, NeverLeavesAFaultByItself) {
  EXPECT_EQ(TowardsOperation(DriveState::kFault), control::kDisableVoltage);
  EXPECT_EQ(TowardsOperation(DriveState::kFaultReaction), control::kDisableVoltage);
}

TEST(Cia402, QuickStopIsTheWordWithBit2LowAndVoltageOn) {
  EXPECT_EQ(control::kQuickStop, 0x0B);
  EXPECT_EQ(control::kEnableOperation & ~control::kQuickStop, 0x04);
}

TEST(Cia402, NamesTheFollowingErrorByItsCode) {
  EXPECT_STREQ(ErrorText(0x8611), "following error");
  EXPECT_STREQ(ErrorText(0x1234), "drive error");
}

TEST(RegisterImage, PutsTheTargetOf1500CountsDownHighWordFirst) {
  RxImage image;
  image.target = -1500;
  const auto registers = image.Encode(WordOrder::kHighFirst);
  EXPECT_EQ(registers[2], 0xFFFF);
  EXPECT_EQ(registers[3], 0xFA24);
}

TEST(RegisterImage, PutsTheLowWordFirstWhereTheDriveWantsThat) {
  RxImage image;
  image.target = -1500;
  const auto registers = image.Encode(WordOrder::kLowFirst);
  EXPECT_EQ(registers[2], 0xFA24);
  EXPECT_EQ(registers[3], 0xFFFF);
  EXPECT_EQ(RxImage::Decode(registers, WordOrder::kLowFirst).target, -1500);
}

TEST(RegisterImage, ReadsWhatADriveSends) {
  // 6041h = 0637h, 6061h = 1, 6064h = 4000, 606Ch = -1000, 603Fh = 8611h, 60FDh bit 2.
  const TxImage::Registers sent = {0x0637, 0x0001, 0x0000, 0x0FA0, 0xFFFF,
                                   0xFC18, 0x8611, 0x0000, 0x0000, 0x0004};
  const TxImage image = TxImage::Decode(sent, WordOrder::kHighFirst);
  EXPECT_EQ(image.state(), DriveState::kOperationEnabled);
  EXPECT_EQ(image.mode, Mode::kProfilePosition);
  EXPECT_EQ(image.position, 4000);
  EXPECT_EQ(image.velocity, -1000);
  EXPECT_EQ(image.error_code, 0x8611);
  EXPECT_EQ(image.inputs, kHomeSwitchInput);
  EXPECT_EQ(image.Encode(WordOrder::kHighFirst), sent);
}

TEST(RegisterImage, KeepsAPadBesideAModeOutOfIt) {
  TxImage::Registers sent{};
  sent[1] = 0xAA06;
  EXPECT_EQ(TxImage::Decode(sent, WordOrder::kHighFirst).mode, Mode::kHoming);
}

TEST(RegisterImage, LaysTheHomingOutAsMapped) {
  RxImage image;
  image.home_offset = 0x00010002;
  image.homing_method = 20;
  image.homing_search_speed = 1000;
  image.homing_edge_speed = 50;
  image.homing_acceleration = 20000;
  const auto all = image.Encode(WordOrder::kHighFirst);
  const std::array<std::uint16_t, 10> homing = {1, 2, 20, 0, 0, 1000, 0, 50, 0, 20000};
  EXPECT_TRUE(std::equal(homing.begin(), homing.end(), all.begin() + 10));
}

TEST(RegisterImage, ComesBackWholeInBothWordOrders) {
  RxImage image;
  image.control = 0x3F;
  image.mode = Mode::kProfilePosition;
  image.target = -123456;
  image.speed = 1500;
  image.acceleration = 70000;
  image.deceleration = 80000;
  image.home_offset = -7;
  image.homing_method = -4;
  image.homing_search_speed = 66000;
  image.homing_edge_speed = 50;
  image.homing_acceleration = 1 << 30;
  for (const WordOrder order : {WordOrder::kHighFirst, WordOrder::kLowFirst})
    EXPECT_EQ(RxImage::Decode(image.Encode(order), order), image);
}

}  // namespace
}  // namespace foresight::cia402
