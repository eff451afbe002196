#include "app/workstation/main_window.h"

#include <qtadvanceddocking/DockAreaWidget.h>
#include <qtadvanceddocking/DockManager.h>

#include <QCloseEvent>
#include <QFileDialog>
#include <QMenuBar>
#include <QSettings>
#include <QSplitter>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include "app/workstation/actions.h"
#include "app/workstation/shortcut_sheet.h"
#include "ui/panels/dock_style.h"
#include "ui/panels/head_panel.h"
#include "ui/panels/head_strip.h"
#include "ui/panels/mission_panel.h"
#include "ui/panels/notice_strip.h"
#include "ui/panels/objects_panel.h"
#include "ui/panels/source_gallery.h"
#include "ui/panels/task_strip.h"
#include "ui/views/cloud_pane.h"
#include "ui/views/depth_pane.h"
#include "ui/views/image_pane.h"

namespace foresight {
namespace {

/// Counts up when docks come or go, so that an old layout is not forced on new docks.
constexpr int kLayoutVersion = 1;
const QString kLayoutKey = QStringLiteral("layout/docks");
const QString kGeometryKey = QStringLiteral("layout/window");

}  // namespace

MainWindow::MainWindow(Workbench* bench, QWidget* parent)
    : QMainWindow(parent),
      bench_(bench),
      actions_(new Actions(bench, this)),
      image_(new ImagePane(&bench->session, &bench->fit, &bench->layers)),
      depth_(new DepthPane({&bench->session, &bench->depth, &bench->fit, &bench->layers,
                            &bench->compare, &bench->live})),
      cloud_(new CloudPane(&bench->session, &bench->fit)),
      notices_(new NoticeStrip) {
  setWindowTitle(tr("Foresight"));
  BuildBars();
  BuildCentre();
  BuildDocks();
  BindViews();
  resize(1600, 1000);
  first_layout_ = docks_->saveState(kLayoutVersion);
}

void MainWindow::SaveLayout(QSettings* settings) const {
  settings->setValue(kLayoutKey, docks_->saveState(kLayoutVersion));
  settings->setValue(kGeometryKey, saveGeometry());
}

void MainWindow::RestoreLayout(const QSettings& settings) {
  restoreGeometry(settings.value(kGeometryKey).toByteArray());
  const QByteArray layout = settings.value(kLayoutKey).toByteArray();
  if (!layout.isEmpty()) docks_->restoreState(layout, kLayoutVersion);
}

void MainWindow::ResetLayout() {
  docks_->restoreState(first_layout_, kLayoutVersion);
}

void MainWindow::BuildBars() {
  for (QAction* action : actions_->All())
    if (!actions_->OfPanes().contains(action)) addAction(action);
  auto* file = menuBar()->addMenu(tr("&File"));
  file->addActions({actions_->open, actions_->save, actions_->export_cloud});
  file->addSeparator();
  file->addAction(actions_->quit);
  auto* head = menuBar()->addMenu(tr("&Head"));
  head->addActions({actions_->scan, actions_->abort, actions_->home, actions_->stop});
  auto* object = menuBar()->addMenu(tr("&Object"));
  object->addActions({actions_->region_tool, actions_->valve_tool, actions_->drill_tool,
                      actions_->terrain_tool, actions_->leave_tool, actions_->fit,
                      actions_->compare_sources, actions_->next_candidate,
                      actions_->previous_candidate, actions_->undo_region});
  view_menu_ = menuBar()->addMenu(tr("&View"));
  view_menu_->addActions({actions_->reset_view, actions_->toggle_mask, actions_->toggle_layer,
                          actions_->toggle_rejected});
  view_menu_->addSeparator();
  view_menu_->addAction(actions_->reset_layout);
  view_menu_->addSeparator();
  menuBar()->addMenu(tr("H&elp"))->addAction(actions_->shortcuts);

  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->setIconSize({20, 20});
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar->addActions({actions_->open, actions_->save, actions_->export_cloud});
  bar->addSeparator();
  bar->addActions({actions_->region_tool, actions_->valve_tool, actions_->drill_tool,
                   actions_->terrain_tool, actions_->fit, actions_->undo_region});

  statusBar()->addPermanentWidget(
      new TaskStrip({bench_->depth.Runner(), bench_->compare.Runner(), bench_->fit.Runner(),
                     bench_->gallery.Runner(), bench_->mission.Runner(),
                     bench_->exporter.Runner()}),
      1);
  statusBar()->setSizeGripEnabled(false);
}

void MainWindow::BuildCentre() {
  auto* centre = new QWidget;
  auto* layout = new QVBoxLayout(centre);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(new HeadStrip(&bench_->head, &bench_->session));
  layout->addWidget(notices_);
  SetUpDocks();
  docks_ = new ads::CDockManager(centre);
  StyleDocks(docks_);
  layout->addWidget(docks_, 1);
  setCentralWidget(centre);
}

ads::CDockWidget* MainWindow::Dock(const char* name, const QString& title, QWidget* content) {
  auto* dock = new ads::CDockWidget(title);
  dock->setObjectName(QString::fromLatin1(name));  // saved layouts know docks by it
  dock->setWidget(content, ads::CDockWidget::ForceNoScrollArea);
  dock->setAccessibleName(title);
  view_menu_->addAction(dock->toggleViewAction());
  return dock;
}

void MainWindow::BuildDocks() {
  auto* centre =
      docks_->addDockWidget(ads::CenterDockWidgetArea, Dock("cloud", tr("3D cloud"), cloud_));
  auto* left = docks_->addDockWidget(
      ads::LeftDockWidgetArea, Dock("head", tr("Head and scan"), new HeadPanel(&bench_->head)));
  docks_->addDockWidget(
      ads::RightDockWidgetArea,
      Dock("objects", tr("Objects"), new ObjectsPanel(&bench_->session, &bench_->fit)));
  auto* top =
      docks_->addDockWidget(ads::TopDockWidgetArea, Dock("picture", tr("Picture"), image_), centre);
  docks_->addDockWidget(ads::RightDockWidgetArea, Dock("depth", tr("Depth"), depth_), top);
  docks_->addDockWidget(ads::BottomDockWidgetArea,
                        Dock("mission", tr("Mission"), new MissionPanel(&bench_->mission)), left);
  docks_->setSplitterSizes(centre, {430, 470});
  docks_->setSplitterSizes(left, {620, 240});
  docks_->setSplitterSizes(top, {500, 500});
  for (auto* splitter : docks_->findChildren<QSplitter*>())
    if (splitter->count() == 3) splitter->setSizes({290, 980, 330});
}

void MainWindow::BindViews() {
  connect(&bench_->session, &SessionModel::noticed, notices_, &NoticeStrip::show);
  for (QWidget* pane : {static_cast<QWidget*>(image_), static_cast<QWidget*>(depth_),
                        static_cast<QWidget*>(cloud_)})
    pane->addActions(actions_->OfPanes());
  connect(actions_->reset_view, &QAction::triggered, cloud_->Canvas(), &CloudCanvas::ResetView);
  connect(actions_->reset_view, &QAction::triggered, image_->Canvas(), &ImageCanvas::ShowAll);
  connect(actions_->reset_view, &QAction::triggered, depth_->Canvas(), &DepthCanvas::ShowAll);
  connect(&bench_->gallery, &SourceGalleryModel::finished, this,
          [this] { ShowSourceGallery(bench_->gallery.Answers(), this); });
  connect(actions_->reset_layout, &QAction::triggered, this, &MainWindow::ResetLayout);
  connect(actions_->quit, &QAction::triggered, this, &QWidget::close);
  connect(actions_->shortcuts, &QAction::triggered, this,
          [this] { ShowShortcutSheet(actions_->All(), this); });
  const QString missions = tr("Missions (*.foresight)"), clouds = tr("Clouds (*.ply)");
  connect(actions_->open, &QAction::triggered, this, [this, missions] {
    ChooseFile(false, tr("Open mission"), missions, {},
               [this](const QString& path) { bench_->mission.Open(path); });
  });
  connect(actions_->save, &QAction::triggered, this, [this, missions] {
    ChooseFile(true, tr("Save mission as"), missions, QStringLiteral("foresight"),
               [this](const QString& path) { bench_->mission.SaveAs(path); });
  });
  connect(actions_->export_cloud, &QAction::triggered, this, [this, clouds] {
    ChooseFile(true, tr("Export cloud"), clouds, QStringLiteral("ply"),
               [this](const QString& path) { bench_->exporter.ExportCloud(path); });
  });
}

void MainWindow::ChooseFile(bool save, const QString& title, const QString& filter,
                            const QString& suffix, const std::function<void(QString)>& chosen) {
  auto* dialog = new QFileDialog(this, title, {}, filter);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(save ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
  dialog->setFileMode(save ? QFileDialog::AnyFile : QFileDialog::ExistingFile);
  dialog->setDefaultSuffix(suffix);
  connect(dialog, &QFileDialog::fileSelected, this, chosen);
  dialog->setModal(false);  // a scan may be running: the stop button must stay within reach
  dialog->show();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (bench_->mission.UnsavedScans() == 0 || close_was_asked_) {
    event->accept();
    return;
  }
  close_was_asked_ = true;
  bench_->session.Report({Notice::Level::kWarning,
                          tr("Scans that are not saved: %1.").arg(bench_->mission.UnsavedScans()),
                          tr("Save the mission (Ctrl+S), or close again to discard them.")});
  event->ignore();
}

}  // namespace foresight
