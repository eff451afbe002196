#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QHelpEvent>
#include <QLabel>

#include "tests/display/paint_counter.h"
#include "tests/ui/linked_head.h"
#include "ui/panels/device_lamps.h"
#include "ui/panels/head_device_rows.h"
#include "ui/panels/head_strip.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {
namespace {

struct DeviceLampsOnScreen : testing::Test {
  DeviceLampsOnScreen() {
    head->SetHealth(AllWell());
    model.Poll();
    lamps.show();
  }

  static HeadHealth AllWell() {
    HeadHealth health;
    health.lidar.connected = health.camera.connected = health.motor.connected = true;
    health.lidar.line_rate_hz = 40.0;
    health.motor.poll_rate_hz = 240.0;
    return health;
  }

  std::vector<std::string> Words() const {
    std::vector<std::string> words;
    for (const QLabel* label : lamps.findChildren<QLabel*>())
      if (!label->text().isEmpty()) words.push_back(label->text().toStdString());
    return words;
  }

  QColor BrightestOf(int sign) const {
    const QImage image =
        lamps.findChildren<QLabel*>(QStringLiteral("deviceLamp"))[sign]->grab().toImage();
    QColor brightest = Qt::black;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (image.pixelColor(x, y).value() > brightest.value()) brightest = image.pixelColor(x, y);
    return brightest;
  }

  std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>(DefaultSensorRig());
  HeadViewModel model{head};
  DeviceLamps lamps{&model};
};

TEST_F(DeviceLampsOnScreen, NameTheDevicesAndNothingElseWhileAllIsWell) {
  EXPECT_EQ(Words(), (std::vector<std::string>{"Lidar", "Camera", "Motor"}));
}

TEST(DeviceLampsOverALink, HaveALampForTheLinkThatSaysWhenItIsLost) {
  const auto head = std::make_shared<LinkedHead>(DefaultSensorRig());
  head->link.health.connected = head->link.health.has_control = true;
  head->link.health.address = "robot:47130";
  head->SetHealth(DeviceLampsOnScreen::AllWell());
  HeadViewModel model{head};
  model.Poll();
  DeviceLamps lamps{&model};
  HeadDeviceRows rows{&model};
  const auto texts = [](const QWidget& widget) {
    std::string all;
    for (const QLabel* label : widget.findChildren<QLabel*>())
      all += label->text().toStdString() + "|";
    return all;
  };
  EXPECT_NE(texts(lamps).find("|Motor||Link|"), std::string::npos) << texts(lamps);
  EXPECT_NE(texts(rows).find("Link: well"), std::string::npos) << texts(rows);
  head->link.health.connected = false;
  head->link.health.age_s = 12.3;
  model.Poll();
  EXPECT_NE(texts(lamps).find("Link: lost"), std::string::npos) << texts(lamps);
  EXPECT_NE(texts(rows).find("Motor: not known"), std::string::npos) << texts(rows);
}

TEST_F(DeviceLampsOnScreen, SayInWordsWhichDeviceIsMissing) {
  HeadHealth health = AllWell();
  health.camera.connected = false;
  health.camera.last_error = "camera 10.0.0.3: does not answer";
  head->SetHealth(health);
  model.Poll();
  EXPECT_EQ(Words(), (std::vector<std::string>{"Lidar", "Camera: missing", "Motor"}));
  const QString why = lamps.findChildren<QLabel*>(QStringLiteral("deviceLamp"))[1]->toolTip();
  EXPECT_TRUE(why.contains(QStringLiteral("does not answer"))) << why.toStdString();
}

TEST_F(DeviceLampsOnScreen, NumbersThatChangeAllTheTimeDrawNothing) {
  HeadDeviceRows rows(&model);
  rows.show();
  ASSERT_TRUE(WaitUntilDrawn(lamps) && WaitUntilDrawn(rows));
  const PaintCounter counter;
  for (int poll = 0; poll < 5; ++poll) {
    HeadHealth health = AllWell();
    health.motor.round_trip_median_s = 1e-4 * poll;  // as a drive's does from poll to poll
    head->SetHealth(health);
    model.Poll();
    QCoreApplication::processEvents();
  }
  EXPECT_EQ(counter.Paints(), 0) << counter.Widgets();
}

TEST(HeadStripOverALink, ShowsTheHeadsMessageAlsoWhileTheLinkIsLost) {
  const auto head = std::make_shared<LinkedHead>(DefaultSensorRig());
  HeadViewModel model(head);
  CommandTable commands;
  for (const char* id : {"view.live", "head.release", "head.stop"})
    commands.Add({.id = id, .text = QString::fromLatin1(id), .run = [] {}});
  HeadStrip strip(&model, &commands);
  strip.resize(2400, strip.sizeHint().height());
  strip.show();
  head->link.health.connected = false;
  head->SetFault("whether it runs shows when the link is back");
  model.Poll();
  QCoreApplication::processEvents();
  const auto* message = strip.findChild<QuietLabel*>();
  EXPECT_TRUE(message->isVisible());
  EXPECT_EQ(message->Text().toStdString(), "whether it runs shows when the link is back");
}

TEST_F(DeviceLampsOnScreen, AHeadThatIsNotConnectedHasNoAngle) {
  CommandTable commands;
  for (const char* id : {"view.live", "head.release", "head.stop"})
    commands.Add({.id = id, .text = QString::fromLatin1(id), .run = [] {}});
  HeadStrip strip(&model, &commands);
  const auto shown = [&](const char* what) {
    for (const QLabel* label : strip.findChildren<QLabel*>())
      if (label->text().startsWith(QLatin1String(what))) return label->text().toStdString();
    return std::string();
  };
  model.Poll();
  EXPECT_EQ(shown("Angle"), "Angle 0.00°");
  head->SetState(HeadState::kDisconnected);
  model.Poll();
  EXPECT_EQ(shown("Angle"), "Angle –") << "nobody has read it";
  EXPECT_EQ(shown("Speed"), "Speed –");
}

TEST_F(DeviceLampsOnScreen, ALongMessageOfTheHeadMakesTheStripNoHigher) {
  CommandTable commands;
  for (const char* id : {"view.live", "head.release", "head.stop"})
    commands.Add({.id = id, .text = QString::fromLatin1(id), .run = [] {}});
  HeadStrip strip(&model, &commands);
  strip.resize(1100, strip.sizeHint().height());
  strip.show();
  QCoreApplication::processEvents();
  const int before = strip.sizeHint().height();
  head->SetFault(
      "motor 10.0.0.2:502: connection lost (Connection reset by peer); the motor was told to stop. "
      "See that it stands, check the device's power and cable, then home the head");
  model.Poll();
  QCoreApplication::processEvents();
  EXPECT_EQ(strip.sizeHint().height(), before) << "the panes below would move";
  const auto* message = strip.findChild<QuietLabel*>();
  ASSERT_TRUE(message->isVisible());
  EXPECT_TRUE(message->toolTip().contains(QStringLiteral("then home the head")));
}

TEST_F(DeviceLampsOnScreen, ALampIsBrightEnoughToBeSeen) {
  for (int sign = 0; sign < 3; ++sign) EXPECT_GT(BrightestOf(sign).value(), 150) << sign;
}

TEST_F(DeviceLampsOnScreen, TheTipOfTheDevicesRowsSaysWhichRigIsInForce) {
  HeadDeviceRows rows(&model);
  rows.show();
  // As Qt asks for it: at the label under the mouse, which hands it on.
  QLabel* camera = rows.findChildren<QLabel*>()[4];
  const QPoint middle = camera->rect().center();
  QHelpEvent ask(QEvent::ToolTip, middle, camera->mapToGlobal(middle));
  QCoreApplication::sendEvent(camera, &ask);
  EXPECT_EQ(rows.toolTip(), model.RigText());
  EXPECT_TRUE(rows.toolTip().contains(QStringLiteral("fisheye with k")));
}

}  // namespace
}  // namespace foresight
