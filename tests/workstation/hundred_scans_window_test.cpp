#include <gtest/gtest.h>

#include "app/workstation/main_window.h"
#include "tests/workstation/hundred_scans.h"

namespace foresight {
namespace {

TEST(HundredScansInTheWindow, OfOneSittingLeaveItUnder800Megabytes) {
  RecordHundredScans([](Workbench* bench) {
    auto window = std::make_unique<MainWindow>(bench);
    window->show();
    return window;
  });
}

}  // namespace
}  // namespace foresight
