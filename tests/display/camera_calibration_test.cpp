#include <gtest/gtest.h>
#include <qtadvanceddocking/DockWidget.h>

#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>

#include "tests/display/mouse.h"
#include "tests/display/pixels.h"
#include "tests/display/running_window.h"
#include "tests/ui/board_pictures.h"
#include "tests/ui/wait_for.h"
#include "ui/panels/calibration_plots.h"
#include "ui/panels/camera_calibration_panel.h"

namespace foresight {
namespace {

constexpr int kCameraWizardLimit_ms =
    180'000;  // eight images are read and solved on a machine that is busy

struct CalibrationDock : testing::Test {
  QTemporaryDir folder;
  bool kept_in_folder = qputenv("XDG_DATA_HOME", folder.path().toUtf8());
  RunningWindow running{DefaultSensorRig()};
  CameraCalibrationModel& model = running.bench().camera_calibration;
  CameraCalibrationPanel* panel = running.window().Calibration();

  ~CalibrationDock() override { qunsetenv("XDG_DATA_HOME"); }

  template <class T>
  T* Find(const char* name) {
    return panel->findChild<T*>(QString::fromLatin1(name));
  }
  static double GreenFraction(QWidget* map) {
    return FractionOf(map->grab().toImage(), [](const QColor& color) {
      return color.green() > color.red() + 30 && color.green() > color.blue();
    });
  }
};

TEST_F(CalibrationDock, GoesFromImagesToAVerdictWhileTheHeadIsFree) {
  ASSERT_NE(panel, nullptr);
  EXPECT_FALSE(panel->isVisible()) << "closed until it is asked for";
  ASSERT_TRUE(running.bench().commands.Run("view.calibrate_camera"));
  running.Settle();
  ASSERT_TRUE(panel->isVisible());
  EXPECT_FALSE(Find<QPushButton>("saveRig")->isEnabled());
  EXPECT_LT(GreenFraction(panel->Map()), 0.01);

  const QString pictures = folder.filePath("pictures");
  ASSERT_TRUE(model.SetBoard(WriteBoardPictures(pictures, 8)));
  model.AddFiles({pictures});
  ASSERT_TRUE(WaitFor([&] { return model.Calibration() && !model.Busy(); }, kCameraWizardLimit_ms))
      << model.StateText().toStdString();
  running.Settle();
  EXPECT_EQ(model.UsedCount(), 8);
  EXPECT_EQ(panel->findChild<QListWidget*>()->count(), 8);
  EXPECT_EQ(panel->findChild<QTableWidget*>()->rowCount(), 3);
  EXPECT_FALSE(Find<QLabel>("calibrationVerdict")->text().isEmpty());
  EXPECT_TRUE(Find<QLabel>("nextHint")->text().startsWith("next: "));
  EXPECT_GT(GreenFraction(panel->Map()), 0.2) << "boards were everywhere";
  EXPECT_FALSE(model.WhyNotSaveRig().isEmpty()) << "the images are smaller than the head's";
  EXPECT_FALSE(Find<QPushButton>("saveRig")->isEnabled());

  auto* list = panel->findChild<QListWidget*>();
  list->item(0)->setCheckState(Qt::Unchecked);
  EXPECT_EQ(model.Images()[0].state, CalibrationImageRow::State::kExcluded);
  ASSERT_TRUE(WaitFor([&] { return !model.Busy(); }, kCameraWizardLimit_ms));
  EXPECT_EQ(model.UsedCount(), 7);

  EXPECT_TRUE(running.bench().head.CanScan()) << running.bench().head.WhyNoScan().toStdString();
  auto* stop = running.window().findChild<QPushButton*>(QStringLiteral("stopButton"));
  ASSERT_NE(stop, nullptr);
  EXPECT_TRUE(stop->isVisible() && stop->isEnabled());
  Click(stop);
  EXPECT_TRUE(running.bench().head.StopLatched());
}

}  // namespace
}  // namespace foresight
