#include "core/fitting/solids/image_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

/// A camera at base's origin, and a box and a bar that stand before it.
class Outlines : public ::testing::Test {
 protected:
  Outlines() {
    view_.camera = DefaultSensorRig().camera;
    SolidPart box;
    box.size_m = {0.20, 0.10, 0.08};
    SolidPart bar;
    bar.shape = SolidPart::Shape::kCylinder;
    bar.size_m = {0.04, 0.04, 0.12};
    bar.object_from_part = {Eigen::Quaterniond::Identity(), {0.03, 0.0, 0.10}};
    parts_ = {box, bar};
    seen_ = {{-0.2, -0.2, 1.2}, {0.2, 0.2, 1.2}};
  }

  static Rigid<frame::Base, frame::Object> At(double x, double y) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX())), {x, y, 1.2}};
  }

  /// What the camera sees, with noise: the solids on a ground of another colour.
  ColorImage ImageOf(const Rigid<frame::Base, frame::Object>& pose, Rgb8 solid, Rgb8 ground) const {
    Random random(7);
    const SolidTracer tracer(parts_, pose);
    ColorImage image(view_.camera.width, view_.camera.height);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto ray = view_.camera.Unproject(Eigen::Vector2d(x, y));
        const bool hit = ray && tracer.Intersect({Eigen::Vector3d::Zero(), *ray, 0.0}, 0.0).Hits();
        const auto noisy = [&](std::uint8_t value) {
          return static_cast<std::uint8_t>(std::clamp(value + 2.0 * random.Normal(), 0.0, 255.0));
        };
        const Rgb8 color = hit ? solid : ground;
        image(x, y) = {noisy(color.r), noisy(color.g), noisy(color.b)};
      }
    return image;
  }

  ImageView view_;
  std::vector<SolidPart> parts_;
  std::vector<Eigen::Vector3d> seen_;
};

TEST_F(Outlines, LieOnTheEdgesOfWhatTheyAreTheOutlineOf) {
  const ImageEdges edges(ImageOf(At(0.02, 0.01), {180, 90, 60}, {70, 90, 110}), view_, seen_);
  ASSERT_FALSE(edges.Empty());
  const OutlineSupport there = edges.SupportOf(parts_, At(0.02, 0.01));
  EXPECT_GT(there.length_px, 200.0);
  EXPECT_GT(there.NatsPerPixel(), 0.8 * ImageEdges::kIndependentPerPixel);
  // Two pixels are what a rig may be off.
  EXPECT_GT(edges.SupportOf(parts_, At(0.024, 0.01)).nats, 0.5 * there.nats);
  EXPECT_LT(edges.SupportOf(parts_, At(0.06, 0.01)).nats, 0.2 * there.nats);
  EXPECT_LT(edges.SupportOf(parts_, At(0.02, 0.06)).nats, 0.2 * there.nats);
}

TEST_F(Outlines, OfOneColourCountAsOthersDo) {
  const ImageEdges edges(ImageOf(At(0.0, 0.0), {90, 60, 120}, {90, 120, 60}), view_, seen_);
  EXPECT_GT(edges.SupportOf(parts_, At(0.0, 0.0)).NatsPerPixel(),
            0.8 * ImageEdges::kIndependentPerPixel)
      << "as bright as its ground, of another colour";
}

TEST_F(Outlines, SpeakForNoPlaceWhereNothingIsSeen) {
  const ColorImage dark(view_.camera.width, view_.camera.height);
  const ImageEdges edges(dark, view_, seen_);
  const OutlineSupport one = edges.SupportOf(parts_, At(0.0, 0.0));
  const OutlineSupport other = edges.SupportOf(parts_, At(0.05, 0.02));
  EXPECT_NEAR(one.NatsPerPixel(), other.NatsPerPixel(), 1e-9);
  EXPECT_LT(one.nats, 0.0);
}

TEST_F(Outlines, OutsideOfTheRegionOrBehindTheCameraCountNothing) {
  const ColorImage image(view_.camera.width, view_.camera.height);
  const ImageEdges edges(image, view_, seen_);
  EXPECT_EQ(edges.SupportOf(parts_, At(1.0, 0.0)).length_px, 0.0);
  const std::vector<Eigen::Vector3d> behind = {{0.0, 0.0, -1.0}};
  const ImageEdges nothing(image, view_, behind);
  EXPECT_TRUE(nothing.Empty());
  EXPECT_EQ(nothing.SupportOf(parts_, At(0.0, 0.0)).length_px, 0.0);
  EXPECT_EQ(nothing.SupportOf(parts_, At(0.0, 0.0)).NatsPerPixel(), 0.0);
}

TEST_F(Outlines, AreWhereAPartHidesAnotherOnesSurfaceFarBehindIt) {
  // Both lie on the axis of the camera: the bar's outline lies within the box's.
  parts_[1].object_from_part = {Eigen::Quaterniond::Identity(), {0.0, 0.0, -0.2}};
  const Rigid<frame::Base, frame::Object> pose(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.2});
  const ImageEdges edges(ImageOf(pose, {180, 90, 60}, {70, 90, 110}), view_, seen_);
  const double of_both = edges.SupportOf(parts_, pose).length_px;
  const double of_box = edges.SupportOf({parts_.data(), 1}, pose).length_px;
  EXPECT_GT(of_both, of_box + 40.0);
}

}  // namespace
}  // namespace foresight
