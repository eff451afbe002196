#include "ui/panels/stand_page.h"

#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/panels/board_fields.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QDoubleSpinBox* Number(double low, double high, const QString& suffix, const QString& name) {
  auto* box = new QDoubleSpinBox;
  box->setRange(low, high);
  box->setDecimals(1);
  box->setSuffix(suffix);
  box->setAccessibleName(name);
  box->setKeyboardTracking(false);
  return box;
}

/// Shows a value unless somebody types one.
template <class Box, class Value>
void ShowValue(Box* box, Value value) {
  const QSignalBlocker quiet(box);
  if (!box->hasFocus()) box->setValue(value);
}

}  // namespace

StandPage::StandPage(ChainCalibrationModel* model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      a_(new BoardFields),
      b_(new BoardFields),
      hinge_mm_(Number(0.0, 1000.0, tr(" mm"), tr("From the corners to the hinge"))),
      single_(new BoardFields),
      fault_(WordsLabel("fault")) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  layout->addWidget(SectionTitle(tr("Session")));
  layout->addWidget(BuildSession());
  layout->addWidget(SectionTitle(tr("Stand, board A (left)")));
  layout->addWidget(a_);
  layout->addWidget(SectionTitle(tr("Stand, board B (right)")));
  layout->addWidget(b_);
  auto* hinge = new QFormLayout;
  hinge->addRow(tr("Corners to hinge"), hinge_mm_);
  hinge_mm_->setToolTip(
      tr("From the inner corners next to the hinge to the hinge; the boards stand "
         "at about a right angle, what they really do is estimated"));
  layout->addLayout(hinge);
  layout->addWidget(SectionTitle(tr("Board for the camera alone")));
  layout->addWidget(single_);
  layout->addWidget(fault_);
  layout->addWidget(SectionTitle(tr("Stops of the motor")));
  layout->addWidget(BuildPlan());
  layout->addStretch(1);
  for (BoardFields* board : {a_, b_, single_})
    connect(board, &BoardFields::edited, this, &StandPage::TakeBoards);
  connect(hinge_mm_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this] { TakeBoards(); });
  Refresh();
}

QWidget* StandPage::BuildSession() {
  auto* box = new QWidget;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  auto* fresh =
      NarrowButton("newSession", tr("New"), tr("Begin anew; what is here is kept on the disk"));
  auto* open = NarrowButton("openSession", tr("Open..."), tr("Go on with a session's folder"));
  last_ = NarrowButton("openLastSession", tr("Open last"), tr("Go on with the session before"));
  folder_ = WordsLabel("faint");
  grid->addWidget(fresh, 0, 0);
  grid->addWidget(open, 0, 1);
  grid->addWidget(last_, 0, 2);
  grid->addWidget(folder_, 1, 0, 1, 3);
  connect(fresh, &QPushButton::clicked, model_, &ChainCalibrationModel::startNew);
  connect(open, &QPushButton::clicked, this, &StandPage::ChooseSession);
  connect(last_, &QPushButton::clicked, this, [this] {
    if (const QString last = model_->LastSession(); !last.isEmpty()) model_->OpenSession(last);
  });
  return box;
}

QWidget* StandPage::BuildPlan() {
  auto* box = new QWidget;
  auto* form = new QFormLayout(box);
  form->setContentsMargins(0, 0, 0, 0);
  first_ = Number(-90.0, 90.0, tr("°"), tr("First stop"));
  last_stop_ = Number(-90.0, 90.0, tr("°"), tr("Last stop"));
  step_ = Number(0.5, 90.0, tr("°"), tr("Between stops"));
  speed_ = Number(1.0, 120.0, tr(" °/s"), tr("Speed of the sweep"));
  speed_->setToolTip(tr("50 °/s and more tell the offset of the lidar's time stamps"));
  exposure_ = Number(0.1, 100.0, tr(" ms"), tr("Exposure"));
  exposure_->setToolTip(
      tr("Of all images of the calibration; white squares must not be saturated"));
  lines_ = new QSpinBox;
  lines_->setRange(1, StopPlan::kMostLines);
  lines_->setAccessibleName(tr("Lidar lines at a stop"));
  lines_->setKeyboardTracking(false);
  form->addRow(tr("From"), first_);
  form->addRow(tr("To"), last_stop_);
  form->addRow(tr("Step"), step_);
  form->addRow(tr("Lidar lines"), lines_);
  form->addRow(tr("Exposure"), exposure_);
  form->addRow(tr("Sweep"), speed_);
  for (QDoubleSpinBox* number : {first_, last_stop_, step_, exposure_, speed_})
    connect(number, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
            [this] { TakePlan(); });
  connect(lines_, QOverload<int>::of(&QSpinBox::valueChanged), this, [this] { TakePlan(); });
  return box;
}

void StandPage::TakeBoards() {
  const Status taken = model_->SetBoards(
      HingedMount(a_->Board(), b_->Board(), 1e-3 * hinge_mm_->value()), single_->Board());
  fault_->setText(taken ? QString() : QString::fromStdString(taken.error().message));
}

void StandPage::TakePlan() {
  StandPlan plan;
  plan.first_deg = first_->value();
  plan.last_deg = last_stop_->value();
  plan.step_deg = step_->value();
  plan.lines = lines_->value();
  plan.exposure_ms = exposure_->value();
  plan.sweep_speed_deg_s = speed_->value();
  model_->Recorder()->SetPlan(plan);
}

void StandPage::Refresh() {
  const BoardMount& mount = model_->Mount();
  a_->Show(mount.a);
  b_->setEnabled(mount.b.has_value());
  b_->Show(mount.b.value_or(mount.a));
  hinge_mm_->setEnabled(mount.b.has_value());
  ShowValue(hinge_mm_, -1e3 * mount.a_from_b.translation().z());
  single_->Show(model_->SingleBoard());
  const StandPlan& plan = model_->Recorder()->Plan();
  ShowValue(first_, plan.first_deg);
  ShowValue(last_stop_, plan.last_deg);
  ShowValue(step_, plan.step_deg);
  ShowValue(lines_, plan.lines);
  ShowValue(exposure_, plan.exposure_ms);
  ShowValue(speed_, plan.sweep_speed_deg_s);
  fault_->setVisible(!fault_->text().isEmpty());
  folder_->setText(model_->Folder());
  folder_->setVisible(!model_->Folder().isEmpty());
  last_->setEnabled(!model_->LastSession().isEmpty());
}

void StandPage::ChooseSession() {
  auto* dialog = new QFileDialog(this, tr("Open a calibration session"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("file_dialog"));
  dialog->setOption(QFileDialog::DontUseNativeDialog);  // it would keep F12 to itself
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, model_, &ChainCalibrationModel::OpenSession);
  dialog->setModal(false);
  dialog->show();
}

}  // namespace foresight
