// The commands of the window: its files, its docks, and what is sent to who helps.
#include <QApplication>
#include <QBuffer>
#include <QLineEdit>
#include <QSettings>

#include "app/workstation/import_files.h"
#include "app/workstation/main_window.h"
#include "app/workstation/measure_commands.h"
#include "app/workstation/result_commands.h"
#include "app/workstation/shortcut_sheet.h"
#include "core/base/log_file.h"
#include "ui/panels/mission_search_panel.h"
#include "ui/panels/side_results_panel.h"
#include "ui/views/cloud_pane.h"
#include "ui/views/depth_pane.h"
#include "ui/views/image_pane.h"

namespace foresight {

void MainWindow::ChooseRecordingFile() {
  files_.ToSave(tr("Record into"), tr("Missions (*.foresight)"), QStringLiteral("foresight"),
                [this](const QString& path) {
                  // A scan may have begun while the dialogue was open.
                  if (!bench_->head.Scanning()) {
                    bench_->recording.SwitchTo(path);
                    return;
                  }
                  bench_->live.session.Report(
                      {Notice::Level::kWarning,
                       tr("A scan is running: the file that is recorded into was not changed."),
                       tr("Choose the other file when the scan has ended (Ctrl+Shift+S).")});
                });
}

void MainWindow::AddFileCommands() {
  CommandTable& commands = bench_->commands;
  const QString missions = tr("Missions (*.foresight)"), clouds = tr("Clouds (*.ply)");
  const QString suffix = QStringLiteral("foresight");
  commands.Add({.id = "file.open",
                .menu = "file",
                .icon = "open",
                .text = tr("Open for review"),
                .tip = tr("Look at saved missions; recording goes on"),
                .keys = QStringLiteral("Ctrl+O"),
                .in_tool_bar = true,
                .run = [this, missions] {
                  files_.ManyToOpen(tr("Open missions for review"), missions,
                                    [this](const auto& paths) { bench_->reviewer.OpenAll(paths); });
                }});
  commands.Add({.id = "file.import",
                .menu = "file",
                .text = tr("Import"),
                .tip = tr("Make a mission of other programs' clouds, images and ROS bags, and show "
                          "it for review"),
                .keys = QStringLiteral("Ctrl+I"),
                .run = [this] { ChooseFilesToImport(&files_, this, bench_); }});
  commands.Add({.id = "file.copy",
                .menu = "file",
                .icon = "save",
                .text = tr("Copy mission to"),
                .tip = tr("Write a complete copy of the mission that is shown; recording goes on "
                          "where it is"),
                .keys = QStringLiteral("Ctrl+S"),
                .in_tool_bar = true,
                .run = [this, missions, suffix] {
                  const bool review = bench_->ShowsReview();
                  files_.ToSave(tr("Copy the mission to"), missions, suffix,
                                [this, review](const QString& path) {
                                  review ? bench_->reviewer.CopyTo(path)
                                         : bench_->recording.CopyTo(path);
                                });
                }});
  commands.Add({.id = "recording.file",
                .menu = "file",
                .text = tr("Record into another file"),
                .tip = tr("Go on recording in a new mission file, or in one that is there"),
                .keys = QStringLiteral("Ctrl+Shift+S"),
                .run = [this] { ChooseRecordingFile(); },
                .why_not = [this] { return bench_->head.WhyNotDuringScan(); }});
  commands.Add(
      {.id = "file.export_cloud",
       .menu = "file",
       .icon = "export",
       .text = tr("Export cloud"),
       .tip = tr("Write the lidar's points as PLY, in the robot's frame"),
       .keys = QStringLiteral("Ctrl+E"),
       .in_tool_bar = true,
       .run =
           [this, clouds] {
             Desk* desk = &bench_->Shown();
             files_.ToSave(tr("Export cloud"), clouds, QStringLiteral("ply"),
                           [desk](const QString& path) { desk->exporter.ExportCloud(path); });
           },
       .why_not =
           [this] {
             return bench_->Shown().exporter.CanExport() ? QString() : tr("There is no cloud yet.");
           }});
  commands.Add({.id = "file.export_mission",
                .menu = "file",
                .text = tr("Export mission"),
                .tip = tr("Write clouds, surfaces, depth maps, tables and a ROS bag of the mission "
                          "that is shown, for other programs"),
                .keys = QStringLiteral("Ctrl+Shift+E"),
                .run = [this] {
                  Desk* desk = &bench_->Shown();
                  const QString mission =
                      bench_->ShowsReview() ? bench_->reviewer.Path() : bench_->recording.Path();
                  files_.Folder(tr("Export the mission into"),
                                [desk, mission](const QString& folder) {
                                  desk->exporter.ExportMission(mission, folder);
                                });
                }});
  commands.Add({.id = "file.quit",
                .menu = "file",
                .text = tr("Quit"),
                .tip = tr("Close the workstation; it asks where something would be lost"),
                .keys = QStringLiteral("Ctrl+Q"),
                .run = [this] { close(); }});
}

void MainWindow::AddViewCommands() {
  CommandTable& commands = bench_->commands;
  commands.Add({.id = "view.reset",
                .menu = "view",
                .text = tr("Reset view"),
                .tip = tr("Show everything again"),
                .keys = QStringLiteral("Home"),
                .run = [this] {
                  for (auto* canvas : findChildren<CloudCanvas*>()) canvas->ResetView();
                  for (auto* canvas : findChildren<ImageCanvas*>()) canvas->ShowAll();
                  for (auto* canvas : findChildren<DepthCanvas*>()) canvas->ShowAll();
                }});
  commands.Add({.id = "view.reset_layout",
                .menu = "view",
                .text = tr("Reset layout"),
                .tip = tr("Put every pane back to its place"),
                .keys = QStringLiteral("Ctrl+Shift+L"),
                .run = [this] { ResetLayout(); }});
  commands.Add({.id = "view.options",
                .menu = "view",
                .text = tr("Options"),
                .tip = tr("All options of the depth map and of the fit"),
                .keys = QStringLiteral("O"),
                .run = [this] { Open(options_dock_); }});
  commands.Add({.id = "view.notes",
                .menu = "view",
                .text = tr("Notes"),
                .tip = tr("Measurements and notes of the mission"),
                .keys = QStringLiteral("Shift+L"),
                .run = [this] { Open(notes_dock_); }});
  commands.Add({.id = "view.map",
                .menu = "view",
                .text = tr("Map"),
                .tip = tr("Several scans in one map, what changed between two, and the clip box"),
                .keys = QStringLiteral("Ctrl+M"),
                .run = [this] { Open(map_dock_); }});
  commands.Add({.id = "view.check",
                .menu = "view",
                .text = tr("Self-check"),
                .tip = tr("What the scan on the screen says about its depth, the calibration and "
                          "accepted objects"),
                .keys = QStringLiteral("Shift+K"),
                .run = [this] { Open(check_dock_); }});
  commands.Add({.id = "view.calibrate_camera",
                .menu = "view",
                .text = tr("Calibrate camera"),
                .tip = tr("Calibrate the head's camera from images of a board; scanning and "
                          "recording go on"),
                .keys = QStringLiteral("Ctrl+Shift+C"),
                .run = [this] { Open(calibration_dock_); }});
  commands.Add({.id = "view.calibrate_head",
                .menu = "view",
                .text = tr("Calibrate head"),
                .tip = tr("Calibrate camera, motor, lidar and time from a stand of boards"),
                .keys = QStringLiteral("Ctrl+Shift+H"),
                .run = [this] { Open(head_calibration_dock_); }});
  commands.Add({.id = "view.timeline",
                .menu = "view",
                .text = tr("Timeline"),
                .tip = tr("What happened in the mission under review, in time, and its replay"),
                .keys = QStringLiteral("Ctrl+T"),
                .run = [this] { Open(timeline_dock_); }});
  commands.Add({.id = "view.search",
                .menu = "view",
                .text = tr("Search missions"),
                .tip = tr("Find scans, objects and messages in all missions of a folder"),
                .keys = QStringLiteral("Ctrl+Shift+F"),
                .run = [this] {
                  Open(search_dock_);
                  search_->Words()->setFocus();
                }});
}

void MainWindow::ChooseBundle() {
  SupportBundleSources sources;
  const QString mission =
      bench_->ShowsReview() ? bench_->reviewer.Path() : bench_->recording.Path();
  if (!mission.isEmpty()) sources.mission = mission.toStdString();
  sources.texts = {LogFileOf("workstation"), QSettings().fileName().toStdString()};
  sources.versions = {std::string("Qt ") + qVersion(),
                      "platform " + QGuiApplication::platformName().toStdString()};
  // Before the dialogue covers them.
  int number = 0;
  for (QWidget* window : QApplication::topLevelWidgets()) {
    if (!window->isVisible()) continue;
    QByteArray png;
    QBuffer buffer(&png);
    window->grab().save(&buffer, "PNG");
    sources.attachments.emplace_back(fmt::format("windows/window-{}.png", ++number),
                                     png.toStdString());
  }
  Desk* desk = &bench_->Shown();
  files_.ToSave(
      tr("Write the support bundle"), tr("Archives (*.zip)"), QStringLiteral("zip"),
      [desk, sources](const QString& path) { desk->exporter.WriteBundle(path, sources); });
}

void MainWindow::AddHelpCommands() {
  CommandTable& commands = bench_->commands;
  commands.Add({.id = "help.bundle",
                .menu = "help",
                .text = tr("Support bundle"),
                .tip = tr("Pack the log, the settings, the last scan and an image of each window "
                          "into one file, for who has to find out what went wrong"),
                .run = [this] { ChooseBundle(); }});
  commands.Add({.id = "help.shortcuts",
                .menu = "help",
                .icon = "help",
                .text = tr("Shortcuts"),
                .tip = tr("List all keys"),
                .keys = QStringLiteral("F1"),
                .run = [this] { ShowShortcutSheet(bench_->commands, this); }});
}

void MainWindow::AddCommandsOfResults() {
  AddMapFileCommands(bench_, [this](const QString& title, const QString& filter,
                                    const std::function<void(QString)>& chosen) {
    files_.ToOpen(title, filter, chosen);
  });
  AddResultCommands(
      bench_,
      {[this] { Open(results_dock_); }, [this] { ShowComparison(); },
       [this] { return side_results_->Name(); },
       [this](const QString& title, const QString& filter,
              const std::function<void(QString)>& chosen) { files_.ToOpen(title, filter, chosen); },
       [this](const QString& title, const std::function<void(QString)>& chosen) {
         files_.Folder(title, chosen);
       }});
}

}  // namespace foresight
