// Full HD at 200 %: 960 x 540 as the window counts. Run on such a screen of its own
// (CMakeLists.txt).
#include <gtest/gtest.h>
#include <qtadvanceddocking/DockManager.h>
#include <qtadvanceddocking/DockWidget.h>

#include <QGuiApplication>
#include <QPushButton>
#include <QScreen>

#include "tests/display/running_window.h"

namespace foresight {
namespace {

/// What docks ask for, for a failure's message.
std::string SizesOfDocks(const QWidget& window) {
  std::string text;
  for (const auto* dock : window.findChildren<ads::CDockWidget*>())
    text += dock->objectName().toStdString() + " " +
            std::to_string(dock->minimumSizeHint().width()) + " x " +
            std::to_string(dock->minimumSizeHint().height()) + ", ";
  return text;
}

TEST(LowScreen, TheWindowFitsAndNeitherStopNorScanIsCut) {
  const QRect screen = QGuiApplication::primaryScreen()->geometry();
  ASSERT_EQ(screen.size(), QSize(960, 540)) << "the test was started on another screen";
  RunningWindow running;
  ASSERT_TRUE(running.ScanWithTheMouse());  // the panes need more room then
  MainWindow& window = running.window();
  EXPECT_TRUE(window.isMaximized()) << "its title would push the lowest line off the screen";
  EXPECT_TRUE(screen.contains(window.geometry()))
      << window.width() << " x " << window.height() << "; docks ask for " << SizesOfDocks(window);
  for (const char* name : {"stopButton", "scanButton"}) {
    const auto* button = window.findChild<QPushButton*>(QString::fromLatin1(name));
    ASSERT_NE(button, nullptr) << name;
    const QRect seen = button->visibleRegion().boundingRect();
    EXPECT_EQ(seen, button->rect())
        << name << ": " << seen.width() << " of " << button->width() << " wide is in sight";
    EXPECT_GE(button->width(), button->minimumSizeHint().width()) << name;
    const QRect place(button->mapToGlobal(QPoint(0, 0)), button->size());
    EXPECT_TRUE(screen.contains(place)) << name;
  }
}

}  // namespace
}  // namespace foresight
