// Runs in a network of its own with an Avahi daemon of its own (with_private_avahi.sh).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <thread>

#include "hardware/link/discovery/head_announcement.h"
#include "hardware/link/discovery/head_browser.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;

bool Eventually(const std::function<bool()>& so) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!so()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

/// What a command prints; empty when it cannot be run.
std::string OutputOf(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> part{};
  while (const std::size_t got = fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), got);
  pclose(pipe);
  return text;
}

/// A program of another hand, until it goes.
class Process {
 public:
  explicit Process(const std::string& command)
      : pipe_(popen(("exec " + command + " 2>&1 & echo $!; wait").c_str(), "r")) {
    if (pipe_ != nullptr && fscanf(pipe_, "%d", &pid_) != 1) pid_ = 0;
  }
  ~Process() {
    if (pid_ > 0 && system(("kill " + std::to_string(pid_)).c_str()) != 0)
      std::fputs("the program had gone\n", stderr);
    if (pipe_ != nullptr) pclose(pipe_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

 private:
  FILE* pipe_;
  int pid_ = 0;
};

std::vector<std::string> NamesOf(const HeadBrowser& browser) {
  std::vector<std::string> names;
  for (const AnnouncedHead& head : browser.Heads()) names.push_back(head.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Discovery, AvahiBrowseSeesTheHead) {
  const HeadAnnouncement announcement("left", 47130, true);
  std::string seen;
  EXPECT_TRUE(Eventually([&] {
    seen = OutputOf("timeout 5 avahi-browse -rtp _foresight._tcp");
    return seen.find("10.77.0.1;47130") != std::string::npos;
  })) << seen;
  EXPECT_THAT(seen, HasSubstr("\"name=left\""));
  EXPECT_THAT(seen, HasSubstr("\"simulated=1\""));
  EXPECT_EQ(announcement.Trouble(), "");
}

TEST(Discovery, TheStationSeesHeadsComeAndGo) {
  const HeadBrowser browser;
  auto left = std::make_unique<HeadAnnouncement>("left", 47130, false);
  const HeadAnnouncement right("right", 5, true);
  const std::vector<AnnouncedHead> both{{"left", "10.77.0.1:47130", false},
                                        {"right", "10.77.0.1:5", true}};
  ASSERT_TRUE(Eventually([&] { return browser.Heads() == both; }));
  left.reset();
  EXPECT_TRUE(Eventually([&] { return NamesOf(browser) == Names{"right"}; }));
}

TEST(Discovery, TwoHeadsOfOneNameAreBothSeen) {
  const HeadAnnouncement first("twin", 1, false), second("twin", 2, false);
  const HeadBrowser browser;
  EXPECT_TRUE(Eventually([&] { return NamesOf(browser) == Names{"twin", "twin"}; }));
}

TEST(Discovery, AServiceThatIsNoHeadIsNotListed) {
  const Process foreign("avahi-publish -s printer _foresight._tcp 9 'name=../etc'");
  const HeadAnnouncement left("left", 47130, false);
  const HeadBrowser browser;
  ASSERT_TRUE(Eventually([&] {
    return OutputOf("timeout 5 avahi-browse -rtp _foresight._tcp").find("printer") !=
           std::string::npos;
  }));
  EXPECT_TRUE(Eventually([&] { return NamesOf(browser) == Names{"left"}; }));
}

// The last one: it ends the daemon that the others need.
TEST(DiscoveryAtTheEnd, ADaemonThatGoesIsSaidAndOneThatComesBackIsUsed) {
  const HeadBrowser browser;
  const HeadAnnouncement left("left", 47130, false);
  ASSERT_TRUE(Eventually([&] { return NamesOf(browser) == Names{"left"}; }));
  ASSERT_EQ(system("kill $(cat /run/avahi-daemon/pid)"), 0);
  EXPECT_TRUE(Eventually([&] { return !browser.Trouble().empty() && !left.Trouble().empty(); }));
  EXPECT_THAT(browser.Trouble(), HasSubstr("no mDNS on this computer"));
  EXPECT_TRUE(Eventually([&] { return browser.Heads().empty(); }));
  ASSERT_EQ(system("while [ -e /run/avahi-daemon/pid ]; do sleep 0.05; done; "
                   "/usr/sbin/avahi-daemon --file=/run/avahi.conf --no-rlimits --no-drop-root "
                   "--no-chroot -D"),
            0);
  EXPECT_TRUE(Eventually([&] { return NamesOf(browser) == Names{"left"}; }));
  EXPECT_TRUE(Eventually([&] { return browser.Trouble().empty() && left.Trouble().empty(); }));
}

}  // namespace
}  // namespace foresight
