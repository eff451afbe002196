#include "hardware/link/discovery/announced_head.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foresight {
namespace {

using testing::ElementsAre;

TEST(AnnouncedHead, SaysItsNameAndThatItIsSimulated) {
  EXPECT_THAT(AnnouncementTexts({"left", "", false}), ElementsAre("name=left"));
  EXPECT_THAT(AnnouncementTexts({"left", "", true}), ElementsAre("name=left", "simulated=1"));
}

TEST(AnnouncedHead, ReadsWhatItSays) {
  for (const bool simulated : {false, true}) {
    const AnnouncedHead head{"left-2", "10.0.0.7:47130", simulated};
    EXPECT_EQ(ReadAnnouncement(AnnouncementTexts(head), "10.0.0.7", 47130), head);
  }
  EXPECT_TRUE(ReadAnnouncement({"colour=red", "name=left"}, "10.0.0.7", 1)) << "of a later version";
}

// Anybody on the network can announce anything.
TEST(AnnouncedHead, RefusesWhatNamesNoHead) {
  const auto read = [](const std::string& text, const char* host, std::uint16_t port) {
    return ReadAnnouncement({text}, host, port).has_value();
  };
  EXPECT_TRUE(read("name=left", "10.0.0.7", 1));
  EXPECT_FALSE(read("left", "10.0.0.7", 1));
  EXPECT_FALSE(read("name=", "10.0.0.7", 1));
  EXPECT_FALSE(read("name=left\nright", "10.0.0.7", 1));
  EXPECT_FALSE(read("name=../left", "10.0.0.7", 1));
  EXPECT_FALSE(read("name=" + std::string(300, 'a'), "10.0.0.7", 1));
  EXPECT_FALSE(read("name=left", "10.0.0.7", 0));
  EXPECT_FALSE(read("name=left", "evil.example", 1));
  EXPECT_FALSE(read("name=left", "fe80::1", 1));
}

}  // namespace
}  // namespace foresight
