// The driver on an emulated camera: what arrives is what was taken, when it was taken.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "core/geometry/angles.h"
#include "hardware/emulator/gvsp_ring.h"
#include "hardware/gige/pixel_formats.h"
#include "tests/hardware/gige_bench.h"

namespace foresight {
namespace {

using Format = GigeCameraOptions::Format;

void UseMono(GigeCameraOptions& options) {
  options.format = Format::kMono8;
}
void UseBayer(GigeCameraOptions& options) {
  options.format = Format::kBayerRG8;
}

TEST(GigeCamera, ConnectsByAddress) {
  GigeBench bench;
  const Status connected = bench.camera->Connect();
  ASSERT_TRUE(connected) << connected.error().message;
  EXPECT_TRUE(bench.camera->Health().connected);
  EXPECT_EQ(bench.camera->Describe(), "camera " + bench.emulator->address());
}

TEST(GigeCamera, TenTriggeredImagesAreThoseThatWereTaken) {
  GigeBench bench;
  ASSERT_TRUE(bench.camera->Connect());
  for (int i = 0; i < 10; ++i) {
    const auto frame = bench.Take();
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->seq, i);
    const auto taken = bench.emulator->taken();
    ASSERT_EQ(taken.size(), i + 1u);
    EXPECT_EQ(frame->image, bench.Truth(taken.back()));
  }
  EXPECT_EQ(bench.camera->Health().frames, 10);
}

TEST(GigeCamera, ImagesOfATurningHeadAreTakenAtTheMiddleOfTheExposure) {
  GigeBench bench;
  ASSERT_TRUE(bench.camera->Connect());
  bench.shaft->Move(bench.clock->Now(), 1.0, RadiansFromDegrees(10.0), 7.0);
  const auto frame = bench.Take();
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->image, bench.Truth(bench.emulator->taken().front()));
}

TEST(GigeCamera, AGreyCameraGivesTheLumaInAllChannels) {
  GigeBench bench({}, UseMono);
  ASSERT_TRUE(bench.camera->Connect());
  const auto frame = bench.Take();
  ASSERT_TRUE(frame) << frame.error().message;
  const auto grey =
      EncodePixels(bench.Truth(bench.emulator->taken().front()), gvsp::PixelFormat::kMono8);
  ASSERT_EQ(frame->image.size(), grey.size());
  for (std::size_t i = 0; i < grey.size(); ++i)
    ASSERT_EQ(frame->image.values()[i], (Rgb8{grey[i], grey[i], grey[i]}));
}

TEST(GigeCamera, AColourMosaicKeepsEveryMeasuredValue) {
  GigeBench bench({}, UseBayer);
  ASSERT_TRUE(bench.camera->Connect());
  const auto frame = bench.Take();
  ASSERT_TRUE(frame) << frame.error().message;
  const auto mosaic =
      EncodePixels(bench.Truth(bench.emulator->taken().front()), gvsp::PixelFormat::kBayerRG8);
  EXPECT_EQ(EncodePixels(frame->image, gvsp::PixelFormat::kBayerRG8), mosaic);
}

TEST(GigeCamera, ExposureAndGainReachTheCamera) {
  GigeBench bench;
  ASSERT_TRUE(bench.camera->Connect());
  const Status configured = bench.camera->Configure({0.0025, 3.5});
  ASSERT_TRUE(configured) << configured.error().message;
  const auto frame = bench.Take();
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_DOUBLE_EQ(frame->exposure_s, 0.0025);
  EXPECT_DOUBLE_EQ(frame->gain_db, 3.5);
  EXPECT_DOUBLE_EQ(bench.emulator->taken().front().exposure_s, 0.0025);
  EXPECT_DOUBLE_EQ(bench.emulator->taken().front().gain_db, 3.5);
}

TEST(GigeCamera, RefusesAnExposureThatTheCameraCannotDo) {
  GigeBench bench;
  ASSERT_TRUE(bench.camera->Connect());
  const Status configured = bench.camera->Configure({2.0, 0.0});
  ASSERT_FALSE(configured);
  EXPECT_EQ(configured.error().code, ErrorCode::kInvalidOptions);
  EXPECT_TRUE(bench.Take());
}

TEST(GigeCamera, StampsAreTheMiddleOfTheExposureOnTheHeadsClock) {
  CameraFaults faults;
  faults.clock_start_s = 86400.0;  // it has been on for a day
  faults.clock_ppm = 50.0;
  GigeBench bench(faults);
  ASSERT_TRUE(bench.camera->Connect());
  double worst_s = 0.0;
  for (int i = 0; i < 10; ++i) {
    const auto frame = bench.Take();
    ASSERT_TRUE(frame) << frame.error().message;
    worst_s = std::max(worst_s, std::abs(frame->time_s - bench.emulator->taken().back().middle_s));
  }
  const double known_s = bench.camera->Health().clock_uncertainty_s;
  RecordProperty("worst_us", static_cast<int>(1e6 * worst_s));
  RecordProperty("uncertainty_us", static_cast<int>(1e6 * known_s));
  // The best round trip of eight, and the drift until the next reading, which waits for the last
  // image: 50 ppm of a few seconds. A degree is 10.2 px, so at 10 deg/s a millisecond is 0.1 px.
  EXPECT_LT(worst_s, known_s + 1e-3);
}

TEST(GigeCamera, BlockNumbersWrapUnnoticed) {
  CameraFaults faults;
  faults.first_block = 65534;
  GigeBench bench(faults);
  ASSERT_TRUE(bench.camera->Connect());
  for (int i = 0; i < 4; ++i) {
    const auto frame = bench.Take();
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->seq, i);
  }
}

TEST(GigeCamera, SeveralTriggersAtATimeComeInOrder) {
  GigeBench bench;
  ASSERT_TRUE(bench.camera->Connect());
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(bench.camera->Trigger());
    ASSERT_TRUE(GigeBench::WaitFor([&] { return bench.emulator->taken().size() == i + 1u; }));
  }
  for (int i = 0; i < 3; ++i) {
    const auto frame = bench.camera->WaitForFrame(std::chrono::milliseconds(2000));
    ASSERT_TRUE(frame && *frame) << (frame ? "none" : frame.error().message);
    EXPECT_EQ((*frame)->seq, i);
    EXPECT_EQ((*frame)->image, bench.Truth(bench.emulator->taken()[static_cast<std::size_t>(i)]));
  }
}

TEST(GigeCamera, TwoCamerasAtTwoAddressesDoNotMeet) {
  GigeBench bench;
  CameraEmulatorOptions emulated;
  emulated.address = GigeAddress(1);
  auto other = CameraEmulator::Start(bench.world, bench.clock, bench.shaft, emulated);
  ASSERT_TRUE(other) << other.error().message;
  GigeCameraOptions options = bench.options;
  options.address = emulated.address;
  GigeCamera second(options, bench.clock);
  ASSERT_TRUE(bench.camera->Connect());
  ASSERT_TRUE(second.Connect());
  ASSERT_TRUE(second.Trigger());
  const auto frame = second.WaitForFrame(std::chrono::milliseconds(2000));
  ASSERT_TRUE(frame && *frame);
  // The last packet arrives a moment before the emulator has counted it.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  while ((*other)->counts().frames == 0 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(bench.emulator->counts().frames, 0);
  EXPECT_EQ((*other)->counts().frames, 1);
}

}  // namespace
}  // namespace foresight
