#include "app/workstation/result_commands.h"

#include <QCoreApplication>

#include "app/workstation/workbench.h"

namespace foresight {
namespace {

/// Texts that lupdate finds under this name.
struct ResultCommands {
  Q_DECLARE_TR_FUNCTIONS(ResultCommands)
};

void AddSideResultCommands(Workbench* bench, const ResultWindow& window) {
  SideResultsModel* results = &bench->side_results;
  const auto why_no_run = [bench, results]() -> QString {
    return bench->ShowsReview() ? results->WhyNoRun()
                                : ResultCommands::tr("Open a mission for review first (Ctrl+O).");
  };
  bench->commands.Add(
      {.id = "results.show",
       .menu = "view",
       .text = ResultCommands::tr("Side results"),
       .tip = ResultCommands::tr("What other settings would have given, and two results compared"),
       .keys = QStringLiteral("Shift+R"),
       .run = window.show_results});
  bench->commands.Add(
      {.id = "results.run",
       .menu = "object",
       .text = ResultCommands::tr("Run scan again"),
       .tip = ResultCommands::tr(
           "Make all depth maps and fits of the scan under review again, with the options that are "
           "set now; the mission is not touched"),
       .keys = QStringLiteral("Ctrl+G"),
       .run = [results, window] { results->RunAgain(window.name()); },
       .why_not = why_no_run});
  bench->commands.Add({.id = "results.run_with_rig",
                       .menu = "object",
                       .text = ResultCommands::tr("Run scan again with another rig"),
                       .tip = ResultCommands::tr("The same with the calibration of a rig file"),
                       .keys = QStringLiteral("Ctrl+Shift+G"),
                       .run =
                           [results, window] {
                             window.choose_file(
                                 ResultCommands::tr("Run the scan again with the rig"),
                                 ResultCommands::tr("Rigs (*.yaml)"),
                                 [results, window](const QString& file) {
                                   results->RunAgainWithRig(window.name(), file);
                                 });
                           },
                       .why_not = why_no_run});
  bench->commands.Add({.id = "results.add_mission",
                       .menu = "view",
                       .text = ResultCommands::tr("Compare with another mission"),
                       .tip = ResultCommands::tr("List the scans of another mission as A and B"),
                       .keys = QStringLiteral("Ctrl+Shift+O"),
                       .run =
                           [results, window] {
                             window.choose_file(
                                 ResultCommands::tr("Compare with the scans of a mission"),
                                 ResultCommands::tr("Missions (*.foresight)"),
                                 [results](const QString& file) { results->AddMission(file); });
                           },
                       .why_not = why_no_run});
  bench->commands.Add(
      {.id = "results.compare",
       .menu = "view",
       .text = ResultCommands::tr("Compare A and B"),
       .tip = ResultCommands::tr("Depth difference, distance of the clouds and of the poses"),
       .keys = QStringLiteral("Ctrl+D"),
       .run =
           [results, window] {
             window.show_comparison();
             results->compare();
           },
       .why_not = [results] { return results->WhyNoComparison(); }});
}

void AddReportCommands(Workbench* bench, const ResultWindow& window) {
  const auto write = [bench, window](const std::string& scan_uuid) {
    const QString mission = bench->ShownMission();
    ExportViewModel* exporter = &bench->Shown().exporter;
    window.choose_folder(ResultCommands::tr("Write the report into"),
                         [exporter, mission, scan_uuid](const QString& folder) {
                           exporter->WriteReport(mission, scan_uuid, folder);
                         });
  };
  bench->commands.Add(
      {.id = "file.report",
       .menu = "file",
       .text = ResultCommands::tr("Report"),
       .tip = ResultCommands::tr("Write a page with pictures of the mission that is shown, and the "
                                 "same as PDF"),
       .keys = QStringLiteral("Ctrl+P"),
       .run = [write] { write({}); },
       .why_not =
           [bench] {
             return bench->ShownMission().isEmpty()
                        ? ResultCommands::tr("There is no mission file.")
                        : QString();
           }});
  bench->commands.Add({.id = "file.report_scan",
                       .menu = "file",
                       .text = ResultCommands::tr("Report of this scan"),
                       .tip = ResultCommands::tr("The same of the scan that is shown alone"),
                       .keys = QStringLiteral("Ctrl+Shift+P"),
                       .run = [bench, write] { write(bench->Shown().session.CurrentScan()->uuid); },
                       .why_not =
                           [bench] {
                             return bench->Shown().session.CurrentScan() &&
                                            !bench->ShownMission().isEmpty()
                                        ? QString()
                                        : ResultCommands::tr("No scan is shown.");
                           }});
}

}  // namespace

void AddResultCommands(Workbench* bench, const ResultWindow& window) {
  AddSideResultCommands(bench, window);
  AddReportCommands(bench, window);
}

}  // namespace foresight
