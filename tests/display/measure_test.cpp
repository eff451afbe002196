#include <gtest/gtest.h>

#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QTest>

#include "tests/display/mouse.h"
#include "tests/display/workstation_fixture.h"
#include "ui/panels/map_panel.h"
#include "ui/panels/notes_panel.h"

namespace foresight {
namespace {

constexpr Rgb8 kYellow = {240, 228, 66};

SessionModel& Session() {
  return Workstation::running->bench().live.session;
}

CloudCanvas* Cloud() {
  return Workstation::running->window().Cloud()->Canvas();
}

Eigen::Vector3d ReturnInRobot(int line, int beam) {
  const RegisteredScan& cloud = *Session().Cloud();
  return Session().Rig().robot_from_base * cloud.points[cloud.Index(line, beam)].cast<double>();
}

void ClickAt(QWidget* widget, const QPoint& position) {
  SendMouse(widget, QEvent::MouseButtonPress, position, Qt::LeftButton);
  SendMouse(widget, QEvent::MouseButtonRelease, position, Qt::NoButton);
}

double Yellow(const QImage& image) {
  return FractionOf(image, [](const QColor& color) { return IsNear(color, kYellow); });
}

/// Two returns a hand's breadth apart near the middle of the cloud as it is looked at.
std::pair<Eigen::Vector3d, Eigen::Vector3d> TwoPlaces() {
  const RegisteredScan& cloud = *Session().Cloud();
  const int line = cloud.lines / 2;
  const auto from = [&](int beam) {
    while (!cloud.Valid(line, beam)) ++beam;
    return ReturnInRobot(line, beam);
  };
  return {from(515), from(565)};
}

struct MeasureCleanUp {
  ~MeasureCleanUp() {
    Workbench& bench = Workstation::running->bench();
    bench.live.measure.leave();
    Session().Notes()->Show({});
    bench.live.clip.setOn(false);
    bench.live.map.clear();
    Workstation::running->window().ResetLayout();
    Workstation::running->Settle();
  }
};

/// The review has a panel of each kind of its own.
template <class Panel>
Panel* PanelInSight() {
  for (Panel* panel : Workstation::running->window().findChildren<Panel*>())
    if (panel->isVisible()) return panel;
  return nullptr;
}

TEST_F(Workstation, TwoClicksInTheCloudAreADistanceWithItsLabel) {
  const MeasureCleanUp clean_up;
  Cloud()->ResetView();
  running->Settle();
  const QImage before = CloudPixels();
  ASSERT_TRUE(running->bench().commands.Run("measure.tool"));
  const auto [a, b] = TwoPlaces();
  ClickAt(Cloud(), Cloud()->WidgetFromRobot(a));
  EXPECT_EQ(running->bench().live.measure.Points().size(), 1u);
  ClickAt(Cloud(), Cloud()->WidgetFromRobot(b));
  running->Settle();
  ASSERT_EQ(Session().Notes()->All().size(), 1u);
  const Measurement& measured = Session().Notes()->All()[0].measurement.value();
  EXPECT_NEAR(measured.value, (a - b).norm(), 0.03);
  EXPECT_GE(measured.points[0].beam, 0) << "a return, not a place in between";
  EXPECT_GT(FractionOfChanges(before, CloudPixels()), 0.001) << "line and label are drawn";
  running->bench().live.session.Undo()->undo();
  running->Settle();
  EXPECT_TRUE(Session().Notes()->All().empty());
  EXPECT_LT(FractionOfChanges(before, CloudPixels()), 0.0005);
}

TEST_F(Workstation, AClickInTheDepthMapIsAPointAndIsDrawnInAllPanes) {
  const MeasureCleanUp clean_up;
  const double in_image = Yellow(ImagePixels());
  running->bench().live.measure.SetKind(MeasureKind::kPoint);
  const auto [low, high] = running->AroundValve();
  // Beside the valve, where the wall is.
  const Eigen::Vector2d pixel(low.x() - 60.0, 0.5 * (low.y() + high.y()));
  DepthCanvas* depth = running->window().Depth()->Canvas();
  ClickAt(depth, depth->WidgetFromPixel(pixel));
  running->Settle();
  ASSERT_EQ(Session().Notes()->All().size(), 1u);
  const MeasuredPoint& point = Session().Notes()->All()[0].measurement->points[0];
  EXPECT_EQ(point.source, MeasuredPoint::Source::kDepth);
  EXPECT_LT((point.pixel - pixel).norm(), 3.0);
  EXPECT_GT(Yellow(ImagePixels()), in_image);
}

TEST_F(Workstation, ChoosingAMeasurementInTheListTurnsTheCloudAboutIt) {
  const MeasureCleanUp clean_up;
  running->bench().live.measure.SetKind(MeasureKind::kPoint);
  const Eigen::Vector3d place = TwoPlaces().first;
  ClickAt(Cloud(), Cloud()->WidgetFromRobot(place));
  ASSERT_EQ(Session().Notes()->All().size(), 1u);
  Cloud()->ResetView();
  ASSERT_TRUE(running->bench().commands.Run("view.notes"));
  auto* panel = PanelInSight<NotesPanel>();
  ASSERT_NE(panel, nullptr);
  ASSERT_EQ(panel->List()->count(), 1);
  Q_EMIT panel->List()->itemClicked(panel->List()->item(0));
  const Eigen::Vector3d at = Session().Notes()->All()[0].measurement->points[0].position_m;
  EXPECT_LT((Cloud()->LooksAt() - at).norm(), 1e-6);
  Cloud()->ResetView();
}

TEST_F(Workstation, ANoteThatIsTypedIsListedWithItsTags) {
  const MeasureCleanUp clean_up;
  ASSERT_TRUE(running->bench().commands.Run("view.notes"));
  auto* panel = PanelInSight<NotesPanel>();
  ASSERT_NE(panel, nullptr);
  EXPECT_FALSE(panel->AddButton()->isEnabled());
  panel->Text()->setText(QStringLiteral("the rim is bent"));
  panel->Tags()->setText(QStringLiteral("#Rim"));
  ASSERT_TRUE(panel->AddButton()->isEnabled());
  panel->AddButton()->click();
  ASSERT_EQ(panel->List()->count(), 1);
  EXPECT_EQ(panel->List()->item(0)->text(), QStringLiteral("the rim is bent #rim"));
  EXPECT_EQ(Session().Notes()->All()[0].record.scan_uuid, Session().CurrentScan()->uuid);
}

TEST_F(Workstation, TheClipBoxHidesWhatIsOutsideUntilItIsSwitchedOff) {
  const MeasureCleanUp clean_up;
  Cloud()->ResetView();
  running->Settle();
  const double whole = FractionOf(CloudPixels(), IsColoured);
  ASSERT_TRUE(running->bench().commands.Run("view.clip_box"));
  const Eigen::Vector3d valve = running->ValveInRobot();
  ClipBoxModel& clip = running->bench().live.clip;
  clip.SetBox({valve - Eigen::Vector3d::Constant(0.25), valve + Eigen::Vector3d::Constant(0.25)});
  running->Settle();
  EXPECT_LT(FractionOf(CloudPixels(), IsColoured), 0.6 * whole);
  // A handle is dragged: its side follows, the others stay.
  const Eigen::Vector3d handle = Cloud()->Clip().HandleAt(5);
  const QPoint from = Cloud()->WidgetFromRobot(handle);
  const QPoint to = Cloud()->WidgetFromRobot(handle + Eigen::Vector3d(0.0, 0.0, 0.2));
  Drag(Cloud(), from, to);
  running->Settle();
  EXPECT_NEAR(clip.Box()->max().z(), valve.z() + 0.45, 0.05);
  EXPECT_NEAR(clip.Box()->min().z(), valve.z() - 0.25, 1e-9);
  ASSERT_TRUE(running->bench().commands.Run("view.clip_box"));
  running->Settle();
  EXPECT_NEAR(FractionOf(CloudPixels(), IsColoured), whole, 0.01);
}

/// Makes the map of all scans and waits until the cloud shows it.
bool ShowMap() {
  if (!Workstation::running->bench().commands.Run("map.make")) return false;
  CloudPane* pane = Workstation::running->window().Cloud();
  const bool shown = WaitFor([pane] {
    return !Workstation::running->bench().live.map.Busy() &&
           pane->Caption().contains(QStringLiteral("map frame"));
  });
  Workstation::running->Settle();
  return shown;
}

TEST_F(Workstation, TwoClicksInAMapAreADistanceThatIsDrawnWhileTheMapIsShown) {
  const MeasureCleanUp clean_up;
  Cloud()->ResetView();
  running->Settle();
  const auto [a, b] = TwoPlaces();  // the first scan is the map's frame
  const QImage scan_alone = CloudPixels();
  ASSERT_TRUE(ShowMap());
  const QImage before = CloudPixels();
  ASSERT_TRUE(running->bench().commands.Run("measure.distance"));
  ClickAt(Cloud(), Cloud()->WidgetFromRobot(a));
  ASSERT_EQ(running->bench().live.measure.Points().size(), 1u);
  ClickAt(Cloud(), Cloud()->WidgetFromRobot(b));
  running->Settle();
  ASSERT_EQ(Session().Notes()->All().size(), 1u);
  const ShownNote& note = Session().Notes()->All()[0];
  EXPECT_EQ(note.measurement->frame, MeasureFrame::kMap);
  EXPECT_EQ(note.record.scan_uuid, "") << "it is of the mission";
  EXPECT_NEAR(note.measurement->value, (a - b).norm(), 0.03);
  EXPECT_GT(FractionOfChanges(before, CloudPixels()), 0.001) << "line and label are drawn";
  running->bench().live.measure.leave();
  // Of the scan alone they are no part.
  running->bench().live.map.clear();
  CloudPane* pane = running->window().Cloud();
  ASSERT_TRUE(WaitFor([pane] { return pane->Caption().contains(QStringLiteral("robot frame")); }));
  running->Settle();
  EXPECT_LT(FractionOfChanges(scan_alone, CloudPixels()), 0.0005);
  EXPECT_EQ(Session().Notes()->All().size(), 1u);
}

TEST_F(Workstation, AMapThatGoesAwayWhileItIsPreparedGivesWayToTheScan) {
  const MeasureCleanUp clean_up;
  ASSERT_TRUE(ShowMap());
  CloudPane* pane = running->window().Cloud();
  Q_EMIT Cloud()->viewRested();  // its points are prepared anew
  running->bench().live.map.clear();
  EXPECT_TRUE(WaitFor([pane] { return pane->Caption().contains(QStringLiteral("robot frame")); }));
}

TEST_F(Workstation, AMapIsShownInTheColoursOfItsScansAndLeavesTheScanAlone) {
  const MeasureCleanUp clean_up;
  const auto of_first_scan = [](const QColor& color) { return IsNear(color, ColorOfScan(0)); };
  Cloud()->ResetView();
  running->Settle();
  const double before = FractionOf(CloudPixels(), of_first_scan);
  ASSERT_TRUE(running->bench().commands.Run("map.make"));
  ASSERT_TRUE(WaitFor([] {
    return !running->bench().live.map.Busy() && running->bench().live.map.Map() != nullptr;
  }));
  CloudPane* pane = running->window().Cloud();
  ASSERT_TRUE(WaitFor([pane] { return pane->Caption().contains(QStringLiteral("map frame")); }));
  running->Settle();
  EXPECT_GT(FractionOf(CloudPixels(), of_first_scan), before + 0.05);
  ASSERT_TRUE(running->bench().commands.Run("view.map"));
  auto* panel = PanelInSight<MapPanel>();
  ASSERT_NE(panel, nullptr);
  EXPECT_EQ(panel->Scans()->count(), static_cast<int>(running->bench().recording.Scans().size()));
  running->bench().live.map.clear();
  ASSERT_TRUE(WaitFor([pane] { return pane->Caption().contains(QStringLiteral("robot frame")); }));
  running->Settle();
  EXPECT_NEAR(FractionOf(CloudPixels(), of_first_scan), before, 0.03);
}

}  // namespace
}  // namespace foresight
