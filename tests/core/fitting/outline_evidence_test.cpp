#include "core/fitting/valve/outline_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/base/random.h"
#include "core/fitting/valve/valve_state.h"
#include "core/fitting/valve/valve_tracer.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

/// A camera at base's origin, and a wheel that hangs before it and is turned aside.
class OutlineOfAValve : public ::testing::Test {
 protected:
  OutlineOfAValve() {
    view_.camera = DefaultSensorRig().camera;
    valve_.model = UsualValve(0.15, 0.012, 4, 0.02);
    valve_.base_from_object = PoseFromAxis({0.05, 0.02, 1.0}, {0.4, -0.2, -1.0});
  }

  /// What the camera sees of a wheel, with noise. `without_spoke`: of the wheel, the one it lacks.
  ImageEdges ImageOf(const ValveCandidate& wheel, int without_spoke = -1) const {
    Random random(7);
    const ValveTracer tracer(wheel, ValveParts::kAll);
    ColorImage image(view_.camera.width, view_.camera.height);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto ray = view_.camera.Unproject(Eigen::Vector2d(x, y));
        bool hit = false;
        if (ray) {
          const ValveIntersection entry =
              tracer.Intersect({Eigen::Vector3d::Zero(), *ray, 0.0}, 0.0);
          hit = entry.Clearance() < 0.0 &&
                !(entry.part == ValvePart::kSpoke && entry.spoke == without_spoke);
        }
        const auto noisy = [&](int value) {
          return static_cast<std::uint8_t>(std::clamp(value + 2.0 * random.Normal(), 0.0, 255.0));
        };
        image(x, y) =
            hit ? Rgb8{noisy(180), noisy(90), noisy(60)} : Rgb8{noisy(70), noisy(90), noisy(110)};
      }
    const std::vector<Eigen::Vector3d> seen = {{-0.15, -0.15, 1.0}, {0.25, 0.2, 1.0}};
    return ImageEdges(image, view_, seen);
  }

  static ValveEvidence EvidenceOf(const ImageEdges& image, const ValveCandidate& valve) {
    ValveEvidence evidence;
    AddEvidenceOfOutline(image, valve, evidence);
    return evidence;
  }

  ImageView view_;
  ValveCandidate valve_;
};

constexpr double kClear = 0.5 * ImageEdges::kIndependentPerPixel;  // nats a pixel

TEST_F(OutlineOfAValve, OfAWheelThatIsThereShowsAllPartsAndNoMore) {
  const ValveEvidence evidence = EvidenceOf(ImageOf(valve_), valve_);
  EXPECT_GT(evidence.outline_nats_per_px, 1.5 * kClear);
  EXPECT_GT(evidence.weakest_outline_nats_per_px, kClear);
  EXPECT_LT(evidence.further_outline_nats_per_px, -kClear);
}

TEST_F(OutlineOfAValve, FindsNoSpokeThatIsMissing) {
  const ValveEvidence evidence = EvidenceOf(ImageOf(valve_, 1), valve_);
  EXPECT_GT(evidence.outline_nats_per_px, kClear) << "the rest of it is there";
  EXPECT_LT(evidence.weakest_outline_nats_per_px, -kClear);
}

TEST_F(OutlineOfAValve, ShowsASpokeThatTheWheelHasNot) {
  ValveCandidate with_two = valve_;
  with_two.model.spokes = 2;
  const ValveEvidence evidence = EvidenceOf(ImageOf(valve_), with_two);
  EXPECT_GT(evidence.weakest_outline_nats_per_px, kClear) << "two of four are spokes";
  EXPECT_GT(evidence.further_outline_nats_per_px, kClear);
}

TEST_F(OutlineOfAValve, BesideTheWheelShowsNothing) {
  ValveCandidate beside = valve_;
  beside.base_from_object = {valve_.base_from_object.rotation(),
                             valve_.base_from_object.translation() + Eigen::Vector3d(0.05, 0, 0)};
  EXPECT_LT(EvidenceOf(ImageOf(valve_), beside).outline_nats_per_px, 0.0);
}

TEST_F(OutlineOfAValve, OfALeverIsThatOfItsBar) {
  ValveCandidate lever;
  lever.model = UsualLever(0.25, 0.012);
  lever.base_from_object = PoseFromAxis({-0.05, 0.1, 1.0}, {0.2, 0.1, -1.0});
  const ValveEvidence there = EvidenceOf(ImageOf(lever), lever);
  EXPECT_GT(there.outline_nats_per_px, kClear);
  EXPECT_EQ(there.weakest_outline_nats_per_px, there.outline_nats_per_px) << "one part";
  EXPECT_EQ(there.further_outline_nats_per_px, 0.0) << "no spokes";
}

TEST_F(OutlineOfAValve, OutsideOfTheImageSaysNothing) {
  ValveCandidate behind = valve_;
  behind.base_from_object = PoseFromAxis({0.0, 0.0, -1.0}, {0.0, 0.0, 1.0});
  const ValveEvidence evidence = EvidenceOf(ImageOf(valve_), behind);
  EXPECT_EQ(evidence.outline_nats_per_px, 0.0);
  EXPECT_EQ(evidence.weakest_outline_nats_per_px, 0.0);
  EXPECT_EQ(evidence.further_outline_nats_per_px, 0.0);
}

}  // namespace
}  // namespace foresight
