// Review in the window: the scan run again, A and B compared, and what foresightctl prints of both.
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMouseEvent>
#include <QPushButton>
#include <QTest>
#include <QToolButton>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/mission/side_result.h"
#include "core/pictures/difference_picture.h"
#include "tests/display/mouse.h"
#include "tests/display/workstation_fixture.h"
#include "tests/support/run_program.h"
#include "ui/panels/side_results_panel.h"
#include "ui/views/comparison_pane.h"

namespace foresight {
namespace {

/// A scan with a valve that was fitted, recorded, and opened for review.
struct SideResultsWindow : Workstation {
  static inline std::string mission;
  static inline bool ready = false;

  static void SetUpTestSuite() {
    Workstation::SetUpTestSuite();
    if (!scanned) return;
    Workbench& bench = running->bench();
    bench.live.fit.SetTool(ObjectKind::kValve, true);
    ImageCanvas* canvas = running->window().Image()->Canvas();
    const auto [a, b] = running->AroundValve();
    Drag(canvas->viewport(), canvas->WidgetFromPixel(a), canvas->WidgetFromPixel(b));
    if (!WaitForObject(1)) return;
    bench.live.fit.leaveTools();
    mission = bench.recording.Path().toStdString();
    if (!WaitFor([&] { return bench.recording.Waiting() == 0 && bench.Idle(); })) return;
    bench.reviewer.Open(bench.recording.Path());
    ready = WaitFor([&] {
      return bench.ShowsReview() && bench.review.session.Depth() && bench.Idle() &&
             !bench.side_results.Rows().empty();
    });
  }
  void SetUp() override {
    Workstation::SetUp();
    ASSERT_TRUE(ready) << "the mission did not open for review";
    running->bench().commands.Run("results.show");
    running->Settle();
  }
  static SideResultsModel& Results() { return running->bench().side_results; }
  static SideResultsPanel* Panel() { return running->window().SideResults(); }
  static ComparisonPane* Comparison() { return running->window().Comparison(); }
  static int Row(const QString& name) {
    for (std::size_t i = 0; i < Results().Rows().size(); ++i)
      if (Results().Rows()[i].name == name) return static_cast<int>(i);
    return -1;
  }
  /// Runs the scan again with the button, and waits until the result is listed.
  static bool RunAgain(const QString& name) {
    Panel()->NameField()->setText(name);
    auto* button = Panel()->findChild<QPushButton*>(QStringLiteral("runAgain"));
    if (button == nullptr || !button->isEnabled()) return false;
    button->click();
    const bool listed = WaitFor([&] { return Row(name) >= 0 && running->bench().Idle(); }, 180'000);
    Panel()->NameField()->clear();
    return listed;
  }
  static bool Compare(int a, int b) {
    running->bench().commands.Run("results.show");
    Panel()->ButtonA(a)->click();
    Panel()->ButtonB(b)->click();
    running->bench().commands.Run("results.compare");
    const bool done = WaitFor(
        [&] { return Results().Last().comparison != nullptr && running->bench().Idle(); }, 180'000);
    running->Settle();
    return done;
  }
  static nlohmann::json Printed(const std::vector<std::string>& arguments) {
    const ProgramResult result = RunProgram(FORESIGHTCTL, arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output, nullptr, false);
  }
  static SideResult Kept(const std::string& name) {
    const auto review = MissionFile::FindReviewOf(mission);
    EXPECT_TRUE(review && *review);
    if (!review || !*review) return {};
    const auto all = ListSideResults(**review);
    EXPECT_TRUE(all);
    for (const SideResult& result : *all)
      if (result.name == name) return result;
    ADD_FAILURE() << "no side result " << name;
    return {};
  }
};

TEST_F(SideResultsWindow, ARunAgainGivesTheFileOfForesightctlToTheLastByteAndLeavesTheMission) {
  const auto objects = running->bench().review.session.Objects().size();
  DepthViewModel& depth = running->bench().review.depth;
  depth.setMethod(DepthMethod::kPaper);
  depth.setThreshold(0.25);
  ASSERT_TRUE(WaitFor([] { return running->bench().Idle(); }));
  ASSERT_TRUE(RunAgain(QStringLiteral("paper, 0.25")));
  EXPECT_TRUE(Results().Rows().back().differences.contains("method paper instead of foresight"))
      << Results().Rows().back().differences.toStdString();
  EXPECT_TRUE(Results().Rows().back().differences.contains("0.25 instead of 0.35"));
  EXPECT_EQ(running->bench().review.session.Objects().size(), objects);
  EXPECT_EQ((*MissionFile::OpenReadOnly(mission))->ListDepths()->size(), 1u);

  const SideResult kept = Kept("paper, 0.25");
  const TemporaryFolder out;
  Printed({"mission", "run", mission, "-o", out.path().string(), "--method", "paper", "--threshold",
           "0.25", "--json"});
  EXPECT_EQ(ReadFile(out / (kept.scan_uuid + ".json")).value(), kept.answer_json);
  const std::string review = MissionFile::ReviewPathOf(mission)->string();
  const ProgramResult check = RunProgram(FORESIGHTCTL, {"mission", "check", "--recompute", review});
  EXPECT_EQ(check.exit_code, 0) << check.output << check.errors;
}

TEST_F(SideResultsWindow, AAndBInTheWindowAreWhatForesightctlPrintsToTheLastDigit) {
  if (Row(QStringLiteral("paper, 0.25")) < 0) {
    running->bench().review.depth.setMethod(DepthMethod::kPaper);
    running->bench().review.depth.setThreshold(0.25);
    ASSERT_TRUE(RunAgain(QStringLiteral("paper, 0.25")));
  }
  ASSERT_TRUE(Compare(0, Row(QStringLiteral("paper, 0.25"))));
  const ResultComparison& ours = *Results().Last().comparison;
  ASSERT_TRUE(ours.depth && ours.masked && ours.lidar);
  EXPECT_GT(ours.depth->only_in_first + ours.depth->only_in_second, 0);
  EXPECT_GT(ours.depth->p95_abs_m, 0.0);
  ASSERT_EQ(ours.objects.size(), 1u);
  const auto theirs = Printed({"mission", "compare", mission, "--b", "paper, 0.25", "--image",
                               std::to_string(ours.image), "--json"});
  EXPECT_EQ(nlohmann::json::parse(ComparisonToJson(ours)), theirs);

  // The words of the panel are those of foresightctl, too.
  const ProgramResult text = RunProgram(
      FORESIGHTCTL,
      {"mission", "compare", mission, "--b", "paper, 0.25", "--image", std::to_string(ours.image)});
  const auto* numbers = Panel()->findChild<QLabel*>(QStringLiteral("resultNumbers"));
  ASSERT_NE(numbers, nullptr);
  EXPECT_TRUE(QString::fromStdString(text.output).contains(numbers->text()))
      << text.output << numbers->text().toStdString();
}

TEST_F(SideResultsWindow, TheDifferenceMapIsWhiteOfAResultAndItself) {
  ASSERT_TRUE(Compare(0, 0));
  ASSERT_NE(Comparison(), nullptr);
  // Every pixel that the masked map has, where it stands on the pane.
  DepthCanvas* canvas = Comparison()->Difference();
  const QImage pane = canvas->grabFramebuffer();
  const double zoom = static_cast<double>(pane.width()) / canvas->width();
  const auto& mask = Results().Last().a->depth->mask;
  int measured = 0, white = 0;
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u) {
      const QPointF place = QPointF(canvas->WidgetFromPixel({u, v})) * zoom;
      const QPoint at(qRound(place.x()), qRound(place.y()));
      if (mask(u, v) == 0 || !pane.rect().contains(at)) continue;
      const QColor color = pane.pixelColor(at);
      ++measured;
      white += color.red() > 240 && color.green() > 240 && color.blue() > 240 ? 1 : 0;
    }
  ASSERT_GT(measured, 1000);
  EXPECT_GT(white, 0.95 * measured) << "of " << measured;
  const auto has_hue = [](const QColor& color) { return IsColoured(color); };
  EXPECT_LT(FractionOf(pane, has_hue), 0.002);
}

TEST_F(SideResultsWindow, TheDifferenceMapShowsBlueOrangeAndWhatOnlyOneOfThemHas) {
  ASSERT_GE(Row(QStringLiteral("paper, 0.25")), 0);
  ASSERT_TRUE(Compare(0, Row(QStringLiteral("paper, 0.25"))));
  const QImage map = Comparison()->Difference()->grabFramebuffer();
  const auto fraction = [&map](auto matches) { return FractionOf(map, matches); };
  EXPECT_GT(fraction([](const QColor& c) { return c.blue() > c.red() + 40 && c.blue() > 150; }),
            1e-4);
  EXPECT_GT(fraction([](const QColor& c) { return c.red() > c.blue() + 40 && c.red() > 150; }),
            1e-4);
  const bool a_alone = fraction([](const QColor& c) { return IsNear(c, kColorOnlyInA); }) > 1e-4;
  const bool b_alone = fraction([](const QColor& c) { return IsNear(c, kColorOnlyInB); }) > 1e-4;
  EXPECT_TRUE(a_alone || b_alone);
  EXPECT_EQ(Comparison()->DifferenceColors()->Labels().first(), QStringLiteral("-30"));
  EXPECT_EQ(Comparison()->DifferenceColors()->Labels().last(), QStringLiteral("30"));
  EXPECT_TRUE(Comparison()->Counts()->text().contains("only in A"));
}

TEST_F(SideResultsWindow, TheWipePartsAFromB) {
  ASSERT_GE(Row(QStringLiteral("paper, 0.25")), 0);
  ASSERT_TRUE(Compare(0, Row(QStringLiteral("paper, 0.25"))));
  CompareViewModel& compare = running->bench().review.compare;
  EXPECT_EQ(compare.With(), CompareViewModel::Kind::kResults);
  EXPECT_EQ(compare.First(), Results().Last().a->depth);
  EXPECT_EQ(compare.Second(), Results().Last().b->depth);
  compare.compareWithNothing();
  EXPECT_EQ(compare.First(), nullptr);
}

TEST_F(SideResultsWindow, OneCameraLooksAtBothClouds) {
  ASSERT_GE(Row(QStringLiteral("paper, 0.25")), 0);
  ASSERT_TRUE(Compare(0, Row(QStringLiteral("paper, 0.25"))));
  CloudCanvas *a = Comparison()->CloudA(), *b = Comparison()->CloudB();
  const QImage before = b->grabFramebuffer();
  const QPoint middle = a->rect().center();
  Drag(a, middle, middle + QPoint(120, 40));
  running->Settle();
  EXPECT_EQ(a->Camera().azimuth_rad, b->Camera().azimuth_rad);
  EXPECT_EQ(a->Camera().elevation_rad, b->Camera().elevation_rad);
  EXPECT_GT(FractionOfChanges(before, b->grabFramebuffer()), 0.005);
  Drag(b, middle, middle + QPoint(-60, 0));
  running->Settle();
  EXPECT_EQ(a->Camera().azimuth_rad, b->Camera().azimuth_rad);
}

TEST_F(SideResultsWindow, AnotherRigIsKeptAndMadeAgain) {
  const TemporaryFolder out;
  SensorRig rig = running->bench().review.session.Rig();
  rig.robot_from_base = Rigid<frame::Robot, frame::Base>(
      rig.robot_from_base.rotation(),
      rig.robot_from_base.translation() + Eigen::Vector3d(0.0, 0.0, 0.02));
  ASSERT_TRUE(SaveSensorRig(rig, out / "rig.yaml"));
  Results().RunAgainWithRig(QStringLiteral("20 mm higher"),
                            QString::fromStdString((out / "rig.yaml").string()));
  ASSERT_TRUE(WaitFor(
      [] { return Row(QStringLiteral("20 mm higher")) >= 0 && running->bench().Idle(); }, 180'000));
  ASSERT_TRUE(Compare(0, Row(QStringLiteral("20 mm higher"))));
  ASSERT_EQ(Results().Last().comparison->objects.size(), 1u);
  ASSERT_TRUE(Results().Last().comparison->objects[0].difference);
  EXPECT_NEAR(Results().Last().comparison->objects[0].difference->distance_m, 0.02, 0.002);
  const std::string review = MissionFile::ReviewPathOf(mission)->string();
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"mission", "check", "--recompute", review}).exit_code, 0);
}

TEST_F(SideResultsWindow, OneIsRenamedInItsCardAndDeletedAndComesBack) {
  const QString first = QStringLiteral("first name"), second = QStringLiteral("second name");
  ASSERT_TRUE(RunAgain(first));
  EXPECT_EQ(Panel()->MoreButton(0), nullptr) << "the original";
  const int index = Row(first);
  Panel()->MoreButton(index)->menu()->actions().at(0)->trigger();
  auto* field = Panel()->findChild<QLineEdit*>(QStringLiteral("renameResult"));
  ASSERT_NE(field, nullptr);
  running->Settle();
  running->window().grab().save(QCoreApplication::applicationDirPath() +
                                QStringLiteral("/seen_side_results.png"));
  field->setText(second);
  QTest::keyClick(field, Qt::Key_Return);
  ASSERT_TRUE(WaitFor([&] { return Row(second) == index; }));
  running->Settle();
  Panel()->MoreButton(index)->menu()->actions().at(1)->trigger();
  ASSERT_TRUE(WaitFor([&] { return Row(second) < 0; }));
  ASSERT_TRUE(running->bench().commands.Run("edit.undo"));
  ASSERT_TRUE(WaitFor([&] { return Row(second) == index; }));
}

TEST_F(SideResultsWindow, TheReportIsWrittenBesideWithPictureAndPdf) {
  const TemporaryFolder out;
  running->bench().review.exporter.WriteReport(QString::fromStdString(mission), {},
                                               QString::fromStdString(out.path().string()));
  ASSERT_TRUE(WaitFor([] { return running->bench().Idle(); }, 180'000));
  const std::filesystem::path folder =
      out / (std::filesystem::path(mission).stem().string() + "-report");
  const auto html = ReadFile(folder / "report.html");
  ASSERT_TRUE(html) << html.error().message;
  EXPECT_NE(html->find("paper, 0.25"), std::string::npos);
  EXPECT_TRUE(ReadFile(folder / "report.pdf")->starts_with("%PDF"));
}

TEST_F(SideResultsWindow, EveryCommandHasAKeyOfItsOwnAndSaysWhyItIsNotPossible) {
  CommandTable& commands = running->bench().commands;
  for (const char* id :
       {"results.show", "results.run", "results.run_with_rig", "results.add_mission",
        "results.compare", "file.report", "file.report_scan"})
    EXPECT_FALSE(commands.Get(id).keys.isEmpty()) << id;
  running->bench().backToLive();
  EXPECT_FALSE(commands.Get("results.run").WhyNot().isEmpty());
  EXPECT_TRUE(commands.Get("file.report").WhyNot().isEmpty());
  running->bench().showReview();
}

}  // namespace
}  // namespace foresight
