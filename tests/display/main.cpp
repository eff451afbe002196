#include <gtest/gtest.h>

#include <QApplication>

#include "ui/panels/theme.h"
#include "ui/views/vtk_setup.h"

int main(int argc, char** argv) {
  foresight::SetUpVtk();  // before the QApplication
  QApplication::setHighDpiScaleFactorRoundingPolicy(Qt::HighDpiScaleFactorRoundingPolicy::Round);
  QApplication application(argc, argv);
  foresight::ApplyTheme(&application);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
