#pragma once

#include <gtest/gtest.h>

#include "core/pictures/detection_picture.h"
#include "tests/display/pixels.h"
#include "tests/display/running_window.h"
#include "tests/ui/wait_for.h"
#include "ui/views/cloud_pane.h"
#include "ui/views/depth_pane.h"
#include "ui/views/image_pane.h"

namespace foresight {

/// One window, scanned once for all its tests: a scan with its depth takes seconds.
struct Workstation : testing::Test {
  static std::unique_ptr<RunningWindow> running;
  static bool scanned;

  static void SetUpTestSuite();
  static void TearDownTestSuite() { running.reset(); }

  void SetUp() override { ASSERT_TRUE(scanned) << "the Scan button brought no depth"; }
  void TearDown() override;

  static QImage DepthPixels() { return running->window().Depth()->Canvas()->grabFramebuffer(); }
  static QImage CloudPixels() { return running->window().Cloud()->Canvas()->grabFramebuffer(); }
  static QImage ImagePixels() { return running->window().Image()->Canvas()->grab().toImage(); }
  /// Of the outlines of objects that are more than UNSURE.
  static double OutlineFraction(const QImage& image) {
    return FractionOf(image, [](const QColor& color) {
      return IsNear(color, ColorOf(VerdictLevel::kConfirmed)) ||
             IsNear(color, ColorOf(VerdictLevel::kLikely));
    });
  }
  /// Waits for a fit after a region was drawn; false when it found no valve.
  static bool WaitForObject(std::size_t count) {
    const bool found =
        WaitFor([&] { return running->bench().live.session.Objects().size() >= count; });
    running->Settle();
    return found;
  }
};

}  // namespace foresight
