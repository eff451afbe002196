#include "ui/panels/camera_calibration_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels/calibration_plots.h"
#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

/// Changes that come at once are drawn once.
constexpr int kShowDelay_ms = 30;
constexpr std::array<LensModel, 4> kModels = {LensModel::kFisheyeK, LensModel::kExtendedUnified,
                                              LensModel::kKannalaBrandt,
                                              LensModel::kRadialTangential};

/// As checkbox and table have room for it.
QString NameOf(LensModel model) {
  switch (model) {
    case LensModel::kFisheyeK:
      return CameraCalibrationPanel::tr("k");
    case LensModel::kExtendedUnified:
      return CameraCalibrationPanel::tr("EUCM");
    case LensModel::kKannalaBrandt:
      return CameraCalibrationPanel::tr("KB4");
    case LensModel::kRadialTangential:
      break;
  }
  return CameraCalibrationPanel::tr("radtan");
}

QLabel* Words(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QString::fromLatin1(name));
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

QIcon IconOf(const GrayImage& image) {
  QPixmap pixmap = EmptyThumbnail();
  if (!image.empty()) {
    const QImage borrowed(image.data(), image.width(), image.height(), image.width(),
                          QImage::Format_Grayscale8);
    pixmap = QPixmap::fromImage(
        borrowed.scaled(kThumbnailSize, Qt::KeepAspectRatio, Qt::SmoothTransformation));
  }
  // No second look for a row that is selected: it would tint the image.
  QIcon icon(pixmap);
  icon.addPixmap(pixmap, QIcon::Selected);
  return icon;
}

QString RatingText(const CalibrationImageRow& row) {
  QString text =
      CameraCalibrationPanel::tr("covers %1 %").arg(100.0 * row.rating.coverage, 0, 'f', 0);
  if (std::isfinite(row.rating.edge_width_px))
    text += CameraCalibrationPanel::tr(", edges %1 px").arg(row.rating.edge_width_px, 0, 'f', 1);
  return text;
}

/// Two lines: the name, and what became of the image.
QString TextOf(const CalibrationImageRow& row) {
  using State = CalibrationImageRow::State;
  switch (row.state) {
    case State::kReading:
    case State::kExcluded:
      return row.name + QLatin1Char('\n') + row.reason;
    case State::kRejected:
      return CameraCalibrationPanel::tr("%1\nnot used: %2").arg(row.name, row.reason);
    case State::kUsed:
      break;
  }
  const QString error = std::isfinite(row.rms_px)
                            ? CameraCalibrationPanel::tr("rms %1 px, ").arg(row.rms_px, 0, 'f', 2)
                            : QString();
  return row.name + QLatin1Char('\n') + error + RatingText(row);
}

QString Pixels(double value) {
  return std::isfinite(value) ? QString::number(value, 'f', 3) : QStringLiteral("–");
}

QColor ColorOf(CalibrationCheck::Level level) {
  switch (level) {
    case CalibrationCheck::Level::kGood:
      return state_color::kGood;
    case CalibrationCheck::Level::kCaution:
      return state_color::kCaution;
    case CalibrationCheck::Level::kBad:
      break;
  }
  return state_color::kBad;
}

/// A mark besides the colour, for who cannot tell colours apart.
QString MarkOf(CalibrationCheck::Level level) {
  switch (level) {
    case CalibrationCheck::Level::kGood:
      return QStringLiteral("✓");
    case CalibrationCheck::Level::kCaution:
      return QStringLiteral("!");
    case CalibrationCheck::Level::kBad:
      break;
  }
  return QStringLiteral("✗");
}

QTableWidget* MakeTable() {
  auto* table = new QTableWidget(0, 4);
  table->setHorizontalHeaderLabels(
      {CameraCalibrationPanel::tr("model"), CameraCalibrationPanel::tr("mean"),
       CameraCalibrationPanel::tr("rms"), CameraCalibrationPanel::tr("unseen")});
  table->horizontalHeaderItem(1)->setToolTip(CameraCalibrationPanel::tr(
      "Mean distance of corners in used images, px: the paper's measure"));
  table->horizontalHeaderItem(2)->setToolTip(
      CameraCalibrationPanel::tr("Root mean square of the same, px: OpenCV's measure"));
  table->horizontalHeaderItem(3)->setToolTip(CameraCalibrationPanel::tr(
      "Cross-validation: mean distance in images that were not used, px"));
  table->verticalHeader()->hide();
  table->setAccessibleName(CameraCalibrationPanel::tr("Camera models"));
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  table->horizontalHeader()->setMinimumSectionSize(40);
  return table;
}

}  // namespace

CameraCalibrationPanel::CameraCalibrationPanel(CameraCalibrationModel* model, TaskQueue* tasks,
                                               QWidget* parent)
    : QWidget(parent),
      model_(model),
      tasks_(tasks),
      next_(Words("nextHint")),
      state_(Words("calibrationState")),
      progress_(new QProgressBar),
      images_(new QListWidget),
      map_(new CoverageMap),
      bars_(new ViewBars),
      table_(MakeTable()),
      why_(Words("faint")),
      parameters_(Words("calibrationParameters")),
      verdict_(Words("calibrationVerdict")),
      checks_(Words("calibrationChecks")) {
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  images_->setAccessibleName(tr("Images of the board"));
  images_->setToolTip(tr("Clear the mark of an image to leave it out; Ctrl+Z takes that back"));
  images_->setIconSize(kThumbnailSize);
  images_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  images_->setWordWrap(true);
  images_->setFixedHeight(176);
  auto* inner = new QWidget;
  auto* layout = new QVBoxLayout(inner);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  layout->addWidget(SectionTitle(tr("Board")));
  layout->addWidget(BuildBoard());
  layout->addWidget(SectionTitle(tr("Images")));
  layout->addWidget(BuildSources());
  layout->addWidget(next_);
  layout->addWidget(state_);
  layout->addWidget(progress_);
  layout->addWidget(images_);
  layout->addWidget(map_);
  layout->addWidget(bars_);
  layout->addWidget(SectionTitle(tr("Camera")));
  layout->addWidget(BuildSolve());
  layout->addWidget(table_);
  layout->addWidget(why_);
  layout->addWidget(verdict_);
  layout->addWidget(checks_);
  layout->addWidget(parameters_);
  layout->addWidget(SectionTitle(tr("Rig")));
  layout->addWidget(BuildRig());
  layout->addStretch(1);
  FillWithScroll(this, inner);
  setMinimumWidth(240);

  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, &CameraCalibrationPanel::ShowAll);
  connect(model_, &CameraCalibrationModel::changed, this, &CameraCalibrationPanel::ShowSoon);
  connect(tasks_, &TaskQueue::changed, this, &CameraCalibrationPanel::ShowProgress);
  connect(images_, &QListWidget::itemChanged, this, &CameraCalibrationPanel::TakeCheck);
  connect(table_, &QTableWidget::cellClicked, model_,
          [this](int row, int) { model_->Choose(row); });
  ShowAll();
}

void CameraCalibrationPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ShowAll();
}

QPushButton* CameraCalibrationPanel::Button(const char* name, const QString& text,
                                            const QString& tip) {
  auto* button = new QPushButton(text);
  button->setObjectName(QString::fromLatin1(name));
  button->setToolTip(tip);
  // In a narrow dock the buttons of a row share what there is.
  button->setStyleSheet(QStringLiteral("padding: 6px 4px;"));
  button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  return button;
}

QWidget* CameraCalibrationPanel::BuildBoard() {
  auto* row = new QWidget;
  auto* grid = new QGridLayout(row);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(3, 1);
  kind_ = new QComboBox;
  kind_->addItems({tr("Checkerboard"), tr("ChArUco, 5x5_250")});
  kind_->setAccessibleName(tr("Kind of board"));
  kind_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  kind_->setMinimumContentsLength(6);
  const auto number = [](const QString& name) {
    auto* box = new QSpinBox;
    box->setRange(3, 60);
    box->setAccessibleName(name);
    box->setToolTip(CameraCalibrationPanel::tr("Inner corners: where two black squares touch"));
    box->setKeyboardTracking(false);
    box->setMinimumWidth(56);
    return box;
  };
  columns_ = number(tr("Inner corners in a row"));
  rows_ = number(tr("Inner corners in a column"));
  square_mm_ = new QDoubleSpinBox;
  square_mm_->setRange(1.0, 1000.0);
  square_mm_->setDecimals(2);
  square_mm_->setSuffix(tr(" mm"));
  square_mm_->setAccessibleName(tr("Side of a square"));
  square_mm_->setKeyboardTracking(false);
  grid->addWidget(kind_, 0, 0, 1, 4);
  grid->addWidget(new QLabel(tr("Corners")), 1, 0);
  grid->addWidget(columns_, 1, 1);
  grid->addWidget(new QLabel(QStringLiteral("×")), 1, 2);
  grid->addWidget(rows_, 1, 3);
  grid->addWidget(new QLabel(tr("Square")), 2, 0);
  grid->addWidget(square_mm_, 2, 1, 1, 3);
  connect(kind_, QOverload<int>::of(&QComboBox::activated), this, [this] { TakeBoard(); });
  for (QSpinBox* box : {columns_, rows_})
    connect(box, QOverload<int>::of(&QSpinBox::valueChanged), this, [this] { TakeBoard(); });
  connect(square_mm_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this] { TakeBoard(); });
  return row;
}

QWidget* CameraCalibrationPanel::BuildSources() {
  auto* row = new QWidget;
  auto* grid = new QGridLayout(row);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  auto* add = Button("addImages", tr("Add images..."), tr("Image files: PNG, JPEG or PGM"));
  auto* folder = Button("addFolder", tr("Add folder..."), tr("All images of a folder"));
  take_ = Button("takeFromHead", tr("Take from head"), {});
  auto* fresh = Button("startNew", tr("New"), tr("Begin anew; what is here is kept on the disk"));
  last_ = Button("openLast", tr("Open last"), tr("Go on with the calibration before this one"));
  grid->addWidget(add, 0, 0);
  grid->addWidget(folder, 0, 1);
  grid->addWidget(take_, 1, 0, 1, 2);
  grid->addWidget(fresh, 2, 0);
  grid->addWidget(last_, 2, 1);
  connect(add, &QPushButton::clicked, this, [this] { ChooseImages(false); });
  connect(folder, &QPushButton::clicked, this, [this] { ChooseImages(true); });
  connect(take_, &QPushButton::clicked, model_, &CameraCalibrationModel::takeFromHead);
  connect(fresh, &QPushButton::clicked, model_, &CameraCalibrationModel::startNew);
  connect(last_, &QPushButton::clicked, this, [this] {
    if (const QString last = model_->LastSession(); !last.isEmpty()) model_->OpenSession(last);
  });
  return row;
}

QWidget* CameraCalibrationPanel::BuildSolve() {
  auto* row = new QWidget;
  auto* grid = new QGridLayout(row);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  for (int i = 0; i < static_cast<int>(kModels.size()); ++i) {
    auto* box = new QCheckBox(NameOf(kModels[static_cast<std::size_t>(i)]));
    box->setToolTip(tr("Fit this model too; the one that predicts unused images best is chosen"));
    connect(box, &QCheckBox::clicked, this, &CameraCalibrationPanel::TakeModels);
    wanted_.push_back(box);
    grid->addWidget(box, i / 2, i % 2);
  }
  solve_ = Button("solveCamera", tr("Solve"),
                  tr("Calibrate again; after each change that happens by itself"));
  cancel_ = Button("cancelCalibration", tr("Cancel"), tr("Stop what is being computed"));
  grid->addWidget(solve_, 2, 0);
  grid->addWidget(cancel_, 2, 1);
  connect(solve_, &QPushButton::clicked, model_, &CameraCalibrationModel::solve);
  connect(cancel_, &QPushButton::clicked, model_, &CameraCalibrationModel::cancel);
  return row;
}

QWidget* CameraCalibrationPanel::BuildRig() {
  auto* box = new QWidget;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  save_ = Button("saveRig", tr("Save rig..."), {});
  force_ = Button("putInForce", tr("Put in force"), {});
  back_ = Button("rollBack", tr("Roll back"), {});
  saved_ = Words("faint");
  grid->addWidget(save_, 0, 0);
  grid->addWidget(force_, 0, 1);
  grid->addWidget(back_, 1, 0, 1, 2);
  grid->addWidget(saved_, 2, 0, 1, 2);
  connect(save_, &QPushButton::clicked, this, &CameraCalibrationPanel::ChooseRigFile);
  connect(force_, &QPushButton::clicked, model_->Rig(), &RigVersionModel::putInForce);
  connect(back_, &QPushButton::clicked, model_->Rig(), &RigVersionModel::rollBack);
  return box;
}

void CameraCalibrationPanel::TakeBoard() {
  CalibrationBoard board = model_->Board();
  board.kind = kind_->currentIndex() == 0 ? CalibrationBoard::Kind::kCheckerboard
                                          : CalibrationBoard::Kind::kCharuco;
  board.columns = columns_->value();
  board.rows = rows_->value();
  board.square_m = 1e-3 * square_mm_->value();
  const Status taken = model_->SetBoard(board);
  state_->setText(taken ? model_->StateText() : QString::fromStdString(taken.error().message));
}

void CameraCalibrationPanel::TakeModels() {
  std::vector<LensModel> models;
  for (std::size_t i = 0; i < kModels.size(); ++i)
    if (wanted_[i]->isChecked()) models.push_back(kModels[i]);
  model_->SetModels(models);
}

void CameraCalibrationPanel::TakeCheck(const QListWidgetItem* item) {
  model_->SetExcluded(images_->row(item), item->checkState() != Qt::Checked);
}

void CameraCalibrationPanel::ShowSoon() {
  if (isVisible() && !soon_.isActive()) soon_.start(kShowDelay_ms);
}

void CameraCalibrationPanel::ShowAll() {
  ShowBoard();
  ShowImages();
  const ModelCalibration* chosen = model_->ChosenModel();
  map_->Show(model_->Coverage(), model_->ImageWidth(), model_->ImageHeight(),
             chosen != nullptr ? chosen->images : std::vector<ImageErrors>());
  bars_->Show(model_->Coverage());
  ShowModels();
  ShowVerdict();
  ShowProgress();
  ShowButtons();
  state_->setText(model_->StateText());
  next_->setText(model_->Next());
}

void CameraCalibrationPanel::ShowBoard() {
  const CalibrationBoard& board = model_->Board();
  const QSignalBlocker quiet_columns(columns_), quiet_rows(rows_), quiet_square(square_mm_);
  kind_->setCurrentIndex(board.kind == CalibrationBoard::Kind::kCheckerboard ? 0 : 1);
  // Not while somebody types into it.
  if (!columns_->hasFocus()) columns_->setValue(board.columns);
  if (!rows_->hasFocus()) rows_->setValue(board.rows);
  if (!square_mm_->hasFocus()) square_mm_->setValue(1e3 * board.square_m);
}

void CameraCalibrationPanel::ShowImages() {
  const QSignalBlocker quiet(images_);
  const auto& rows = model_->Images();
  while (images_->count() > static_cast<int>(rows.size()))
    delete images_->takeItem(images_->count() - 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CalibrationImageRow& row = rows[i];
    if (static_cast<int>(i) >= images_->count()) images_->addItem(new QListWidgetItem);
    QListWidgetItem* item = images_->item(static_cast<int>(i));
    const QString key = row.name + QString::number(row.thumbnail.width());
    if (item->data(Qt::UserRole).toString() != key) {
      item->setIcon(IconOf(row.thumbnail));
      item->setData(Qt::UserRole, key);
    }
    item->setText(TextOf(row));
    item->setToolTip(row.reason.isEmpty() ? row.origin
                                          : row.origin + QLatin1Char('\n') + row.reason);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    const bool excluded = row.state == CalibrationImageRow::State::kExcluded;
    item->setCheckState(excluded ? Qt::Unchecked : Qt::Checked);
    const bool bad = row.state == CalibrationImageRow::State::kRejected;
    item->setForeground(bad ? QBrush(state_color::kCaution) : palette().brush(QPalette::Text));
  }
  images_->setVisible(!rows.empty());
}

void CameraCalibrationPanel::ShowModels() {
  const std::vector<CalibrationModelRow> rows = model_->ModelRows();
  table_->setRowCount(static_cast<int>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CalibrationModelRow& row = rows[i];
    const QStringList texts = {NameOf(row.model), Pixels(row.mean_error_px), Pixels(row.rms_px),
                               Pixels(row.cross_validation_px)};
    for (int column = 0; column < texts.size(); ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      item->setToolTip(row.title + QLatin1Char('\n') +
                       (row.failure.isEmpty() ? row.parameters : row.failure));
      if (!row.failure.isEmpty()) item->setForeground(state_color::kCaution);
      if (column > 0) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(static_cast<int>(i), column, item);
    }
  }
  if (model_->Chosen() >= 0) table_->selectRow(model_->Chosen());
  table_->setVisible(!rows.empty());
  table_->setFixedHeight(table_->horizontalHeader()->height() + table_->verticalHeader()->length() +
                         2 * table_->frameWidth());
  const bool chosen = model_->ChosenModel() != nullptr;
  why_->setText(model_->WhyChosen());
  why_->setVisible(chosen);
  parameters_->setVisible(chosen);
  if (chosen) parameters_->setText(rows[static_cast<std::size_t>(model_->Chosen())].parameters);
  const auto& wanted = model_->Models();
  for (std::size_t i = 0; i < kModels.size(); ++i)
    wanted_[i]->setChecked(std::find(wanted.begin(), wanted.end(), kModels[i]) != wanted.end());
}

void CameraCalibrationPanel::ShowVerdict() {
  const std::vector<CalibrationCheck> checks = model_->Verdict();
  verdict_->setVisible(!checks.empty());
  checks_->setVisible(!checks.empty());
  if (checks.empty()) return;
  const CalibrationCheck summary = model_->VerdictSummary();
  verdict_->setText(summary.text);
  verdict_->setStyleSheet(QStringLiteral("color: #16181c; background: %1; border-radius: 4px; "
                                         "padding: 4px 8px; font-weight: bold;")
                              .arg(ColorOf(summary.level).name()));
  QStringList lines;
  for (const CalibrationCheck& check : checks)
    lines << MarkOf(check.level) + QLatin1Char(' ') + check.text;
  checks_->setText(lines.join(QLatin1Char('\n')));
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
  const auto show = [](QPushButton* button, const QString& tip, const QString& why_not) {
    button->setEnabled(why_not.isEmpty());
    button->setToolTip(why_not.isEmpty() ? tip : tip + QLatin1Char('\n') + why_not);
  };
  show(take_, tr("Add the image of the live document"), model_->WhyNotTakeFromHead());
  show(save_, tr("Write the rig in force with this camera as a new file"), model_->WhyNotSaveRig());
  show(force_, tr("Give the saved rig to the head, read it back and compare"),
       model_->Rig()->WhyNotPutInForce());
  show(back_, tr("Give the head the rig that it had before"), model_->Rig()->WhyNotRollBack());
  last_->setEnabled(!model_->LastSession().isEmpty());
  solve_->setEnabled(model_->UsedCount() > 0);
  const QString file = model_->Rig()->SavedFile();
  saved_->setText(file.isEmpty() ? QString() : tr("Saved: %1").arg(file));
  saved_->setVisible(!file.isEmpty());
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

void CameraCalibrationPanel::ChooseRigFile() {
  auto* dialog = new QFileDialog(this, tr("Save as a new rig"), {}, tr("Rigs (*.yaml)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("file_dialog"));
  dialog->setOption(QFileDialog::DontUseNativeDialog);
  dialog->setOption(QFileDialog::DontConfirmOverwrite);  // an existing file is refused
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("yaml"));
  const QFileInfo suggested(model_->SuggestedRigFile());
  dialog->setDirectory(suggested.path());
  dialog->selectFile(suggested.fileName());
  connect(dialog, &QFileDialog::fileSelected, model_, &CameraCalibrationModel::SaveRig);
  dialog->setModal(false);
  dialog->show();
}

}  // namespace foresight
