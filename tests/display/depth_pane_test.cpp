#include <QKeyEvent>
#include <QSlider>
#include <cmath>

#include "core/pictures/sample_picture.h"
#include "tests/display/mouse.h"
#include "tests/display/workstation_fixture.h"

namespace foresight {
namespace {

/// The depth pane after a scan with the paper's method, in viridis: no colour of it is near that of
/// a rejected sample.
struct DepthPaneOnScreen : Workstation {
  void SetUp() override {
    Workstation::SetUp();
    if (HasFatalFailure()) return;
    running->bench().live.depth.setMethod(DepthMethod::kPaper);
    ASSERT_TRUE(WaitFor([] { return running->bench().Idle(); }));
    Layers().SetDepthColors(ColorMap::kViridis);
    running->Settle();
  }
  void TearDown() override {
    Workstation::TearDown();
    for (const RejectReason kind : kSampleKinds) Layers().ShowSamples(kind, false);
    Layers().SetDepthColors(ColorMap::kTurbo);
    Compare().compareWithNothing();
    Compare().setWipe(0.5);
  }

  static LayersViewModel& Layers() { return running->bench().live.layers; }
  static CompareViewModel& Compare() { return running->bench().live.compare; }
  static DepthPane* Pane() { return running->window().Depth(); }
  static const CameraFrame& CurrentImage() { return *running->bench().live.session.CurrentImage(); }
  static double FractionNear(const QImage& capture, Rgb8 color) {
    return FractionOf(capture, [color](const QColor& seen) { return IsNear(seen, color); });
  }
  /// A place at this fraction of the image's width, three quarters up: wall without lines over it.
  static Eigen::Vector2d At(double fraction) {
    return {fraction * CurrentImage().image.width(), 0.3 * CurrentImage().image.height()};
  }
  static QColor SeenAt(const Eigen::Vector2d& pixel) {
    return DepthPixels().pixelColor(Pane()->Canvas()->WidgetFromPixel(pixel));
  }
  /// Smoothing on the screen mixes bricks and mortar: twice the usual tolerance would be too loose
  /// to tell them from viridis, so the mean of a patch is compared.
  static bool ShowsTheCamera(double fraction) {
    constexpr int kHalf_px = 12;
    Eigen::Vector3d seen = Eigen::Vector3d::Zero(), taken = seen;
    for (int dy = -kHalf_px; dy <= kHalf_px; dy += 4)
      for (int dx = -kHalf_px; dx <= kHalf_px; dx += 4) {
        const Eigen::Vector2d pixel = At(fraction) + Eigen::Vector2d(dx, dy);
        const QColor color = SeenAt(pixel);
        const Rgb8 p =
            CurrentImage().image(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
        seen += Eigen::Vector3d(color.red(), color.green(), color.blue()) / 49.0;
        taken += Eigen::Vector3d(p.r, p.g, p.b) / 49.0;
      }
    return (seen - taken).norm() < 30.0;
  }
  static void Press(int key) {
    QKeyEvent event(QEvent::KeyPress, key, Qt::ShiftModifier);
    QApplication::sendEvent(Pane()->Canvas(), &event);
  }
};

TEST_F(DepthPaneOnScreen, TheFlyingLayerDrawsInItsColourOverDepthAndImage) {
  const Rgb8 color = ColorOf(RejectReason::kFlying);
  const double in_depth = FractionNear(DepthPixels(), color);
  const double in_image = FractionNear(ImagePixels(), color);
  Layers().ShowSamples(RejectReason::kFlying, true);
  running->Settle();
  EXPECT_GT(FractionNear(DepthPixels(), color), in_depth + 0.005);
  EXPECT_GT(FractionNear(ImagePixels(), color), in_image + 0.005);
}

TEST_F(DepthPaneOnScreen, ALayerThatIsSwitchedOffLeavesNothingBehind) {
  const QImage before = DepthPixels();
  Layers().ShowSamples(RejectReason::kFlying, true);
  running->Settle();
  ASSERT_NE(DepthPixels(), before);
  Layers().ShowSamples(RejectReason::kFlying, false);
  running->Settle();
  EXPECT_EQ(DepthPixels(), before);
}

TEST_F(DepthPaneOnScreen, EachSideOfTheLineShowsTheSamplesOfItsOwnMethod) {
  // The joint bilateral filter takes the raw samples: it has rejected none.
  Compare().compareWithMethod(DepthMethod::kJointBilateral);
  ASSERT_TRUE(WaitFor([] { return Compare().Second() != nullptr; }));
  running->Settle();
  const int line = Pane()->Canvas()->WidgetFromPixel(At(0.5)).x();
  const auto left = [line](const QImage& all) { return all.copy(0, 0, line, all.height()); };
  const auto right = [line](const QImage& all) {
    return all.copy(line, 0, all.width() - line, all.height());
  };
  const QImage before = DepthPixels();
  Layers().ShowSamples(RejectReason::kFlying, true);
  running->Settle();
  const QImage after = DepthPixels();
  const Rgb8 color = ColorOf(RejectReason::kFlying);
  EXPECT_GT(FractionNear(left(after), color), FractionNear(left(before), color) + 0.005);
  EXPECT_EQ(right(after), right(before));
  Compare().compareWithNothing();
  running->Settle();
  EXPECT_GT(FractionNear(right(DepthPixels()), color), 0.005);
}

TEST_F(DepthPaneOnScreen, BelowTheDensityFloorAWarningStandsUnderTheMapUntilABetterDepthComes) {
  SessionModel& session = running->bench().live.session;
  const auto good = session.Depth();
  EXPECT_TRUE(Pane()->Warning().isEmpty());
  auto sparse = std::make_shared<DepthResult>(*good);
  sparse->density = 0.0143;
  session.SetDepth(sparse);
  running->Settle();
  EXPECT_TRUE(Pane()->Warning().contains("1.43")) << Pane()->Warning().toStdString();
  session.SetDepth(good);
  running->Settle();
  EXPECT_TRUE(Pane()->Warning().isEmpty());
}

TEST_F(DepthPaneOnScreen, TheCameraStandsRightOfTheLineAndTheDepthLeftOfIt) {
  const QColor depth_left = SeenAt(At(0.4));
  Compare().compareWithImage();
  running->Settle();
  EXPECT_EQ(SeenAt(At(0.4)), depth_left);
  EXPECT_FALSE(ShowsTheCamera(0.4));
  EXPECT_TRUE(ShowsTheCamera(0.6));
}

TEST_F(DepthPaneOnScreen, TheLineIsDraggedWithTheMouseAndMovedWithTheKeys) {
  Compare().compareWithImage();
  running->Settle();
  DepthCanvas* canvas = Pane()->Canvas();
  Drag(canvas, canvas->WidgetFromPixel(At(0.5)), canvas->WidgetFromPixel(At(0.25)));
  running->Settle();
  EXPECT_NEAR(Compare().Wipe(), 0.25, 0.01);  // a pixel of the screen is 0.3 % of the width
  EXPECT_TRUE(ShowsTheCamera(0.4));
  Press(Qt::Key_Right);
  Press(Qt::Key_Right);
  Press(Qt::Key_Right);
  running->Settle();
  EXPECT_NEAR(Compare().Wipe(), 0.55, 0.01);
  EXPECT_FALSE(ShowsTheCamera(0.4));
}

TEST_F(DepthPaneOnScreen, AnotherMethodFillsWhatTheMaskHides) {
  // The wheel lies in the middle: all of the map is given to the other method.
  const auto is_grey = [](const QColor& color) { return color.saturation() < 60; };
  const double masked = FractionOf(DepthPixels(), is_grey);
  Compare().setWipe(0.0);
  Compare().compareWithMethod(DepthMethod::kJointBilateral);
  ASSERT_TRUE(WaitFor([] { return Compare().Second() != nullptr; }));
  running->Settle();
  EXPECT_LT(FractionOf(DepthPixels(), is_grey), masked - 0.005);
}

/// A pixel in the middle of a masked patch, so that rounding on the screen stays within it.
std::optional<Eigen::Vector2i> InsideMaskedPatch(const DepthResult& result, const MaskImage& mask) {
  constexpr int kHalf_px = 3;
  const auto is_masked = [&](int x, int y) {
    return std::isfinite(result.dense.depth_m(x, y)) && mask(x, y) == 0;
  };
  for (int y = kHalf_px; y + kHalf_px < mask.height(); ++y)
    for (int x = kHalf_px; x + kHalf_px < mask.width(); ++x) {
      bool all = true;
      for (int dy = -kHalf_px; dy <= kHalf_px && all; ++dy)
        for (int dx = -kHalf_px; dx <= kHalf_px && all; ++dx) all = is_masked(x + dx, y + dy);
      if (all) return Eigen::Vector2i(x, y);
    }
  return std::nullopt;
}

TEST_F(DepthPaneOnScreen, PointingAtAMaskedPixelSaysWhy) {
  const SessionModel& session = running->bench().live.session;
  const auto pixel = InsideMaskedPatch(*session.Depth(), *session.Mask());
  ASSERT_TRUE(pixel);
  SendMouse(Pane()->Canvas(), QEvent::MouseMove,
            Pane()->Canvas()->WidgetFromPixel(pixel->cast<double>()), Qt::NoButton);
  EXPECT_TRUE(Pane()->Readout().contains("masked: below the threshold 0.35"))
      << Pane()->Readout().toStdString();
}

TEST_F(DepthPaneOnScreen, ASecondScanComesThroughWithEverythingOpen) {
  Layers().openIterations(true);
  Layers().toggleRejected();
  Compare().compareWithImage();
  running->Settle();
  const auto first = running->bench().live.session.Depth();
  EXPECT_TRUE(running->ScanWithTheMouse());
  EXPECT_NE(running->bench().live.session.Depth(), first);
  EXPECT_TRUE(ShowsTheCamera(0.6));
  Layers().openIterations(false);
}

}  // namespace
}  // namespace foresight
