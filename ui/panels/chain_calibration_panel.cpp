#include "ui/panels/chain_calibration_panel.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/panels/record_page.h"
#include "ui/panels/rig_version_row.h"
#include "ui/panels/solve_page.h"
#include "ui/panels/stand_page.h"
#include "ui/panels/verdict_view.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

/// Changes that come at once are drawn once.
constexpr int kChainShowDelay_ms = 30;

}  // namespace

ChainCalibrationPanel::ChainCalibrationPanel(ChainCalibrationModel* model, TaskQueue* tasks,
                                             QWidget* parent)
    : QWidget(parent),
      model_(model),
      state_(WordsLabel("headCalibrationState")),
      progress_(new QProgressBar),
      pages_(new QStackedWidget),
      stand_(new StandPage(model)),
      record_(new RecordPage(model)),
      solve_(new SolvePage(model)),
      verdict_(new VerdictView),
      rig_(new RigVersionRow(
          model->Rig(), {.what = tr("Write the rig in force with what was found as a new file"),
                         .why_not_save = [model] { return model->WhyNotSaveRig(); },
                         .suggested_file = [model] { return model->SuggestedRigFile(); },
                         .save = [model](const QString& path) { model->SaveRig(path); }})) {
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  for (QWidget* page : {static_cast<QWidget*>(stand_), static_cast<QWidget*>(record_),
                        static_cast<QWidget*>(solve_), BuildRig()})
    pages_->addWidget(VerticalScroll(page));
  auto* head = new QVBoxLayout;
  head->setContentsMargins(8, 8, 8, 0);
  head->setSpacing(6);
  head->addWidget(BuildSteps());
  head->addWidget(state_);
  head->addWidget(progress_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addLayout(head);
  layout->addWidget(pages_, 1);
  setMinimumWidth(280);

  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, &ChainCalibrationPanel::ShowAll);
  connect(model_, &ChainCalibrationModel::changed, this, &ChainCalibrationPanel::ShowSoon);
  connect(tasks, &TaskQueue::changed, this, &ChainCalibrationPanel::ShowProgress);
  ShowAll();
}

QWidget* ChainCalibrationPanel::BuildSteps() {
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2);
  steps_ = new QButtonGroup(this);
  const QStringList names = {tr("1 Stand"), tr("2 Record"), tr("3 Solve"), tr("4 Rig")};
  for (int i = 0; i < names.size(); ++i) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("step%1").arg(i + 1));
    button->setText(names[i]);
    button->setCheckable(true);
    button->setChecked(i == 0);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    steps_->addButton(button, i);
    row->addWidget(button);
  }
  connect(steps_, &QButtonGroup::idClicked, this,
          [this](int step) { GoTo(static_cast<Step>(step)); });
  return bar;
}

QWidget* ChainCalibrationPanel::BuildRig() {
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  layout->addWidget(verdict_);
  layout->addWidget(SectionTitle(tr("Rig")));
  layout->addWidget(rig_);
  layout->addStretch(1);
  return page;
}

void ChainCalibrationPanel::GoTo(Step step) {
  pages_->setCurrentIndex(step);
  steps_->button(step)->setChecked(true);
  ShowAll();
}

void ChainCalibrationPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ShowAll();
}

void ChainCalibrationPanel::ShowSoon() {
  if (isVisible() && !soon_.isActive()) soon_.start(kChainShowDelay_ms);
}

/// Of the pages only the one in sight.
void ChainCalibrationPanel::ShowAll() {
  state_->setText(model_->StateText());
  switch (pages_->currentIndex()) {
    case kStand:
      stand_->Refresh();
      break;
    case kRecord:
      record_->Refresh();
      break;
    case kSolve:
      solve_->Refresh();
      break;
    default:
      verdict_->Show(model_->Verdict());
      rig_->Refresh();
      break;
  }
  ShowProgress();
}

void ChainCalibrationPanel::ShowProgress() {
  if (!isVisible()) return;
  // Its place stays: what stands below must not jump.
  progress_->setValue(model_->Solving()   ? model_->SolvePermille()
                      : model_->Reading() ? model_->ReadPermille()
                                          : 0);
  solve_->ShowProgress();
}

}  // namespace foresight
