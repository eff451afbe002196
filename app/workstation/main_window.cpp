#include "app/workstation/main_window.h"

#include <qtadvanceddocking/DockAreaWidget.h>
#include <qtadvanceddocking/DockManager.h>
#include <qtadvanceddocking/FloatingDockContainer.h>

#include <QApplication>
#include <QFileInfo>
#include <QLineEdit>
#include <QMenuBar>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include "app/workstation/actions.h"
#include "app/workstation/document_stack.h"
#include "app/workstation/focus_keys.h"
#include "app/workstation/keys_everywhere.h"
#include "app/workstation/measure_commands.h"
#include "app/workstation/quit_question.h"
#include "app/workstation/unsaved_question.h"
#include "ui/panels/camera_calibration_panel.h"
#include "ui/panels/chain_calibration_panel.h"
#include "ui/panels/check_lamp.h"
#include "ui/panels/dock_style.h"
#include "ui/panels/head_panel.h"
#include "ui/panels/head_strip.h"
#include "ui/panels/link_panel.h"
#include "ui/panels/log_panel.h"
#include "ui/panels/log_strip.h"
#include "ui/panels/map_panel.h"
#include "ui/panels/mission_panel.h"
#include "ui/panels/mission_search_panel.h"
#include "ui/panels/notes_panel.h"
#include "ui/panels/objects_panel.h"
#include "ui/panels/options_panel.h"
#include "ui/panels/scan_check_panel.h"
#include "ui/panels/side_results_panel.h"
#include "ui/panels/source_gallery.h"
#include "ui/panels/task_strip.h"
#include "ui/panels/timeline_panel.h"
#include "ui/views/cloud_pane.h"
#include "ui/views/comparison_pane.h"
#include "ui/views/depth_pane.h"
#include "ui/views/image_pane.h"
#include "ui/views/measure_overlay.h"
#include "ui/widgets/wheel_guard.h"

namespace foresight {
namespace {

/// Counts up when docks come or go, so that an old layout is not forced on new docks.
constexpr int kLayoutVersion = 8;
const QString kLayoutKey = QStringLiteral("layout/docks");
const QString kGeometryKey = QStringLiteral("layout/window");
constexpr QSize kUsualSize(1600, 1000);
/// On a lower screen the mission shares a place with the head, the timeline with the cloud.
constexpr int kLowHeight = 800;

CloudPane* MakeCloudPane(Desk* desk) {
  auto* pane = new CloudPane({&desk->session, &desk->fit, &desk->map, &desk->clip});
  BindMeasurements(pane->Canvas(), &desk->session, &desk->measure);
  return pane;
}

ImagePane* MakeImagePane(Desk* desk) {
  auto* pane = new ImagePane(&desk->session, &desk->fit, &desk->layers);
  BindMeasurements(pane->Canvas(), &desk->session, &desk->measure);
  return pane;
}

DepthPane* MakeDepthPane(Desk* desk, LiveDepthViewModel* live) {
  auto* pane = new DepthPane(
      {&desk->session, &desk->depth, &desk->fit, &desk->layers, &desk->compare, live});
  BindMeasurements(pane->Canvas(), &desk->session, &desk->measure);
  return pane;
}

}  // namespace

MainWindow::MainWindow(Workbench* bench, QWidget* parent)
    : QMainWindow(parent),
      bench_(bench),
      files_(this, [bench] { return QFileInfo(bench->recording.Path()).path(); }),
      image_(MakeImagePane(&bench->live)),
      depth_(MakeDepthPane(&bench->live, &bench->live_depth)),
      cloud_(MakeCloudPane(&bench->live)),
      quit_question_(new QuitQuestion(&bench->head, this)),
      unsaved_question_(new UnsavedQuestion(
          &bench->recording, [this] { ChooseRecordingFile(); }, this)) {
  connect(unsaved_question_, &UnsavedQuestion::stayed, quit_question_, &QuitQuestion::Forget);
  connect(unsaved_question_, &UnsavedQuestion::stayed, this, &MainWindow::stayed);
  AddFileCommands();
  AddViewCommands();
  AddHelpCommands();
  AddCommandsOfResults();
  actions_ = new Actions(&bench_->commands, this);
  new KeysEverywhere(&bench_->commands, this);
  new FocusKeys(this);
  new WheelGuard(this);
  BuildMenus();
  BuildCentre();
  BuildDocks();
  for (Desk* desk : {&bench_->live, &bench_->review})
    connect(&desk->gallery, &SourceGalleryModel::finished, this, [this, desk] {
      gallery_->Show(desk->gallery.Answers());
      gallery_dock_->toggleView(true);
      docks_->setSplitterSizes(gallery_dock_->dockAreaWidget(), {380, 230, 390});
    });
  connect(bench_, &Workbench::shownChanged, this, &MainWindow::ShowDocument);
  connect(&bench_->reviewer, &ReviewViewModel::changed, this, &MainWindow::ShowDocument);
  connect(&bench_->replay, &ReplayModel::changed, this, &MainWindow::ShowDocument);
  ShowDocument();
  const QRect room = screen()->availableGeometry();
  resize(kUsualSize.boundedTo(room.size()));
  // The title and the frame need room too: else the lowest line would lie below the screen.
  if (room.width() <= kUsualSize.width() || room.height() <= kUsualSize.height())
    setWindowState(windowState() | Qt::WindowMaximized);
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  // Not before: only now the docks have the sizes that they are to come back to.
  if (first_layout_.isEmpty()) first_layout_ = docks_->saveState(kLayoutVersion);
  // Else Qt gives the focus to the first control that it finds, and Space acts on that.
  if (focusWidget() == nullptr) image_->Canvas()->setFocus();
}

void MainWindow::CloseUnasked() {
  quit_question_->Allow();
  close();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!isVisible()) return;  // it is closed
  if (!quit_question_->MayClose() || !unsaved_question_->MayClose()) {
    event->ignore();
    return;
  }
  layout_at_close_ = docks_->saveState(kLayoutVersion);
  // A dock left floating would keep the program alone, without the button that stops the head.
  for (ads::CFloatingDockContainer* floating : docks_->floatingWidgets()) floating->hide();
  QMainWindow::closeEvent(event);
}

void MainWindow::ShowComparison() {
  // Three canvases of OpenGL cost a second: they are made for who compares.
  if (comparison_ == nullptr) {
    comparison_ = new ComparisonPane(&bench_->side_results);
    comparison_dock_->widget()->layout()->addWidget(comparison_);
  }
  Open(comparison_dock_);
}

void MainWindow::BuildMenus() {
  addActions(actions_->All());
  const auto menu = [this](const char* id, const QString& title) {
    QMenu* added = menuBar()->addMenu(title);
    added->addActions(actions_->OfMenu(id));
    added->setToolTipsVisible(true);
    return added;
  };
  menu("file", tr("&File"));
  menu("edit", tr("&Edit"));
  menu("head", tr("&Head"));
  menu("object", tr("&Object"));
  menu("measure", tr("&Measure"));
  menu("review", tr("&Review"));
  view_menu_ = menu("view", tr("&View"));
  view_menu_->addSeparator();
  menu("help", tr("H&elp"));

  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->setIconSize({20, 20});
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar->addActions(actions_->OfToolBar());

  statusBar()->addPermanentWidget(
      Stack(MakeCheckLamp(&bench_->live), [this](Desk* desk) { return MakeCheckLamp(desk); }), 2);
  statusBar()->addPermanentWidget(new TaskStrip(&bench_->tasks), 1);
  statusBar()->setSizeGripEnabled(false);
}

void MainWindow::BuildCentre() {
  auto* centre = new QWidget;
  auto* layout = new QVBoxLayout(centre);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  strip_ = new HeadStrip(&bench_->head, &bench_->commands);
  log_ = new LogStrip(&bench_->log, &bench_->commands);
  layout->addWidget(strip_);
  layout->addWidget(log_);
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
  dock->setMinimumSizeHintMode(ads::CDockWidget::MinimumSizeHintFromContent);
  dock->setAccessibleName(title);
  view_menu_->addAction(dock->toggleViewAction());
  return dock;
}

DocumentStack* MainWindow::Stack(QWidget* live, std::function<QWidget*(Desk*)> make) {
  auto* stack =
      new DocumentStack(live, [this, make = std::move(make)] { return make(&bench_->review); });
  stacks_ << stack;
  return stack;
}

QWidget* MainWindow::MakeCheckLamp(Desk* desk) {
  auto* lamp = new CheckLamp(&desk->check);
  connect(lamp, &CheckLamp::clicked, this, [this] { bench_->commands.Run("view.check"); });
  return lamp;
}

void MainWindow::BuildDocks() {
  CommandTable* commands = &bench_->commands;
  const auto objects = [commands](Desk* desk) {
    return new ObjectsPanel(&desk->session, &desk->fit, commands);
  };
  const auto options = [](Desk* desk) { return new OptionsPanel(&desk->depth, &desk->fit); };
  mission_ = new MissionPanel(&bench_->recording, &bench_->reviewer, commands);
  gallery_ = new SourceGallery;
  search_ = new MissionSearchPanel(&bench_->search);
  connect(search_, &MissionSearchPanel::folderWanted, this, [this] {
    files_.Folder(tr("Search the missions of a folder"),
                  [this](const QString& folder) { bench_->search.SetFolder(folder); });
  });

  cloud_dock_ = Dock("cloud", tr("3D cloud"), Stack(cloud_, MakeCloudPane));
  auto* centre = docks_->addDockWidget(ads::CenterDockWidgetArea, cloud_dock_);
  auto* left = docks_->addDockWidget(
      ads::LeftDockWidgetArea, Dock("head", tr("Head"), new HeadPanel(&bench_->head, commands)));
  auto* right =
      docks_->addDockWidget(ads::RightDockWidgetArea,
                            Dock("objects", tr("Objects"), Stack(objects(&bench_->live), objects)));
  options_dock_ = Dock("options", tr("Options"), Stack(options(&bench_->live), options));
  docks_->addDockWidgetTabToArea(options_dock_, right);
  const auto notes = [commands](Desk* desk) {
    return new NotesPanel(&desk->session, &desk->measure, commands);
  };
  notes_dock_ = Dock("notes", tr("Notes"), Stack(notes(&bench_->live), notes));
  docks_->addDockWidgetTabToArea(notes_dock_, right);
  const auto map = [commands](Desk* desk) {
    return new MapPanel(&desk->map, &desk->clip, commands);
  };
  map_dock_ = Dock("map", tr("Map"), Stack(map(&bench_->live), map));
  docks_->addDockWidgetTabToArea(map_dock_, right);
  const auto check = [](Desk* desk) { return new ScanCheckPanel(&desk->check); };
  check_dock_ = Dock("check", tr("Self-check"), Stack(check(&bench_->live), check));
  docks_->addDockWidgetTabToArea(check_dock_, right);
  side_results_ = new SideResultsPanel(&bench_->side_results, commands);
  results_dock_ = Dock("side_results", tr("Side results"), side_results_);
  docks_->addDockWidgetTabToArea(results_dock_, right);
  calibration_ = new CameraCalibrationPanel(&bench_->camera_calibration, &bench_->tasks);
  calibration_dock_ = Dock("calibrate_camera", tr("Calibrate camera"), calibration_);
  docks_->addDockWidgetTabToArea(calibration_dock_, right);
  head_calibration_ = new ChainCalibrationPanel(&bench_->head_calibration, &bench_->tasks);
  head_calibration_dock_ = Dock("calibrate_head", tr("Calibrate head"), head_calibration_);
  docks_->addDockWidgetTabToArea(head_calibration_dock_, right);
  if (bench_->link)
    docks_->addDockWidgetTabToArea(Dock("link", tr("Link"), new LinkPanel(bench_->link.get())),
                                   right);
  right->setCurrentIndex(0);
  auto* top = docks_->addDockWidget(
      ads::TopDockWidgetArea, Dock("picture", tr("Image"), Stack(image_, MakeImagePane)), centre);
  docks_->addDockWidget(
      ads::RightDockWidgetArea,
      Dock(
          "depth", tr("Depth"),
          Stack(depth_, [this](Desk* desk) { return MakeDepthPane(desk, &bench_->replay_depth); })),
      top);
  auto* mission = Dock("mission", tr("Mission"), mission_);
  if (!OnLowScreen()) {
    docks_->addDockWidget(ads::BottomDockWidgetArea, mission, left);
    docks_->setSplitterSizes(left, {620, 240});
  } else {
    docks_->addDockWidgetTabToArea(mission, left);
    left->setCurrentIndex(0);
  }
  search_dock_ = Dock("search", tr("Search missions"), search_);
  docks_->addDockWidgetTabToArea(search_dock_, right);  // beside the mission it would be too high
  right->setCurrentIndex(0);
  timeline_dock_ =
      Dock("timeline", tr("Timeline"),
           new TimelinePanel(&bench_->timeline, &bench_->replay, &bench_->reviewer, commands));
  if (OnLowScreen())
    docks_->addDockWidgetTabToArea(timeline_dock_, centre);
  else
    docks_->addDockWidget(ads::BottomDockWidgetArea, timeline_dock_);
  gallery_dock_ = Dock("sources", tr("Sources"), gallery_);
  auto* log = Dock("log", tr("Messages"), new LogPanel(&bench_->log));
  auto* bottom = docks_->addDockWidget(ads::BottomDockWidgetArea, log, centre);
  docks_->addDockWidgetTabToArea(gallery_dock_, bottom);
  auto* comparison = new QWidget;
  (new QVBoxLayout(comparison))->setContentsMargins(0, 0, 0, 0);
  comparison_dock_ = Dock("comparison", tr("A and B"), comparison);
  docks_->addDockWidgetTabToArea(comparison_dock_, centre);
  centre->setCurrentIndex(0);
  comparison_dock_->toggleView(false);
  results_dock_->toggleView(false);
  notes_dock_->toggleView(false);
  map_dock_->toggleView(false);
  check_dock_->toggleView(false);
  log->toggleView(false);
  gallery_dock_->toggleView(false);
  search_dock_->toggleView(false);
  timeline_dock_->toggleView(false);
  calibration_dock_->toggleView(false);
  head_calibration_dock_->toggleView(false);
  docks_->setSplitterSizes(top, {500, 500});
  for (auto* splitter : docks_->findChildren<QSplitter*>())
    if (splitter->count() == 3 && splitter->orientation() == Qt::Horizontal)
      splitter->setSizes({290, 980, 330});
}

void MainWindow::Open(ads::CDockWidget* dock) {
  if (dock->isClosed()) dock->toggleView(true);
  dock->setAsCurrentTab();
}

void MainWindow::ShowDocument() {
  const bool review = bench_->ShowsReview();
  ShowTimeline(review);
  for (DocumentStack* stack : stacks_) stack->ShowDocument(review);
  mission_->ShowDocument(review);
  const ReviewViewModel& reviewer = bench_->reviewer;
  const QString file = QFileInfo(reviewer.Path()).fileName();
  strip_->ShowDocument(
      bench_->Shown().session.Mode(),
      tr("%1, scan %2 of %3").arg(file).arg(reviewer.ScanIndex() + 1).arg(reviewer.Scans().size()),
      bench_->replay.Active());
  setWindowTitle(review ? tr("Foresight, review of %1").arg(file) : tr("Foresight"));
}

/// It comes and goes with the review, unless the operator closed it there.
void MainWindow::ShowTimeline(bool review) {
  if (review == timeline_follows_) return;
  timeline_follows_ = review;
  if (!review) timeline_wanted_ = !timeline_dock_->isClosed();
  PlaceTimeline();
}

bool MainWindow::OnLowScreen() const {
  return screen()->availableGeometry().height() < kLowHeight;
}

void MainWindow::PlaceTimeline() {
  const bool wanted = timeline_follows_ && timeline_wanted_;
  if (timeline_dock_->isClosed() == wanted) timeline_dock_->toggleView(wanted);
  if (!wanted) return;
  if (OnLowScreen())
    cloud_dock_->setAsCurrentTab();
  else
    docks_->setSplitterSizes(timeline_dock_->dockAreaWidget(), {730, 245});
}

void MainWindow::SaveLayout(QSettings* settings) const {
  settings->setValue(kLayoutKey,
                     isVisible() ? docks_->saveState(kLayoutVersion) : layout_at_close_);
  settings->setValue(kGeometryKey, saveGeometry());
}

void MainWindow::RestoreLayout(const QSettings& settings) {
  restoreGeometry(settings.value(kGeometryKey).toByteArray());
  const QByteArray layout = settings.value(kLayoutKey).toByteArray();
  if (!layout.isEmpty()) docks_->restoreState(layout, kLayoutVersion);
  PlaceTimeline();
  BringFloatingDocksBack();
}

void MainWindow::BringFloatingDocksBack() {
  const QRect room = screen()->availableGeometry();
  for (ads::CFloatingDockContainer* floating : docks_->floatingWidgets()) {
    if (!floating->hasTopLevelDockWidget() && floating->dockWidgets().isEmpty()) continue;
    bool any_open = false;
    for (const ads::CDockWidget* dock : floating->dockWidgets())
      any_open = any_open || !dock->isClosed();
    if (!any_open) continue;
    // A dock that was saved on another screen, or collapsed, must be found again.
    const QSize size = floating->size().expandedTo({320, 240}).boundedTo(room.size());
    QRect place(floating->pos(), size);
    if (!room.contains(place.center())) place.moveCenter(room.center());
    place.moveTop(std::max(place.top(), room.top() + 40));
    floating->setGeometry(place);
    floating->show();
  }
}

void MainWindow::ResetLayout() {
  docks_->restoreState(first_layout_, kLayoutVersion);
  timeline_wanted_ = true;
  PlaceTimeline();
}

}  // namespace foresight
