#include "app/workstation/actions.h"

#include "ui/panels/theme.h"

namespace foresight {

Actions::Actions(Workbench* bench, QObject* parent) : QObject(parent), bench_(bench) {
  open = Add("open", tr("Open mission"), QKeySequence::Open, tr("Show a saved mission"));
  save = Add("save", tr("Save mission"), QKeySequence::Save,
             tr("Save all scans and objects to a new mission file, which then takes new ones too"));
  export_cloud = Add("export", tr("Export cloud"), QKeySequence(QStringLiteral("Ctrl+E")),
                     tr("Write the lidar's points as PLY, in the robot's frame"));
  quit = Add(nullptr, tr("Quit"), QKeySequence::Quit, tr("Close the workstation"));
  scan = Add("scan", tr("Scan"), Qt::Key_Space, tr("Start the planned scan"));
  abort = Add("abort", tr("Abort scan"), QKeySequence(QStringLiteral("Shift+Esc")),
              tr("End the scan and keep what it has"));
  home = Add("home", tr("Home head"), QKeySequence(QStringLiteral("Ctrl+H")),
             tr("Connect and search the zero reference"));
  stop = Add("stop", tr("Stop head"), Qt::Key_F12, tr("Stop the scanner's motor at once"));
  region_tool = Add("region", tr("Region"), Qt::Key_R, tr("Draw to choose a region"));
  valve_tool = Add("valve", tr("Valve"), Qt::Key_V, tr("Draw a region over a valve to fit it"));
  drill_tool = Add("drill", tr("Drill"), Qt::Key_D, tr("Draw a region over a drill to fit it"));
  terrain_tool =
      Add("terrain", tr("Terrain"), Qt::Key_T, tr("Draw a region over blocks to fit them"));
  leave_tool = Add(nullptr, tr("Leave tool"), Qt::Key_Escape, tr("Back to moving the view"));
  fit = Add("fit", tr("Fit"), Qt::Key_F, tr("Fit the object into the region again"));
  compare_sources = Add("compare", tr("Compare sources"), QKeySequence(QStringLiteral("Shift+F")),
                        tr("Fit to the lidar returns and every depth method, side by side"));
  next_candidate = Add(nullptr, tr("Next answer"), Qt::Key_Tab,
                       tr("In a pane: the next rival, or the next surface"));
  previous_candidate =
      Add(nullptr, tr("Previous answer"), QKeySequence(QStringLiteral("Shift+Tab")),
          tr("In a pane: the rival or surface before"));
  for (QAction* action : OfPanes()) action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  undo_region = Add("undo", tr("Undo region"), QKeySequence::Undo, tr("Back to the last region"));
  reset_view = Add(nullptr, tr("Reset view"), Qt::Key_Home, tr("Show everything again"));
  toggle_mask = Add(nullptr, tr("Mask on or off"), Qt::Key_M, tr("Hatch the uncertain depths"));
  toggle_layer =
      Add(nullptr, tr("Depth or confidence"), Qt::Key_C, tr("Change what the depth pane shows"));
  toggle_rejected = Add(nullptr, tr("Rejected samples"), Qt::Key_H,
                        tr("Show or hide the lidar samples that were rejected, and why"));
  reset_layout = Add(nullptr, tr("Reset layout"), QKeySequence(QStringLiteral("Ctrl+Shift+L")),
                     tr("Put every pane back to its place"));
  shortcuts = Add("help", tr("Shortcuts"), Qt::Key_F1, tr("List all keys"));
  for (QAction* tool : {region_tool, valve_tool, drill_tool, terrain_tool})
    tool->setCheckable(true);
  BindToBench();
  Refresh();
}

QAction* Actions::Add(const char* icon, const QString& text, const QKeySequence& key,
                      const QString& tip) {
  auto* action = new QAction(text, this);
  if (icon != nullptr) action->setIcon(Icon(icon));
  action->setShortcut(key);
  action->setToolTip(tr("%1 (%2)").arg(tip, key.toString(QKeySequence::NativeText)));
  action->setStatusTip(tip);
  all_ << action;
  return action;
}

void Actions::BindToBench() {
  connect(scan, &QAction::triggered, &bench_->head, &HeadViewModel::scan);
  connect(abort, &QAction::triggered, &bench_->head, &HeadViewModel::abort);
  connect(home, &QAction::triggered, &bench_->head, &HeadViewModel::home);
  connect(stop, &QAction::triggered, &bench_->head, &HeadViewModel::stop);
  connect(region_tool, &QAction::triggered, &bench_->fit, &FitViewModel::setRegionTool);
  for (const auto& [tool, kind] : Tools())
    connect(tool, &QAction::triggered, &bench_->fit,
            [this, object = kind](bool on) { bench_->fit.SetTool(object, on); });
  connect(compare_sources, &QAction::triggered, &bench_->gallery, &SourceGalleryModel::start);
  connect(next_candidate, &QAction::triggered, &bench_->session, &SessionModel::nextCandidate);
  connect(previous_candidate, &QAction::triggered, &bench_->session,
          &SessionModel::previousCandidate);
  connect(leave_tool, &QAction::triggered, &bench_->fit, &FitViewModel::leaveTools);
  connect(fit, &QAction::triggered, &bench_->fit, &FitViewModel::fit);
  connect(undo_region, &QAction::triggered, &bench_->session, &SessionModel::undoRoi);
  connect(toggle_mask, &QAction::triggered, &bench_->layers, &LayersViewModel::toggleMask);
  connect(toggle_layer, &QAction::triggered, &bench_->layers, &LayersViewModel::toggleLayer);
  connect(toggle_rejected, &QAction::triggered, &bench_->layers, &LayersViewModel::toggleRejected);
  connect(&bench_->head, &HeadViewModel::statusChanged, this, &Actions::Refresh);
  connect(&bench_->fit, &FitViewModel::changed, this, &Actions::Refresh);
}

void Actions::Refresh() {
  scan->setEnabled(bench_->head.CanScan());
  abort->setEnabled(bench_->head.CanAbort());
  home->setEnabled(bench_->head.CanHome());
  const auto chosen = bench_->fit.Tool();
  region_tool->setChecked(bench_->fit.Drawing() && !chosen);
  for (const auto& [tool, kind] : Tools()) tool->setChecked(chosen == kind);
  fit->setEnabled(bench_->fit.CanFit());
  compare_sources->setEnabled(bench_->gallery.CanStart());
  undo_region->setEnabled(bench_->session.CanUndoRoi());
  export_cloud->setEnabled(bench_->exporter.CanExport());
}

}  // namespace foresight
