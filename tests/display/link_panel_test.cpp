#include <gtest/gtest.h>

#include <QApplication>
#include <QListWidget>
#include <QPushButton>
#include <QTest>

#include "tests/display/paint_counter.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/fake_link.h"
#include "ui/panels/link_panel.h"

namespace foresight {
namespace {

class LinkedHead final : public FakeHead {
 public:
  using FakeHead::FakeHead;
  HeadLink* Link() override { return &link; }
  FakeLink link;
};

LinkedScan ScanThatIs(LinkedScan::Place place, const std::string& id) {
  LinkedScan scan;
  scan.scan_id = id;
  scan.place = place;
  scan.begin_utc_ns = 1'700'000'000'000'000'000;
  scan.of_lines = 89;
  return scan;
}

struct LinkPanelOnScreen : testing::Test {
  LinkPanelOnScreen() {
    head->link.health.connected = head->link.health.has_control = true;
    head->link.scans = {ScanThatIs(LinkedScan::Place::kComing, "a"),
                        ScanThatIs(LinkedScan::Place::kWaiting, "b"),
                        ScanThatIs(LinkedScan::Place::kAtHead, "c")};
    model = std::make_unique<LinkViewModel>(head, nullptr);
    panel = std::make_unique<LinkPanel>(model.get());
    panel->resize(330, 600);
    panel->show();
    QCoreApplication::processEvents();
  }
  QPushButton* Button(const char* name) {
    return panel->findChild<QPushButton*>(QString::fromLatin1(name));
  }
  QListWidget* List() { return panel->findChild<QListWidget*>(QStringLiteral("linkedScans")); }

  std::shared_ptr<LinkedHead> head = std::make_shared<LinkedHead>(DefaultSensorRig());
  std::unique_ptr<LinkViewModel> model;
  std::unique_ptr<LinkPanel> panel;
};

TEST_F(LinkPanelOnScreen, ButtonsActOnTheChosenScan) {
  EXPECT_FALSE(Button("bringFirst")->isEnabled()) << "none is chosen";
  List()->setCurrentRow(1);
  QTest::mouseClick(Button("bringFirst"), Qt::LeftButton);
  EXPECT_EQ(Button("pauseScan")->text(), "Pause");
  QTest::mouseClick(Button("pauseScan"), Qt::LeftButton);
  List()->setCurrentRow(2);
  EXPECT_EQ(Button("pauseScan")->text(), "Bring");
  QTest::mouseClick(Button("pauseScan"), Qt::LeftButton);
  EXPECT_EQ(head->link.Asked(), (std::vector<std::string>{"first b", "pause b", "fetch c"}));
}

TEST_F(LinkPanelOnScreen, AScanStaysChosenWhereverItMovesTo) {
  List()->setCurrentRow(1);
  std::swap(head->link.scans[0], head->link.scans[1]);
  model->Poll();
  EXPECT_EQ(List()->currentRow(), 0);
  EXPECT_TRUE(List()->item(0)->text().contains("waiting"));
  head->link.scans[0].place = LinkedScan::Place::kHere;
  model->Poll();
  EXPECT_FALSE(Button("bringFirst")->isEnabled()) << "it is all here";
}

TEST_F(LinkPanelOnScreen, ControlCanBeTakenOnlyWhereSomebodyElseHasIt) {
  EXPECT_FALSE(Button("takeControl")->isEnabled());
  EXPECT_TRUE(Button("giveControl")->isEnabled());
  head->link.health.has_control = false;
  head->link.health.holder = "bert";
  model->Poll();
  EXPECT_TRUE(Button("takeControl")->isEnabled());
  EXPECT_FALSE(Button("giveControl")->isEnabled());
}

TEST_F(LinkPanelOnScreen, FiguresThatChangeDrawNothingElse) {
  model->Poll();
  ASSERT_TRUE(WaitUntilDrawn(*panel));
  const PaintCounter counter;
  for (int poll = 1; poll <= 5; ++poll) {
    head->link.health.down_bytes_per_s = 1e5 * poll;
    model->Poll();
    QCoreApplication::processEvents();
  }
  EXPECT_LE(counter.Paints(), 5) << counter.Widgets();
}

}  // namespace
}  // namespace foresight
