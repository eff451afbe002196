// What goes wrong between a camera and its driver, over the wire.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/hardware/gige_bench.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using SteadyClock = std::chrono::steady_clock;

double SecondsSince(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// As in the field: an image is there at once or not at all.
void Default(GigeCameraOptions& options) {
  options.frame_timeout_s = GigeCameraOptions().frame_timeout_s;
}
/// Twice as patient, where an image has to come on a busy machine too.
void Patient(GigeCameraOptions& options) {
  options.frame_timeout_s = 1.0;
}

/// Everything arrives, bit for bit, although packets get lost.
void ExpectAllImagesInSpiteOf(double loss_ratio, int images) {
  CameraFaults faults;
  faults.packet_loss_ratio = loss_ratio;
  GigeBench bench(faults);
  ASSERT_TRUE(bench.camera->Connect());
  for (int i = 0; i < images; ++i) {
    const auto frame = bench.Take();
    ASSERT_TRUE(frame) << i << ": " << frame.error().message;
    EXPECT_EQ(frame->image, bench.Truth(bench.emulator->taken().back()));
  }
  const CameraEmulator::Counts counts = bench.emulator->counts();
  const CameraHealth health = bench.camera->Health();
  testing::Test::RecordProperty("lost", static_cast<int>(counts.lost_packets));
  testing::Test::RecordProperty("resent", static_cast<int>(counts.resent_packets));
  EXPECT_GT(counts.lost_packets, 0);
  EXPECT_GT(health.resent_packets, 0);
  EXPECT_EQ(health.frames, images);
  EXPECT_EQ(health.incomplete, 0);
  EXPECT_EQ(health.missing_packets, 0);
}

TEST(GigeFaults, OnePercentOfLostPacketsCostsNoImage) {
  ExpectAllImagesInSpiteOf(0.01, 20);
}

TEST(GigeFaults, FivePercentOfLostPacketsCostNoImage) {
  ExpectAllImagesInSpiteOf(0.05, 20);
}

TEST(GigeFaults, AVanishedCameraIsSuspectSoonAndWellAgainWhenItReturns) {
  GigeBench bench({}, Default);
  ASSERT_TRUE(bench.camera->Connect());
  ASSERT_TRUE(bench.Take());
  bench.emulator->InjectVanish(1.2);
  const auto start = SteadyClock::now();
  ASSERT_TRUE(bench.camera->Trigger());
  ASSERT_TRUE(GigeBench::WaitFor([&] { return bench.camera->Health().suspect; }));
  EXPECT_LT(SecondsSince(start), 0.6);
  const auto missing = bench.camera->WaitForFrame(std::chrono::milliseconds(0));
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("image 1 did not come within 500 ms"));
  // The same connection serves again, and nobody has restarted anything.
  ASSERT_TRUE(GigeBench::WaitFor([&] { return !bench.camera->Health().suspect; }));
  EXPECT_TRUE(GigeBench::WaitFor([&] { return bench.Take().has_value(); }));
  EXPECT_EQ(bench.camera->Health().reconnects, 0);
  EXPECT_GE(bench.camera->Health().lost, 1);
}

TEST(GigeFaults, ACameraThatWasGoneForLongIsOpenedAnewWithItsSettings) {
  GigeBench bench({}, Default);
  ASSERT_TRUE(bench.camera->Connect());
  ASSERT_TRUE(bench.camera->Configure({0.003, 6.0}));
  bench.emulator->InjectVanish(5.0);
  ASSERT_TRUE(bench.camera->Trigger());
  ASSERT_TRUE(GigeBench::WaitFor([&] { return !bench.camera->Health().connected; }));
  EXPECT_FALSE(bench.camera->WaitForFrame(std::chrono::milliseconds(1000)));
  ASSERT_TRUE(GigeBench::WaitFor([&] { return bench.camera->Health().connected; }, 40.0));
  Result<CameraFrame> frame;
  ASSERT_TRUE(GigeBench::WaitFor([&] { return (frame = bench.Take()).has_value(); }));
  EXPECT_DOUBLE_EQ(frame->gain_db, 6.0);
  EXPECT_EQ(bench.camera->Health().reconnects, 1);
}

TEST(GigeFaults, NoCallWaitsForACameraThatIsGone) {
  GigeBench bench({}, Default);
  ASSERT_TRUE(bench.camera->Connect());
  bench.emulator->InjectVanish(4.0);
  double longest_s = 0.0;
  int refused = 0;
  const auto start = SteadyClock::now();
  while (SecondsSince(start) < 1.5) {
    const auto called = SteadyClock::now();
    if (!bench.camera->Trigger()) ++refused;
    static_cast<void>(bench.camera->WaitForFrame(std::chrono::milliseconds(0)));
    static_cast<void>(bench.camera->Health());
    longest_s = std::max(longest_s, SecondsSince(called));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_LT(longest_s, 0.05);
  EXPECT_GT(refused, 0) << "a camera that does not answer takes no triggers";
  const auto called = SteadyClock::now();
  EXPECT_FALSE(bench.camera->Configure({0.002, 0.0}));
  EXPECT_LT(SecondsSince(called), bench.options.configure_timeout_s + 0.1);
}

TEST(GigeFaults, DestroyingTheDriverOfACameraThatIsGoneTakesSecondsNotMinutes) {
  GigeBench bench({}, Default);
  ASSERT_TRUE(bench.camera->Connect());
  bench.emulator->InjectVanish(60.0);
  ASSERT_TRUE(bench.camera->Trigger());
  ASSERT_TRUE(GigeBench::WaitFor([&] { return bench.camera->Health().suspect; }));
  const auto start = SteadyClock::now();
  bench.camera.reset();
  RecordProperty("ms", static_cast<int>(1e3 * SecondsSince(start)));
  // Five questions of 2.5 s each: one under way, a heartbeat, and what Aravis asks on leaving.
  EXPECT_LT(SecondsSince(start), 15.0);
}

TEST(GigeFaults, AnIgnoredTriggerIsSaidOnceAndTheNextImageComes) {
  GigeBench bench({}, Patient);
  ASSERT_TRUE(bench.camera->Connect());
  bench.emulator->InjectIgnoredTriggers(1);
  const auto ignored = bench.Take();
  ASSERT_FALSE(ignored);
  EXPECT_THAT(ignored.error().message, HasSubstr("image 0 did not come"));
  ASSERT_TRUE(GigeBench::WaitFor([&] { return !bench.camera->Health().suspect; }));
  const auto next = bench.Take();
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_EQ(next->seq, 1);
  EXPECT_EQ(bench.emulator->counts().ignored_triggers, 1);
}

TEST(GigeFaults, ASlowImageComesInTimeAndOneThatIsTooLateIsNotTakenForAnother) {
  GigeBench bench({}, Patient);
  ASSERT_TRUE(bench.camera->Connect());
  bench.emulator->InjectSlowFrames(1, 0.3);
  EXPECT_TRUE(bench.Take());
  bench.emulator->InjectSlowFrames(1, 1.3);
  EXPECT_FALSE(bench.Take());
  ASSERT_TRUE(GigeBench::WaitFor([&] { return !bench.camera->Health().suspect; }));
  const auto next = bench.Take();
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_EQ(next->seq, 2);
  EXPECT_EQ(next->image, bench.Truth(bench.emulator->taken().back()));
}

TEST(GigeFaults, ThePlannedFaultsOfASeedAreTheSameEachTime) {
  std::vector<std::vector<std::int64_t>> taken;
  for (int run = 0; run < 2; ++run) {
    CameraFaults faults;
    faults.seed = 7;
    faults.ignored_trigger_fraction = 0.5;
    GigeBench bench(faults, Default);
    ASSERT_TRUE(bench.camera->Connect());
    for (int i = 0; i < 6; ++i) {
      ASSERT_TRUE(GigeBench::WaitFor([&] { return !bench.camera->Health().suspect; }));
      static_cast<void>(bench.Take());
    }
    std::vector<std::int64_t> seqs;
    for (const auto& capture : bench.emulator->taken()) seqs.push_back(capture.seq);
    EXPECT_EQ(seqs.size() + static_cast<std::size_t>(bench.emulator->counts().ignored_triggers),
              6u);
    taken.push_back(seqs);
  }
  EXPECT_LT(taken[0].size(), 6u);
  EXPECT_EQ(taken[0], taken[1]);
}

TEST(GigeFaults, ControlThatACrashedClientHoldsIsWaitedFor) {
  GigeBench bench;
  // A client that takes control and is never heard of again.
  auto crashed = UdpSocket::Bind({"127.0.0.1", 0});
  ASSERT_TRUE(crashed);
  gvcp::Request request;
  request.id = 1;
  request.body = gvcp::WriteRegisters{{{camera_register::kControlPrivilege, 2}}};
  auto camera = UdpSocket::Bind({bench.emulator->address(), 0});  // for its address as a number
  ASSERT_TRUE(camera);
  ASSERT_TRUE(crashed->SendTo(gvcp::EncodeRequest(request), {camera->ip(), gvcp::kPort}));
  std::array<std::uint8_t, 64> answer{};
  ASSERT_TRUE(crashed->Receive(answer, std::chrono::seconds(5)));
  const auto start = SteadyClock::now();
  const Status connected = bench.camera->Connect();
  ASSERT_TRUE(connected) << connected.error().message;
  EXPECT_GT(SecondsSince(start), 2.5) << "the heartbeat timeout is 3 s";
  EXPECT_TRUE(bench.Take());
}

TEST(GigeFaults, ANetworkWithoutTheCameraIsSaidAsSuch) {
  GigeCameraOptions options;
  options.address = GigeAddress();
  options.connect_timeout_s = 0.3;
  GigeCamera camera(options, std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime));
  const Status connected = camera.Connect();
  ASSERT_FALSE(connected);
  EXPECT_THAT(connected.error().message, HasSubstr("camera " + options.address));
  EXPECT_FALSE(camera.Trigger());
}

}  // namespace
}  // namespace foresight
