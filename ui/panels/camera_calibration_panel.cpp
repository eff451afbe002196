#include "ui/panels/camera_calibration_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "ui/panels/board_fields.h"
#include "ui/panels/calibration_image_list.h"
#include "ui/panels/calibration_plots.h"
#include "ui/panels/camera_model_table.h"
#include "ui/panels/field_map.h"
#include "ui/panels/live_board_view.h"
#include "ui/panels/rig_version_row.h"
#include "ui/panels/verdict_view.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

/// Changes that come at once are drawn once.
constexpr int kShowDelay_ms = 30;
constexpr std::array<LensModel, 4> kModels = {LensModel::kFisheyeK, LensModel::kExtendedUnified,
                                              LensModel::kKannalaBrandt,
                                              LensModel::kRadialTangential};
enum Map { kCorners, kUncertainty, kUncertaintyAtInfinity, kHalves, kHalvesAtInfinity };
/// Where the colours of a map end: what a good calibration stays below.
constexpr double kFullUncertainty_px = 0.5;
constexpr double kFullHalves_px = 1.0;

}  // namespace

CameraCalibrationPanel::CameraCalibrationPanel(CameraCalibrationModel* model, TaskQueue* tasks,
                                               QWidget* parent)
    : QWidget(parent),
      model_(model),
      tasks_(tasks),
      board_(new BoardFields),
      next_(WordsLabel("nextHint")),
      state_(WordsLabel("calibrationState")),
      progress_(new QProgressBar),
      images_(new CalibrationImageList),
      map_(new CoverageMap),
      field_(new FieldMap),
      bars_(new ViewBars),
      table_(new CameraModelTable),
      why_(WordsLabel("faint")),
      parameters_(WordsLabel("calibrationParameters")),
      verdict_(new VerdictView),
      rig_(new RigVersionRow(model->Rig(),
                             {.what = tr("Write the rig in force with this camera as a new file"),
                              .why_not_save = [model] { return model->WhyNotSaveRig(); },
                              .suggested_file = [model] { return model->SuggestedRigFile(); },
                              .save = [model](const QString& path) { model->SaveRig(path); }})) {
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  auto* inner = new QWidget;
  auto* layout = new QVBoxLayout(inner);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  layout->addWidget(SectionTitle(tr("Board")));
  layout->addWidget(board_);
  layout->addWidget(SectionTitle(tr("Images")));
  layout->addWidget(BuildSources());
  layout->addWidget(new LiveBoardView(model->Live()));
  layout->addWidget(next_);
  layout->addWidget(state_);
  layout->addWidget(progress_);
  layout->addWidget(images_);
  layout->addWidget(BuildMaps());
  layout->addWidget(map_);
  layout->addWidget(field_);
  layout->addWidget(bars_);
  layout->addWidget(SectionTitle(tr("Camera")));
  layout->addWidget(BuildSolve());
  layout->addWidget(table_);
  layout->addWidget(why_);
  layout->addWidget(verdict_);
  layout->addWidget(parameters_);
  layout->addWidget(SectionTitle(tr("Rig")));
  layout->addWidget(rig_);
  layout->addStretch(1);
  FillWithScroll(this, inner);
  setMinimumWidth(240);

  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, &CameraCalibrationPanel::ShowAll);
  connect(model_, &CameraCalibrationModel::changed, this, &CameraCalibrationPanel::ShowSoon);
  connect(tasks_, &TaskQueue::changed, this, &CameraCalibrationPanel::ShowProgress);
  connect(board_, &BoardFields::edited, this, &CameraCalibrationPanel::TakeBoard);
  connect(images_, &CalibrationImageList::marked, model_, &CameraCalibrationModel::SetExcluded);
  connect(table_, &QTableWidget::cellClicked, model_,
          [this](int row, int) { model_->Choose(row); });
  ShowAll();
}

void CameraCalibrationPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ShowAll();
}

QWidget* CameraCalibrationPanel::BuildSources() {
  auto* row = new QWidget;
  auto* grid = new QGridLayout(row);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  auto* add = NarrowButton("addImages", tr("Add images..."), tr("Image files: PNG, JPEG or PGM"));
  auto* folder = NarrowButton("addFolder", tr("Add folder..."), tr("All images of a folder"));
  take_ = NarrowButton("takeFromHead", tr("Take from head"));
  capture_ = NarrowButton("captureFromHead", tr("Capture"));
  auto* fresh =
      NarrowButton("startNew", tr("New"), tr("Begin anew; what is here is kept on the disk"));
  last_ =
      NarrowButton("openLast", tr("Open last"), tr("Go on with the calibration before this one"));
  grid->addWidget(add, 0, 0);
  grid->addWidget(folder, 0, 1);
  grid->addWidget(capture_, 1, 0);
  grid->addWidget(take_, 1, 1);
  grid->addWidget(fresh, 2, 0);
  grid->addWidget(last_, 2, 1);
  connect(add, &QPushButton::clicked, this, [this] { ChooseImages(false); });
  connect(folder, &QPushButton::clicked, this, [this] { ChooseImages(true); });
  connect(take_, &QPushButton::clicked, model_, &CameraCalibrationModel::takeFromHead);
  connect(capture_, &QPushButton::clicked, model_, &CameraCalibrationModel::captureFromHead);
  connect(fresh, &QPushButton::clicked, model_, &CameraCalibrationModel::startNew);
  connect(last_, &QPushButton::clicked, this, [this] {
    if (const QString last = model_->LastSession(); !last.isEmpty()) model_->OpenSession(last);
  });
  return row;
}

QWidget* CameraCalibrationPanel::BuildMaps() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  which_map_ = new QComboBox;
  which_map_->setObjectName(QStringLiteral("whichMap"));
  which_map_->setAccessibleName(tr("What is mapped over the image"));
  which_map_->addItems({tr("Corners and residuals"), tr("Uncertainty at"),
                        tr("Uncertainty at infinity"), tr("Odd against even at"),
                        tr("Odd against even at infinity")});
  which_map_->setToolTip(tr(
      "Uncertainty: one standard deviation of where a point appears, in the worst direction. Odd "
      "against even: how far two cameras differ, each from every second image."));
  which_map_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  map_distance_ = new QDoubleSpinBox;
  map_distance_->setRange(0.1, 100.0);
  map_distance_->setValue(2.0);
  map_distance_->setDecimals(1);
  map_distance_->setSuffix(tr(" m"));
  map_distance_->setAccessibleName(tr("Distance of the map"));
  map_distance_->setKeyboardTracking(false);
  layout->addWidget(which_map_, 1);
  layout->addWidget(map_distance_);
  connect(which_map_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          [this] { WantMap(); });
  connect(map_distance_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this] { WantMap(); });
  return row;
}

void CameraCalibrationPanel::WantMap() {
  model_->WantMaps(which_map_->currentIndex() == kCorners ? 0.0 : map_distance_->value());
  ShowMap();
}

void CameraCalibrationPanel::ShowMap() {
  const ModelCalibration* chosen = model_->ChosenModel();
  map_->Show(model_->Coverage(), model_->ImageWidth(), model_->ImageHeight(),
             chosen != nullptr ? chosen->images : std::vector<ImageErrors>());
  const int which = which_map_->currentIndex();
  const CameraMaps* maps = model_->Maps().get();
  map_distance_->setVisible(which == kUncertainty || which == kHalves);
  map_->setVisible(which == kCorners || maps == nullptr);
  field_->setVisible(which != kCorners && maps != nullptr);
  if (!field_->isVisibleTo(this)) return;
  const bool halves = which == kHalves || which == kHalvesAtInfinity;
  const ImageField& field = which == kUncertainty             ? maps->uncertainty
                            : which == kUncertaintyAtInfinity ? maps->uncertainty_at_infinity
                            : which == kHalves                ? maps->halves
                                                              : maps->halves_at_infinity;
  field_->Show(field, halves ? kFullHalves_px : kFullUncertainty_px);
}

QWidget* CameraCalibrationPanel::BuildSolve() {
  auto* row = new QWidget;
  auto* grid = new QGridLayout(row);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  for (int i = 0; i < static_cast<int>(kModels.size()); ++i) {
    auto* box = new QCheckBox(ShortNameOf(kModels[static_cast<std::size_t>(i)]));
    box->setToolTip(tr("Fit this model too; the one that predicts unused images best is chosen"));
    connect(box, &QCheckBox::clicked, this, &CameraCalibrationPanel::TakeModels);
    wanted_.push_back(box);
    grid->addWidget(box, i / 2, i % 2);
  }
  solve_ = NarrowButton("solveCamera", tr("Solve"),
                        tr("Calibrate again; after each change that happens by itself"));
  cancel_ = NarrowButton("cancelCalibration", tr("Cancel"), tr("Stop what is being computed"));
  grid->addWidget(solve_, 2, 0);
  grid->addWidget(cancel_, 2, 1);
  connect(solve_, &QPushButton::clicked, model_, &CameraCalibrationModel::solve);
  connect(cancel_, &QPushButton::clicked, model_, &CameraCalibrationModel::cancel);
  return row;
}

void CameraCalibrationPanel::TakeBoard() {
  const Status taken = model_->SetBoard(board_->Board());
  state_->setText(taken ? model_->StateText() : QString::fromStdString(taken.error().message));
}

void CameraCalibrationPanel::TakeModels() {
  std::vector<LensModel> models;
  for (std::size_t i = 0; i < kModels.size(); ++i)
    if (wanted_[i]->isChecked()) models.push_back(kModels[i]);
  model_->SetModels(models);
}

void CameraCalibrationPanel::ShowSoon() {
  if (isVisible() && !soon_.isActive()) soon_.start(kShowDelay_ms);
}

void CameraCalibrationPanel::ShowAll() {
  board_->Show(model_->Board());
  images_->Show(model_->Images());
  ShowMap();
  bars_->Show(model_->Coverage());
  ShowModels();
  verdict_->Show(model_->Verdict());
  ShowProgress();
  ShowButtons();
  state_->setText(model_->StateText());
  next_->setText(model_->Next());
}

void CameraCalibrationPanel::ShowModels() {
  const std::vector<CalibrationModelRow> rows = model_->ModelRows();
  table_->Show(rows, model_->Chosen());
  const bool chosen = model_->ChosenModel() != nullptr;
  why_->setText(model_->WhyChosen());
  why_->setVisible(chosen);
  parameters_->setVisible(chosen);
  if (chosen) parameters_->setText(rows[static_cast<std::size_t>(model_->Chosen())].parameters);
  const auto& wanted = model_->Models();
  for (std::size_t i = 0; i < kModels.size(); ++i)
    wanted_[i]->setChecked(std::find(wanted.begin(), wanted.end(), kModels[i]) != wanted.end());
}

void CameraCalibrationPanel::ShowProgress() {
  if (!isVisible()) return;
  const bool busy = model_->Reading() || model_->Solving();
  // Its place stays: what stands below must not jump.
  progress_->setValue(busy ? (model_->Solving() ? model_->SolvePermille() : model_->ReadPermille())
                           : 0);
  cancel_->setEnabled(busy);
}

void CameraCalibrationPanel::ShowButtons() {
  ShowPossible(capture_, tr("Take an image where the head stands now, and add it"),
               model_->WhyNotCapture());
  ShowPossible(take_, tr("Add the image of the live document"), model_->WhyNotTakeFromHead());
  last_->setEnabled(!model_->LastSession().isEmpty());
  solve_->setEnabled(model_->UsedCount() > 0);
  rig_->Refresh();
}

void CameraCalibrationPanel::ChooseImages(bool folder) {
  auto* dialog =
      new QFileDialog(this, folder ? tr("Add the images of a folder") : tr("Add images"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("file_dialog"));
  dialog->setOption(QFileDialog::DontUseNativeDialog);  // it would keep F12 to itself
  dialog->setFileMode(folder ? QFileDialog::Directory : QFileDialog::ExistingFiles);
  if (folder)
    dialog->setOption(QFileDialog::ShowDirsOnly);
  else
    dialog->setNameFilter(tr("Images (*.png *.jpg *.jpeg *.pgm *.PNG *.JPG *.JPEG *.PGM)"));
  connect(dialog, &QFileDialog::filesSelected, model_, &CameraCalibrationModel::AddFiles);
  dialog->setModal(false);  // a scan may be running: the stop button must stay within reach
  dialog->show();
}

}  // namespace foresight
