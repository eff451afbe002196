// What the camera sees while nothing is scanned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class ViewWatch final : public LiveViewSink {
 public:
  void OnLiveImage(const LiveImage& image) override {
    const std::lock_guard lock(mutex_);
    images_.push_back(image);
  }
  void OnLiveViewTrouble(const std::string& what) override {
    const std::lock_guard lock(mutex_);
    troubles_.push_back(what);
  }
  std::vector<LiveImage> Images() const {
    const std::lock_guard lock(mutex_);
    return images_;
  }
  std::vector<std::string> Troubles() const {
    const std::lock_guard lock(mutex_);
    return troubles_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<LiveImage> images_;
  std::vector<std::string> troubles_;
};

/// The head's virtual time passes while it idles: the test lets it.
bool WaitFor(const TinyHead& tiny, const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    tiny.clock->Sleep(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}
bool WaitForImages(const TinyHead& tiny, const ViewWatch& view, std::size_t count) {
  return WaitFor(tiny, [&] { return view.Images().size() >= count; });
}

LiveViewOptions Fast() {
  LiveViewOptions options;
  options.rate_hz = 30.0;
  return options;
}

TEST(LiveView, ShowsTheWholeImageOrASmallerPart) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto whole = std::make_shared<ViewWatch>();
  ASSERT_TRUE(tiny.head->StartLiveView(Fast(), whole));
  ASSERT_TRUE(WaitForImages(tiny, *whole, 2));
  EXPECT_EQ(whole->Images()[0].image.width(), 32);
  EXPECT_EQ(whole->Images()[0].image.height(), 24);
  EXPECT_GT(whole->Images()[1].time_s, whole->Images()[0].time_s);

  LiveViewOptions options = Fast();
  options.part = PixelRegion{8, 4, 100, 20};  // wider than the image
  options.largest_side_px = 16;
  const auto part = std::make_shared<ViewWatch>();
  ASSERT_TRUE(tiny.head->StartLiveView(options, part));
  ASSERT_TRUE(WaitForImages(tiny, *part, 1));
  EXPECT_EQ(part->Images()[0].image.width(), 16) << "24 x 20 pixels, made smaller";
  EXPECT_EQ(part->Images()[0].image.height(), 13);
  EXPECT_EQ(part->Images()[0].full_width, 32);
}

TEST(LiveView, PausesDuringAScanWhichLacksNothing) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto view = std::make_shared<ViewWatch>();
  ASSERT_TRUE(tiny.head->StartLiveView(Fast(), view));
  ASSERT_TRUE(WaitForImages(tiny, *view, 1));
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_NE(scan, nullptr);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_EQ(scan->reason, "");
  EXPECT_EQ(scan->frames.size(), 1u);
  const double end_s = scan->lines.back().time_s;
  for (const LiveImage& image : view->Images())
    EXPECT_FALSE(image.time_s > scan->lines.front().time_s && image.time_s < end_s);
  const std::size_t before = view->Images().size();
  EXPECT_TRUE(WaitForImages(tiny, *view, before + 1)) << "and goes on after it";
}

TEST(LiveView, EndsWhenItIsStopped) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto view = std::make_shared<ViewWatch>();
  ASSERT_TRUE(tiny.head->StartLiveView(Fast(), view));
  ASSERT_TRUE(WaitForImages(tiny, *view, 1));
  tiny.head->StopLiveView();
  std::weak_ptr<ViewWatch> weak = view;
  EXPECT_LE(weak.use_count(), 2) << "ours, and one that is being used";
}

TEST(LiveView, SaysOnceThatNoImageComes) {
  TinyHead tiny(
      [](HeadDevices& devices) { devices.camera = std::make_unique<SilentCamera>(devices.clock); });
  ASSERT_TRUE(tiny.Home());
  const auto view = std::make_shared<ViewWatch>();
  LiveViewOptions options = Fast();
  ASSERT_TRUE(tiny.head->StartLiveView(options, view));
  ASSERT_TRUE(WaitFor(tiny, [&] { return !view->Troubles().empty(); }));
  tiny.clock->Sleep(std::chrono::seconds(12));
  EXPECT_EQ(view->Troubles(), std::vector<std::string>{"test camera: no image came"});
}

TEST(LiveView, RefusesWhatIsImpossible) {
  TinyHead tiny;
  const auto view = std::make_shared<ViewWatch>();
  LiveViewOptions options;
  options.rate_hz = 0.0;
  EXPECT_THAT(tiny.head->StartLiveView(options, view).error().message, HasSubstr("rate_hz"));
  options = {};
  options.part = PixelRegion{0, 0, 0, 10};
  EXPECT_THAT(tiny.head->StartLiveView(options, view).error().message, HasSubstr("part"));
}

}  // namespace
}  // namespace foresight
