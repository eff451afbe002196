// What the window shows equals what foresightctl prints for the same record, to the last digit.
#include <qtadvanceddocking/DockWidget.h>

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <nlohmann/json.hpp>

#include "core/detection/detection_json.h"
#include "core/mission/mission_file.h"
#include "core/mission/provenance.h"
#include "core/options/option_text.h"
#include "tests/display/mouse.h"
#include "tests/display/workstation_fixture.h"
#include "tests/support/run_program.h"
#include "ui/panels/detection_card.h"
#include "ui/panels/objects_panel.h"
#include "ui/panels/options_panel.h"

namespace foresight {
namespace {

struct SameNumbers : Workstation {
  /// The panel of the live document. Objects and Options share a place: a tab that is not in front
  /// belongs to no window.
  template <class Panel>
  static Panel* Find() {
    return running->window().findChild<Panel*>();
  }
  static OptionsPanel* ShowOptions() {
    running->bench().commands.Run("view.options");
    return Find<OptionsPanel>();
  }
  /// Found while it is in front.
  ads::CDockWidget* objects = running->window().findChild<ads::CDockWidget*>("objects");

  static void ChooseSource(int index) {
    for (QComboBox* box : Find<ObjectsPanel>()->findChildren<QComboBox*>())
      if (box->itemText(0) == QStringLiteral("to lidar points")) {
        box->setCurrentIndex(index);
        Q_EMIT box->activated(index);
      }
  }
  static void DragOverTheValve() {
    ImageCanvas* canvas = running->window().Image()->Canvas();
    const auto [a, b] = running->AroundValve();
    Drag(canvas->viewport(), canvas->WidgetFromPixel(a), canvas->WidgetFromPixel(b));
  }
  static void Type(OptionField* field, const char* text) {
    ASSERT_NE(field, nullptr);
    field->Edit()->setText(QString::fromLatin1(text));
    Q_EMIT field->Edit()->editingFinished();
    EXPECT_EQ(field->Fault().toStdString(), "");
  }
  static std::string Polygon(const Roi& roi) {
    const OptionInfo numbers{.type = OptionType::kNumbers};
    std::vector<double> corners;
    for (const Eigen::Vector2d& corner : std::get<ImageRoi>(roi).polygon)
      corners.insert(corners.end(), {corner.x(), corner.y()});
    return OptionText(numbers, corners);
  }
  static QStringList TextsOfTheCard() {
    QStringList texts;
    for (const QLabel* label : Find<DetectionCard>()->findChildren<QLabel*>())
      texts << label->text();
    return texts;
  }
};

TEST_F(SameNumbers, AFitInTheWindowIsTheOneThatForesightctlPrints) {
  Workbench& bench = running->bench();
  ASSERT_NE(objects, nullptr);
  ChooseSource(static_cast<int>(FitSource::kDepth));
  bench.live.fit.SetTool(ObjectKind::kValve, true);
  ASSERT_NE(ShowOptions(), nullptr);
  Type(Find<OptionsPanel>()->Fit()->Field("seed"), "5");
  Type(Find<OptionsPanel>()->Depth()->Field("mask.threshold"), "0.55");
  objects->setAsCurrentTab();
  DragOverTheValve();
  ASSERT_TRUE(WaitForObject(1));
  const FoundObject object = bench.live.session.Objects().back();
  ASSERT_TRUE(WaitFor([&] { return bench.recording.Waiting() == 0 && bench.Idle(); }));
  const std::string mission = bench.recording.Path().toStdString();
  const auto provenance = ProvenanceFromJson(object.provenance_json, "object");
  ASSERT_TRUE(provenance) << provenance.error().message;

  std::vector<std::string> fit = {"fit",
                                  "valve",
                                  mission,
                                  "--polygon",
                                  Polygon(*provenance->roi),
                                  "--source",
                                  provenance->source,
                                  "--threshold",
                                  "0.55",
                                  "--seed",
                                  "5"};
  const ProgramResult text = RunProgram(FORESIGHTCTL, fit);
  fit.emplace_back("--json");
  const ProgramResult printed = RunProgram(FORESIGHTCTL, fit);
  ASSERT_LE(printed.exit_code, 1) << printed.errors;
  auto theirs = nlohmann::json::parse(printed.output);
  auto ours = nlohmann::json::parse(DetectionToJson(object.detection, object.rig.robot_from_base));
  for (const char* key : {"seconds", "scan_state", "scan_reason"}) {
    theirs.erase(key);
    ours.erase(key);
  }
  EXPECT_EQ(ours, theirs) << nlohmann::json::diff(ours, theirs).dump(1);

  const QStringList shown = TextsOfTheCard();
  int facts = 0;
  for (const QString& line : QString::fromStdString(text.output).split(QLatin1Char('\n'))) {
    if (line.length() < 17 || line.at(15) != QLatin1Char(' ')) continue;  // "name            value"
    ++facts;
    EXPECT_TRUE(shown.contains(line.mid(16).trimmed()))
        << line.toStdString() << "\n--- on the card ---\n"
        << shown.join(QLatin1Char('\n')).toStdString();
  }
  EXPECT_GE(facts, 5) << text.output;

  const ProgramResult again =
      RunProgram(FORESIGHTCTL, {"mission", "check", "--recompute", mission});
  EXPECT_EQ(again.exit_code, 0) << again.output << again.errors;

  ChooseSource(0);
  bench.live.fit.resetOptions();
  bench.live.depth.resetOptions();
}

TEST_F(SameNumbers, WhatIsWrongWithATypedOptionIsSaidAndTheTextStays) {
  ASSERT_NE(ShowOptions(), nullptr);
  OptionField* field = Find<OptionsPanel>()->Depth()->Field("local_plane.radius_in_sigmas");
  ASSERT_NE(field, nullptr);
  field->Edit()->setText(QStringLiteral("100"));
  Q_EMIT field->Edit()->editingFinished();
  EXPECT_EQ(field->Edit()->text(), QStringLiteral("100"));
  EXPECT_TRUE(field->Fault().contains(QStringLiteral("from 0.5 to 4")))
      << field->Fault().toStdString();
  EXPECT_EQ(running->bench().live.depth.Options().local_plane.radius_in_sigmas, 2.0);
  field->Edit()->setText(QStringLiteral("2"));
  Q_EMIT field->Edit()->editingFinished();
  EXPECT_TRUE(field->Fault().isEmpty());
  ASSERT_NE(objects, nullptr);
  objects->setAsCurrentTab();
}

}  // namespace
}  // namespace foresight
