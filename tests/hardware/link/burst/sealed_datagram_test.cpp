#include "hardware/link/burst/sealed_datagram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/random.h"

namespace foresight {
namespace {

using Bytes = std::vector<std::uint8_t>;

class SealedDatagram : public testing::Test {
 protected:
  Bytes Sealed(const std::string& text) {
    Bytes sealed;
    EXPECT_TRUE(sealer.Seal(Bytes(text.begin(), text.end()), sealed));
    return sealed;
  }
  DatagramVerdict Open(const Bytes& datagram) { return opener.Open(datagram, content); }
  std::string Content() const { return {content.begin(), content.end()}; }

  const BurstKey key = BurstKey::Make().value();
  DatagramSealer sealer = DatagramSealer::Make(key).value();
  DatagramOpener opener = DatagramOpener::Make(key).value();
  Bytes content;
};

TEST_F(SealedDatagram, ComesBackWithItsContent) {
  for (const std::string& text : {std::string("lines"), std::string(), std::string(1368, 'x')}) {
    const Bytes sealed = Sealed(text);
    EXPECT_EQ(sealed.size(), text.size() + kDatagramSealBytes);
    ASSERT_EQ(Open(sealed), DatagramVerdict::kGood) << text.size();
    EXPECT_EQ(Content(), text);
  }
}

TEST_F(SealedDatagram, ShowsNothingOfItsContent) {
  const Bytes first = Sealed("secret secret"), second = Sealed("secret secret");
  const std::string text = "secret";
  EXPECT_EQ(std::search(first.begin(), first.end(), text.begin(), text.end()), first.end());
  EXPECT_FALSE(std::equal(first.begin() + kDatagramHeadBytes, first.end(),
                          second.begin() + kDatagramHeadBytes))
      << "another number makes other bytes";
}

TEST_F(SealedDatagram, WithAnyBitChangedIsRefusedAndChangesNothing) {
  const Bytes good = Sealed("what the head measured");
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Bytes forged = good;
    forged[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    ASSERT_NE(Open(forged), DatagramVerdict::kGood) << "bit " << bit;
    ASSERT_TRUE(content.empty() || Content() != "what the head measured");
  }
  EXPECT_EQ(Open(good), DatagramVerdict::kGood) << "a forged number did not move the window";
}

TEST_F(SealedDatagram, CutAnywhereOrTooLongIsRefused) {
  const Bytes good = Sealed("what the head measured");
  for (std::size_t size = 0; size < good.size(); ++size)
    ASSERT_NE(Open(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))),
              DatagramVerdict::kGood)
        << size;
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_EQ(Open(longer), DatagramVerdict::kForged);
  longer.resize(kMostDatagramBytes + 1);
  EXPECT_EQ(Open(longer), DatagramVerdict::kNoDatagram);
}

TEST_F(SealedDatagram, OfAnotherKeyIsForeign) {
  const BurstKey other = BurstKey::Make().value();
  EXPECT_NE(other.secret, key.secret);
  DatagramSealer stranger = DatagramSealer::Make(other).value();
  Bytes sealed;
  ASSERT_TRUE(stranger.Seal({}, sealed));
  EXPECT_EQ(Open(sealed), DatagramVerdict::kForeignKey);
  // Whoever names our key does not have it.
  BurstKey posing = other;
  posing.id = key.id;
  ASSERT_TRUE(DatagramSealer::Make(posing)->Seal({}, sealed));
  EXPECT_EQ(Open(sealed), DatagramVerdict::kForged);
}

TEST_F(SealedDatagram, ASecondTimeIsReplayed) {
  const Bytes first = Sealed("a"), second = Sealed("b");
  ASSERT_EQ(Open(second), DatagramVerdict::kGood);
  EXPECT_EQ(Open(first), DatagramVerdict::kGood) << "paths change the order";
  EXPECT_EQ(Open(first), DatagramVerdict::kReplayed);
  EXPECT_EQ(Open(second), DatagramVerdict::kReplayed);
}

TEST_F(SealedDatagram, FromFarBehindIsRefused) {
  const Bytes old = Sealed("old");
  Bytes last;
  for (std::uint64_t i = 0; i < ReplayWindow::kSize; ++i) last = Sealed("new");
  ASSERT_EQ(Open(last), DatagramVerdict::kGood);
  EXPECT_EQ(Open(old), DatagramVerdict::kReplayed);
}

TEST(ReplayWindow, AgreesWithAListOfAllThatWasUsed) {
  Random random(3);
  ReplayWindow window;
  std::vector<bool> used(60'000);
  std::uint64_t highest = 0;
  for (int i = 0; i < 100'000; ++i) {
    const int ahead = random.Index(50) == 0 ? random.Index(6000) : random.Index(40) - 30;
    const auto number = static_cast<std::uint64_t>(
        std::clamp<std::int64_t>(static_cast<std::int64_t>(highest) + ahead, 0, 59'999));
    const bool known = number + ReplayWindow::kSize > highest;
    ASSERT_EQ(window.IsNew(number), known && !used[number]) << number << " after " << highest;
    if (!window.IsNew(number)) continue;
    window.Use(number);
    used[number] = true;
    highest = std::max(highest, number);
  }
  EXPECT_EQ(highest, 59'999u);
}

TEST(BurstKey, OfTheWrongSizeOrWithoutANameIsRefused) {
  EXPECT_TRUE(BurstKey::FromBytes(1, std::string(32, 'k')));
  EXPECT_FALSE(BurstKey::FromBytes(0, std::string(32, 'k')));
  EXPECT_FALSE(BurstKey::FromBytes(1, std::string(31, 'k')));
  EXPECT_FALSE(BurstKey::FromBytes(1, std::string(33, 'k')));
}

}  // namespace
}  // namespace foresight
