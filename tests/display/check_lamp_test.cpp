// The lamp of a scan's check of itself: in the live window, its details, and in review.
#include <gmock/gmock.h>

#include <QApplication>
#include <QLabel>
#include <QPushButton>

#include "core/geometry/angles.h"
#include "core/mission/kept_check.h"
#include "core/mission/new_records.h"
#include "core/selfcheck/rig_damage.h"
#include "core/simulation/world.h"
#include "tests/display/mouse.h"
#include "tests/display/pixels.h"
#include "tests/display/running_window.h"
#include "tests/ui/wait_for.h"
#include "ui/panels/check_lamp.h"
#include "ui/panels/scan_check_panel.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {
namespace {

using State = ScanCheckModel::State;
using testing::HasSubstr;

// Of resources/icons: well, warning.
constexpr Rgb8 kGreen{63, 207, 159}, kAmber{240, 195, 80};
constexpr int kCheckLampLimit_ms = 120'000;  // beside other tests

/// A room with many edges, scanned once for all tests.
struct CheckLampWindow : testing::Test {
  static inline std::unique_ptr<RunningWindow> running;
  static inline bool scanned = false;

  static void SetUpTestSuite() {
    Scene scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml").value();
    SimulatedHeadOptions options;
    options.speed = SimulationSpeed::kAsFastAsPossible;
    running = std::make_unique<RunningWindow>(
        std::make_shared<const World>(std::make_shared<const Scene>(std::move(scene)),
                                      DefaultSensorRig(), WorldOptions()),
        options);
    // Where the keys go must not change by a check.
    running->window().setFocus();
    scanned = running->ScanWithTheMouse();
  }
  static void TearDownTestSuite() { running.reset(); }
  void SetUp() override { ASSERT_TRUE(scanned) << "the Scan button brought no depth"; }

  static ScanCheckModel& Live() { return running->bench().live.check; }
  static ScanCheckModel& Review() { return running->bench().review.check; }
  static bool WaitForCheck(ScanCheckModel& check) {
    const bool done =
        WaitFor([&] { return check.Now() == State::kChecked && running->bench().Idle(); },
                kCheckLampLimit_ms);
    running->Settle();
    return done;
  }
  /// The lamp that is in sight.
  static CheckLamp* Lamp() {
    for (auto* lamp : running->window().findChildren<CheckLamp*>())
      if (lamp->isVisible()) return lamp;
    return nullptr;
  }
  static ScanCheckPanel* Panel() {
    for (auto* panel : running->window().findChildren<ScanCheckPanel*>())
      if (panel->isVisible()) return panel;
    return nullptr;
  }
  static double LampFraction(Rgb8 color) {
    return FractionOf(Lamp()->findChild<QLabel*>(QStringLiteral("checkSign"))->grab().toImage(),
                      [&](const QColor& pixel) { return IsNear(pixel, color); });
  }
  static std::string LampText() {
    return Lamp()->findChild<QuietLabel*>(QStringLiteral("checkSentence"))->Text().toStdString();
  }
  /// The scan on the screen once more, as another scan that is recorded.
  static std::shared_ptr<Scan> AnotherScan() {
    auto scan = std::make_shared<Scan>(*running->bench().live.session.CurrentScan());
    scan->uuid = NewUuid();
    return scan;
  }
  static void Record(const std::shared_ptr<Scan>& scan) {
    running->bench().recording.keepScan(scan);
    running->bench().live.session.SetScan(scan);
  }
  /// The scan as it was, as a head brings it home whose camera was knocked by 0.45 deg to the right
  /// since its calibration.
  static void ShowScanOfAKnockedHead() {
    const auto scan = AnotherScan();
    scan->rig = RigBefore(
        {.name = "knocked", .camera_turn_rad = {0.0, RadiansFromDegrees(-0.45), 0.0}}, scan->rig);
    Record(scan);
  }
  static void SavePicture(const char* name) {
    running->window().grab().save(QCoreApplication::applicationDirPath() +
                                  QStringLiteral("/%1.png").arg(name));
  }
};

TEST_F(CheckLampWindow, AGoodScanIsCheckedByItselfAndKeptAndTakesNoFocus) {
  QWidget* const focus = QApplication::focusWidget();
  ASSERT_TRUE(WaitForCheck(Live()));
  EXPECT_EQ(QApplication::focusWidget(), focus);
  EXPECT_EQ(Panel(), nullptr) << "nothing opens by itself";
  EXPECT_EQ(Live().Light(), CheckLight::kGood) << LampText();
  ASSERT_NE(Lamp(), nullptr);
  EXPECT_GT(LampFraction(kGreen), 0.05);
  EXPECT_LT(LampFraction(kAmber), 0.01);
  EXPECT_THAT(LampText(), HasSubstr("othing to do"));
  const auto kept = ListScanChecks(*running->bench().recording.File());
  ASSERT_TRUE(kept) << kept.error().message;
  ASSERT_EQ(kept->size(), 1u);
  EXPECT_EQ(kept->front().answer_json, Live().Check()->answer_json);
}

TEST_F(CheckLampWindow, AKnockedCameraIsAmberAndAClickSaysMoreAndTheReviewShowsIt) {
  ShowScanOfAKnockedHead();
  EXPECT_NE(Live().Now(), State::kChecked) << "the scan before does not count for this one";
  ASSERT_TRUE(WaitForCheck(Live()));
  EXPECT_EQ(Live().Light(), CheckLight::kAmber);
  EXPECT_GT(LampFraction(kAmber), 0.05);
  EXPECT_LT(LampFraction(kGreen), 0.01);
  EXPECT_THAT(LampText(), HasSubstr("mage edges lie"));
  EXPECT_THAT(LampText(), HasSubstr("check the calibration"));

  Click(Lamp());
  running->Settle();
  ASSERT_NE(Panel(), nullptr);
  EXPECT_EQ(Panel()->findChildren<QLabel*>(QStringLiteral("checkPoint")).size(),
            static_cast<int>(Live().Check()->points.size()));
  EXPECT_GT(FractionOf(Panel()->grab().toImage(),
                       [](const QColor& pixel) { return IsNear(pixel, kAmber); }),
            1e-4);
  EXPECT_THAT(Panel()->findChild<QLabel*>(QStringLiteral("checkCannotSee"))->text().toStdString(),
              HasSubstr("motor's zero"));
  SavePicture("seen_check_live");

  const std::string answer = Live().Check()->answer_json;
  running->bench().reviewer.Open(running->bench().recording.Path(),
                                 running->bench().live.session.CurrentScan()->uuid);
  ASSERT_TRUE(WaitFor([] { return running->bench().ShowsReview(); }, kCheckLampLimit_ms));
  ASSERT_TRUE(WaitForCheck(Review()));
  EXPECT_EQ(Review().Check()->answer_json, answer) << "it was kept, not made again";
  ASSERT_NE(Lamp(), nullptr);
  EXPECT_GT(LampFraction(kAmber), 0.05);
  EXPECT_THAT(LampText(), HasSubstr("check the calibration"));
  SavePicture("seen_check_review");
  running->bench().backToLive();
  running->Settle();
}

TEST_F(CheckLampWindow, TwoScansOfAHeadSpeakTogetherAndTheMissionKnowsThemWhenItIsContinued) {
  if (Live().Light() != CheckLight::kAmber) ShowScanOfAKnockedHead();
  ASSERT_TRUE(WaitForCheck(Live()));
  Record(AnotherScan());
  ASSERT_TRUE(WaitForCheck(Live()));
  ASSERT_NE(Live().Together(), nullptr);
  EXPECT_EQ(Live().Together()->scans, 2);
  EXPECT_EQ(Live().Together()->check.light, CheckLight::kAmber);
  running->bench().commands.Run("view.check");
  running->Settle();
  ASSERT_NE(Panel(), nullptr);
  const auto* together = Panel()->findChild<QWidget*>(QStringLiteral("checkTogether"));
  EXPECT_EQ(together->findChildren<QLabel*>(QStringLiteral("checkPoint")).size(), 4)
      << "camera, lidar, clocks and motor";
  SavePicture("seen_check_together");

  const int scans = Live().Together()->scans;
  const QString mission = running->bench().recording.Path();
  const auto record_into = [](const QString& path) {
    running->bench().recording.SwitchTo(path);
    return WaitFor(
        [&] { return running->bench().recording.Path() == path && running->bench().Idle(); },
        kCheckLampLimit_ms);
  };
  ASSERT_TRUE(record_into(mission + QStringLiteral(".other.foresight")));
  EXPECT_EQ(Live().Together(), nullptr) << "these scans are of the mission before";
  ASSERT_TRUE(record_into(mission));
  ASSERT_TRUE(WaitFor([] { return Live().Together() != nullptr; }, kCheckLampLimit_ms));
  EXPECT_EQ(Live().Together()->scans, scans);
}

TEST_F(CheckLampWindow, ACheckThatIsCancelledSaysSoAndCanBeMadeAgain) {
  Live().check();
  EXPECT_EQ(Live().Now(), State::kChecking);
  ASSERT_TRUE(WaitFor([] { return !running->bench().tasks.Tasks().isEmpty(); }));
  Live().cancel();
  ASSERT_TRUE(WaitFor([] { return Live().Now() != State::kChecking; }, kCheckLampLimit_ms));
  EXPECT_EQ(Live().Now(), State::kFailed);
  EXPECT_EQ(Live().Light(), CheckLight::kNotSeen);
  running->Settle();
  EXPECT_LT(LampFraction(kGreen) + LampFraction(kAmber), 0.01);
  EXPECT_THAT(LampText(), HasSubstr("cancelled"));
  running->bench().commands.Run("view.check");
  running->Settle();
  ASSERT_NE(Panel(), nullptr);
  Panel()->findChild<QPushButton*>(QStringLiteral("checkAgain"))->click();
  EXPECT_TRUE(WaitForCheck(Live()));
}

}  // namespace
}  // namespace foresight
