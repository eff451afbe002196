// The review in the window, on pixels.
#include <gtest/gtest.h>
#include <qtadvanceddocking/DockWidget.h>

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QGuiApplication>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QScreen>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>
#include <fstream>

#include "app/workstation/import_files.h"
#include "app/workstation/main_window.h"
#include "core/mission/side_result.h"
#include "tests/display/mouse.h"
#include "tests/display/pixels.h"
#include "tests/review/mission_for_review.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/wait_for.h"
#include "ui/panels/import_dialog.h"
#include "ui/panels/mission_panel.h"
#include "ui/panels/mission_search_panel.h"
#include "ui/panels/side_results_panel.h"
#include "ui/panels/timeline_panel.h"
#include "ui/panels/timeline_view.h"
#include "ui/views/cloud_pane.h"
#include "ui/views/image_pane.h"

namespace foresight {
namespace {

/// One window with the mission open for review, for all tests.
struct ReviewWindow : testing::Test {
  struct Parts {
    MissionForReview mission;
    QTemporaryDir missions;
    Workbench bench{std::make_shared<FakeHead>(mission.First().rig), SessionMode::kLive};
    MainWindow window{&bench};
  };
  static std::unique_ptr<Parts> parts;

  static void SetUpTestSuite() {
    parts = std::make_unique<Parts>();
    EXPECT_TRUE(parts->bench.recording.BeginInFolder(parts->missions.path()));
    parts->window.show();
  }
  static void TearDownTestSuite() { parts.reset(); }

  void SetUp() override { ASSERT_TRUE(Show(mission().First().uuid)); }
  void TearDown() override {
    bench().replay.leave();
    bench().replay.SetSpeed(1.0);
    bench().timeline.showAll();
    if (HasFailure())
      QGuiApplication::primaryScreen()->grabWindow(0).save(
          QStringLiteral("%1/failed_review_%2.png")
              .arg(QCoreApplication::applicationDirPath(),
                   testing::UnitTest::GetInstance()->current_test_info()->name()));
  }

  static Workbench& bench() { return parts->bench; }
  static MissionForReview& mission() { return parts->mission; }
  static bool Show(const std::string& scan_uuid) {
    bench().reviewer.Open(mission().Path(), scan_uuid);
    const bool shown = WaitFor([] {
      return bench().ShowsReview() && bench().timeline.Timeline() &&
             bench().review.session.Depth() && bench().tasks.Idle();
    });
    Settle();
    return shown;
  }
  static void Settle() {
    QElapsedTimer timer;
    timer.start();
    WaitFor([&] { return timer.elapsed() > 400 && bench().tasks.Idle(); });
  }
  static TimelineView* View() { return parts->window.findChild<TimelineView*>(); }
  static const TimelineEntry& EntryOf(TimelineEntry::Kind kind) {
    for (const TimelineEntry& entry : bench().timeline.Timeline()->entries)
      if (entry.kind == kind) return entry;
    throw std::runtime_error("no such entry");
  }
  template <class PaneOf>
  static PaneOf* VisiblePane() {
    for (PaneOf* pane : parts->window.findChildren<PaneOf*>())
      if (pane->isVisible()) return pane;
    return nullptr;
  }
  static QImage CloudPixels(CloudPane* pane) { return pane->Canvas()->grabFramebuffer(); }
  static QString Badge() {
    for (const QLabel* label : parts->window.findChildren<QLabel*>(QStringLiteral("badge")))
      if (label->text().startsWith(QLatin1String("RE"))) return label->text();
    return {};
  }
  static void Click(const QPoint& point) {
    SendMouse(View(), QEvent::MouseButtonPress, point, Qt::LeftButton);
    SendMouse(View(), QEvent::MouseButtonRelease, point, Qt::NoButton);
  }
  static void Turn(const QPoint& at, int steps, Qt::KeyboardModifiers modifiers = {}) {
    QWheelEvent event(at, View()->mapToGlobal(at), {}, {0, 120 * steps}, Qt::NoButton, modifiers,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(View(), &event);
  }
};

std::unique_ptr<ReviewWindow::Parts> ReviewWindow::parts;

TEST_F(ReviewWindow, TheTimelineComesWithTheReviewAndGoesWithIt) {
  ASSERT_NE(View(), nullptr);
  EXPECT_TRUE(View()->isVisible());
  bench().commands.Run("view.live");
  Settle();
  EXPECT_FALSE(View()->isVisible());
  bench().commands.Run("view.review");
  Settle();
  EXPECT_TRUE(View()->isVisible());
}

TEST_F(ReviewWindow, EachLaneIsNamedAndMarksHaveMoreThanAColour) {
  const QImage lanes = View()->grab().toImage();
  // The names' column: bright words on the dark ground, in each lane.
  const int each = (lanes.height() - 22) / kTimelineLanes;
  for (int lane = 0; lane < kTimelineLanes; ++lane) {
    const QImage name = lanes.copy(0, 22 + lane * std::min(each, 24), 104, std::min(each, 24));
    EXPECT_GT(FractionOf(name, [](const QColor& color) { return color.lightness() > 120; }), 0.02)
        << "lane " << lane;
  }
  // A mark holds the dark strokes of its icon on its own colour.
  const QPoint valve = View()->PointOf(EntryOf(TimelineEntry::Kind::kAccepted));
  ASSERT_GT(valve.x(), 0);
  const QImage mark = lanes.copy(valve.x() - 8, valve.y() - 6, 16, 12);
  EXPECT_GT(FractionOf(mark, IsColoured), 0.2);
  EXPECT_GT(FractionOf(mark, [](const QColor& color) { return color.lightness() < 60; }), 0.05);
}

TEST_F(ReviewWindow, HoveringTellsWhatAMarkIs) {
  const QString valve = View()->TextAt(View()->PointOf(EntryOf(TimelineEntry::Kind::kFound)));
  EXPECT_TRUE(valve.startsWith(QStringLiteral("valve in scan 1, found by anna")))
      << valve.toStdString();
  const QString scan = View()->TextAt(View()->PointOf(EntryOf(TimelineEntry::Kind::kScan)));
  EXPECT_TRUE(scan.contains(QStringLiteral("80 lines"))) << scan.toStdString();
  EXPECT_TRUE(View()->TextAt({300, 4}).isEmpty());
}

TEST_F(ReviewWindow, AClickOnAMarkGoesToItsScanAndItsObject) {
  ASSERT_TRUE(Show(mission().Second().uuid));
  Click(View()->PointOf(EntryOf(TimelineEntry::Kind::kFound)));
  ASSERT_TRUE(WaitFor([] { return bench().reviewer.ScanIndex() == 0; }));
  Settle();
  ASSERT_NE(bench().review.session.Selected(), nullptr);
  EXPECT_EQ(bench().review.session.Selected()->uuid, MissionForReview::kValve);
  EXPECT_FALSE(bench().replay.Active()) << "all of the scan is shown";
}

TEST_F(ReviewWindow, TheWheelZoomsAtTheMouseAndDraggingPans) {
  const TimelineAxis& axis = bench().timeline.Axis();
  const QPoint at(View()->width() / 2, 60);
  const std::int64_t span = axis.End() - axis.Begin();
  Turn(at, 8);
  EXPECT_LT(axis.End() - axis.Begin(), span / 4);
  const std::int64_t begin = axis.Begin();
  const QPoint from(View()->width() - 40, 22 + 5);
  Drag(View(), from, from - QPoint(100, 0));
  EXPECT_GT(axis.Begin(), begin) << "dragged to the left: later times";
  Turn(at, 2, Qt::ShiftModifier);
  EXPECT_LT(axis.Begin(), begin + (axis.End() - axis.Begin()));
  QTest::keyClick(View(), Qt::Key_Minus);
  bench().commands.Run("review.zoom_all");
  EXPECT_TRUE(axis.ShowsAll());
}

TEST_F(ReviewWindow, ScrubbingOnTheRulerTakesPointsFromTheCloudAndTheBadgeSaysReplay) {
  EXPECT_TRUE(Badge().startsWith(QLatin1String("REVIEW"))) << Badge().toStdString();
  CloudPane* cloud = VisiblePane<CloudPane>();
  ASSERT_NE(cloud, nullptr);
  const std::size_t all = cloud->PointCount();
  ASSERT_GT(all, 1000u);
  ASSERT_TRUE(WaitFor([&] { return FractionOf(CloudPixels(cloud), IsColoured) > 0.01; }));
  const QImage whole = CloudPixels(cloud);
  bench().timeline.ShowSpan(mission().FirstBegin(), mission().FirstEnd());
  const auto ruler = [](double seconds) {
    return View()->PointOnRuler(mission().FirstBegin() + static_cast<std::int64_t>(1e9 * seconds));
  };
  Drag(View(), ruler(1.9), ruler(0.5));
  Settle();
  EXPECT_TRUE(Badge().startsWith(QLatin1String("REPLAY"))) << Badge().toStdString();
  EXPECT_NEAR(static_cast<double>(cloud->PointCount()) / static_cast<double>(all), 0.25, 0.06);
  EXPECT_GT(FractionOfChanges(whole, CloudPixels(cloud)), 0.001) << "a narrow strip of the view";
  ImagePane* image = VisiblePane<ImagePane>();
  EXPECT_TRUE(image->HintShown()) << "the image had not been taken";
  Drag(View(), ruler(0.5), ruler(1.3));
  Settle();
  EXPECT_FALSE(image->HintShown());
  bench().commands.Run("review.whole");
  Settle();
  EXPECT_EQ(cloud->PointCount(), all);
  EXPECT_TRUE(Badge().startsWith(QLatin1String("REVIEW")));
  EXPECT_TRUE(WaitFor([&] { return FractionOfChanges(whole, CloudPixels(cloud)) < 0.0002; }))
      << "the canvas may be drawn a moment later";
}

TEST_F(ReviewWindow, TheKeyPlaysAndTheCloudGrows) {
  QApplication::setActiveWindow(&parts->window);
  CloudPane* cloud = VisiblePane<CloudPane>();
  cloud->Canvas()->setFocus();
  bench().replay.SetSpeed(ReplayModel::kSlowest);
  QTest::keyClick(cloud->Canvas(), Qt::Key_P);
  ASSERT_TRUE(bench().replay.Playing());
  ASSERT_TRUE(WaitFor([&] { return bench().review.session.Part().lines > 10; }));
  const int lines = bench().review.session.Part().lines;
  ASSERT_TRUE(WaitFor([&] { return bench().review.session.Part().lines > lines + 10; }));
  QTest::keyClick(cloud->Canvas(), Qt::Key_P);
  EXPECT_FALSE(bench().replay.Playing());
  EXPECT_TRUE(bench().replay.Active());
}

TEST_F(ReviewWindow, SeveralMissionsAreListedWithTheirScansAndOneIsClosed) {
  OpenMissions* list = parts->window.Mission()->Reviewed();
  EXPECT_EQ(list->MissionCount(), 1);
  const QString other = mission().MakeAnother(QStringLiteral("other.foresight"));
  bench().reviewer.Open(other);
  ASSERT_TRUE(WaitFor([] { return bench().reviewer.Missions().size() == 2u; }));
  Settle();
  EXPECT_EQ(list->MissionCount(), 2);
  EXPECT_EQ(list->ScanCount(0), 2);
  EXPECT_TRUE(list->TextOf(1).startsWith(QStringLiteral("other.foresight")));
  EXPECT_TRUE(list->TextOf(0, 1).contains(QStringLiteral("80 lines")));
  // A click on a scan of the first one shows it.
  list->scrollToTop();
  const QRect row = list->RectOf(0, 0);
  SendMouse(list->viewport(), QEvent::MouseButtonPress, row.center(), Qt::LeftButton);
  SendMouse(list->viewport(), QEvent::MouseButtonRelease, row.center(), Qt::NoButton);
  ASSERT_TRUE(WaitFor([] { return bench().reviewer.Path() == mission().Path(); }));
  bench().reviewer.CloseMission(1);
  EXPECT_EQ(list->MissionCount(), 1);
  EXPECT_EQ(list->ScanCount(0), 2);
  QFile::remove(other);
}

TEST_F(ReviewWindow, AClickOnWhatTheSearchFoundOpensItThere) {
  ASSERT_TRUE(Show(mission().Second().uuid));
  bench().search.SetFolder(mission().Folder());
  bench().commands.Run("view.search");
  MissionSearchPanel* panel = parts->window.Search();
  ASSERT_TRUE(panel->isVisible());
  EXPECT_TRUE(
      WaitFor([&] { return panel->Words()->hasFocus() || !panel->window()->isActiveWindow(); }));
  QTest::keyClicks(panel->Words(), QStringLiteral("accepted"));
  ASSERT_TRUE(WaitFor([&] { return panel->Found()->count() == 1; }));
  EXPECT_TRUE(panel->SummaryText().startsWith(QStringLiteral("1 found")));
  const QRect row = panel->Found()->visualItemRect(panel->Found()->item(0));
  SendMouse(panel->Found()->viewport(), QEvent::MouseButtonPress, row.center(), Qt::LeftButton);
  SendMouse(panel->Found()->viewport(), QEvent::MouseButtonRelease, row.center(), Qt::NoButton);
  ASSERT_TRUE(WaitFor([] { return bench().reviewer.ScanIndex() == 0; }));
  Settle();
  EXPECT_EQ(bench().review.session.CurrentScan()->uuid, mission().First().uuid);
  parts->window.ResetLayout();
  Settle();
}

TEST_F(ReviewWindow, TheSheetOfShortcutsFitsTheScreenAndListsTheKeysOfTheReplay) {
  bench().commands.Run("help.shortcuts");
  Settle();
  auto* sheet = parts->window.findChild<QDialog*>(QStringLiteral("shortcut_sheet"));
  ASSERT_NE(sheet, nullptr);
  EXPECT_LE(sheet->height(), QGuiApplication::primaryScreen()->availableGeometry().height());
  EXPECT_GT(sheet->width(), 500) << "whole sentences";
  QStringList rows;
  for (const QLabel* label : sheet->findChildren<QLabel*>()) rows << label->text();
  EXPECT_TRUE(rows.contains(QStringLiteral("Play or pause")));
  EXPECT_TRUE(rows.contains(QStringLiteral("P")));
  delete sheet;
}

TEST_F(ReviewWindow, WithTheTimelineTheWindowFitsAScreenThatIsNotLow) {
  EXPECT_LE(parts->window.minimumSizeHint().width(), 960);
  EXPECT_LE(parts->window.minimumSizeHint().height(), 800) << "on a lower one it is a tab";
}

TEST_F(ReviewWindow, HowFilesAreImportedIsAskedAndRememberedForTheirKind) {
  const QTemporaryDir folder;
  const QString file = folder.filePath("wall.xyz");
  {
    std::ofstream text(file.toStdString());
    for (int row = 0; row < 20; ++row)
      for (int column = 0; column < 30; ++column)
        text << "3000 " << 50 * column - 750 << ' ' << 50 * row - 500 << '\n';
  }
  const auto ask = [&]() -> ImportDialog* {
    AskHowToImport(&parts->window, &bench(), {file}, folder.path());
    return parts->window.findChild<ImportDialog*>();
  };
  ImportDialog* dialog = ask();
  ASSERT_NE(dialog, nullptr);
  EXPECT_FALSE(dialog->isModal());
  EXPECT_EQ(dialog->Field(QStringLiteral("kitti-camera")), nullptr);
  qobject_cast<QComboBox*>(dialog->Field(QStringLiteral("unit")))->setCurrentText("mm");
  auto* viewpoint = qobject_cast<QLineEdit*>(dialog->Field(QStringLiteral("viewpoint")));
  viewpoint->setText(QStringLiteral("0,0"));
  dialog->ImportButton()->click();
  EXPECT_TRUE(dialog->isVisible()) << "a choice that cannot be keeps it open";
  EXPECT_TRUE(dialog->Fault()->text().contains("3 numbers"))
      << dialog->Fault()->text().toStdString();
  QGuiApplication::primaryScreen()
      ->grabWindow(dialog->winId())
      .save(QCoreApplication::applicationDirPath() + QStringLiteral("/seen_import_dialog.png"));
  viewpoint->setText(QStringLiteral("0,0,0"));
  dialog->ImportButton()->click();
  ASSERT_TRUE(WaitFor([&] { return bench().reviewer.Path().endsWith("wall-imported.foresight"); }));
  Settle();
  dialog = ask();
  ASSERT_NE(dialog, nullptr);
  EXPECT_EQ(dialog->Choices().value(QStringLiteral("unit")), QStringLiteral("mm"));
  EXPECT_EQ(dialog->Choices().value(QStringLiteral("viewpoint")), QStringLiteral("0,0,0"));
  dialog->reject();
  bench().reviewer.close();
  Settle();
}

TEST_F(ReviewWindow, WhatIsBegunInOneMissionIsNotShownInAnother) {
  const QString other = mission().MakeAnother(QStringLiteral("meanwhile.foresight"));
  const QTemporaryDir folder;
  bench().review.map.Make(mission().Path());
  bench().side_results.RunAgain(QStringLiteral("begun before"));
  bench().review.exporter.WriteReport(mission().Path(), {}, folder.path());
  bench().reviewer.Open(other);
  ASSERT_TRUE(WaitFor([&] { return bench().reviewer.Path() == other; }));
  Settle();
  ASSERT_TRUE(WaitFor([] { return bench().tasks.Idle(); }, 180'000));
  EXPECT_TRUE(bench().review.map.Map() == nullptr || bench().review.map.Mission() == other);
  for (const ResultRow& row : bench().side_results.Rows()) EXPECT_EQ(row.mission, other);
  const auto review = MissionFile::FindReviewOf(other.toStdString());
  ASSERT_TRUE(review);
  EXPECT_TRUE(*review == nullptr || ListSideResults(**review)->empty());
  bench().reviewer.close();
  Settle();
}

}  // namespace
}  // namespace foresight
