#include "hardware/link/server/image_desk.h"

#include "core/io/jpeg.h"
#include "core/io/png.h"
#include "tests/hardware/link/chunks/random_scans.h"
#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

class ImageDeskTest : public ::testing::Test {
 protected:
  ImageDeskTest() {
    FakeHead head;
    EXPECT_TRUE(head.Home());
    EXPECT_TRUE(head.StartScan(ScanPlan(), shelf->Begin(scan.uuid, {}).value()));
    head.Play(scan);
    EXPECT_TRUE(
        Eventually([&] { return shelf->Find(scan.uuid).value().state != ScanState::kRunning; }));
  }
  link::ImageRequest Request() const {
    link::ImageRequest request;
    request.set_scan_id(scan.uuid);
    request.set_position(1);
    return request;
  }
  ErrorCode Refusal(const link::ImageRequest& request) {
    const auto made = MakeImage(*shelf, request);
    return made ? ErrorCode::kCancelled : made.error().code;
  }

  const Scan scan = [] {
    Scan made = samples::RandomScan(3, 10, 2);
    made.uuid = "a-scan";
    made.state = ScanState::kComplete;
    made.reason.clear();
    return made;
  }();
  const ColorImage& image = scan.frames[1].image;
  const TemporaryFolder folder;
  const std::unique_ptr<ScanShelf> shelf = ScanShelf::Open({folder / "scans", 0.9}).value();
};

TEST_F(ImageDeskTest, WithoutAQualityItIsTheImageToTheLastBit) {
  const link::ImageReply reply = MakeImage(*shelf, Request()).value();
  EXPECT_EQ(DecodePng(reply.image(), "").value(), image);
  EXPECT_EQ(reply.images(), 2);
  EXPECT_EQ(reply.motor_angle_rad(), scan.frames[1].motor_angle_rad);
  EXPECT_EQ(reply.full_width(), image.width());
}

TEST_F(ImageDeskTest, APartIsCutOutOfTheFullImageAndThenShrunk) {
  link::ImageRequest request = Request();
  request.set_left(3);
  request.set_top(2);
  request.set_width(image.width() - 5);
  request.set_height(image.height() - 4);
  const ColorImage part = DecodePng(MakeImage(*shelf, request).value().image(), "").value();
  ASSERT_EQ(part.width(), image.width() - 5);
  EXPECT_EQ(part(0, 0), image(3, 2));
  EXPECT_EQ(part(part.width() - 1, part.height() - 1),
            image(image.width() - 3, image.height() - 3));
  request.set_largest_side_px(4);
  request.set_jpeg_quality(50);
  const ColorImage small = DecodeJpeg(MakeImage(*shelf, request).value().image(), "").value();
  EXPECT_EQ(std::max(small.width(), small.height()), 4);
}

TEST_F(ImageDeskTest, WhatIsNotThereIsRefused) {
  link::ImageRequest request = Request();
  request.set_scan_id("none");
  EXPECT_EQ(Refusal(request), ErrorCode::kInvalidInput);
  for (const int position : {-1, 2}) {
    request = Request();
    request.set_position(position);
    EXPECT_EQ(Refusal(request), ErrorCode::kInvalidInput);
  }
  for (const int quality : {-1, 101}) {
    request = Request();
    request.set_jpeg_quality(quality);
    EXPECT_EQ(Refusal(request), ErrorCode::kInvalidOptions);
  }
  for (const auto& [left, width] : std::vector<std::pair<int, int>>{
           {-1, 4}, {0, image.width() + 1}, {0, -3}, {0, 0}, {1 << 30, 1 << 30}}) {
    request = Request();
    request.set_left(left);
    request.set_width(width);
    request.set_height(1);
    EXPECT_EQ(Refusal(request), ErrorCode::kInvalidInput) << left << " " << width;
  }
  request = Request();
  request.set_largest_side_px(-1);
  EXPECT_EQ(Refusal(request), ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace foresight
