#include "ui/panels/solve_page.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <array>

#include "ui/panels/board_bars.h"
#include "ui/panels/calibration_plots.h"
#include "ui/panels/lidar_image_view.h"
#include "ui/panels/stand_lamps.h"
#include "ui/panels/verdict_view.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

constexpr std::array<CalibrationStage, 4> kStages = {
    CalibrationStage::kAll, CalibrationStage::kMotor, CalibrationStage::kLidar,
    CalibrationStage::kTime};
enum Plot { kLidarAfter, kLidarBefore, kCorners, kBoards };

}  // namespace

SolvePage::SolvePage(ChainCalibrationModel* model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      graph_(WordsLabel("motorGraph")),
      verdict_(new VerdictView),
      weakest_(WordsLabel("weakest")),
      lamps_(new StandLamps),
      corners_(new CoverageMap),
      lidar_(new LidarImageView),
      boards_(new BoardBars) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  layout->addWidget(BuildSolve());
  layout->addWidget(graph_);
  layout->addWidget(verdict_);
  layout->addWidget(weakest_);
  layout->addWidget(BuildPlots());
  layout->addStretch(1);
  Refresh();
}

QWidget* SolvePage::BuildSolve() {
  auto* box = new QWidget;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  stage_ = new QComboBox;
  stage_->addItems({tr("All together"), tr("Camera and motor"), tr("Then the lidar"),
                    tr("Then its time stamps")});
  stage_->setAccessibleName(tr("How far is calibrated"));
  stage_->setToolTip(
      tr("One step after the other, or all in one problem: only that tells how well "
         "each value is known"));
  solve_ = NarrowButton("solveHead", tr("Solve"));
  cancel_ = NarrowButton("cancelHead", tr("Cancel"), tr("Stop what is being computed"));
  grid->addWidget(stage_, 0, 0, 1, 2);
  grid->addWidget(solve_, 1, 0);
  grid->addWidget(cancel_, 1, 1);
  connect(stage_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int at) { model_->SetStage(kStages[static_cast<std::size_t>(at)]); });
  connect(solve_, &QPushButton::clicked, model_, &ChainCalibrationModel::solve);
  connect(cancel_, &QPushButton::clicked, model_, &ChainCalibrationModel::cancel);
  return box;
}

QWidget* SolvePage::BuildPlots() {
  plots_ = new QWidget;
  auto* layout = new QVBoxLayout(plots_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  plot_ = new QComboBox;
  plot_->setObjectName(QStringLiteral("plot"));
  plot_->setAccessibleName(tr("What is plotted"));
  plot_->addItems({tr("Lidar on the image, after"), tr("Lidar on the image, before"),
                   tr("Corners: residuals"), tr("Boards: residuals")});
  layout->addWidget(SectionTitle(tr("Residuals")));
  layout->addWidget(plot_);
  layout->addWidget(lamps_);
  for (QWidget* plot : {static_cast<QWidget*>(lidar_), static_cast<QWidget*>(corners_),
                        static_cast<QWidget*>(boards_)})
    layout->addWidget(plot);
  connect(plot_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &SolvePage::ShowPlot);
  connect(lamps_, &StandLamps::selected, model_, &ChainCalibrationModel::Select);
  return plots_;
}

void SolvePage::Refresh() {
  for (std::size_t i = 0; i < kStages.size(); ++i)
    if (kStages[i] == model_->Stage()) stage_->setCurrentIndex(static_cast<int>(i));
  ShowPossible(solve_, tr("Calibrate; after each further change that happens by itself"),
               model_->WhyNotSolve());
  const QString graph = model_->GraphInWords();
  graph_->setText(graph);
  graph_->setVisible(!graph.isEmpty());
  verdict_->Show(model_->Verdict());
  weakest_->setText(model_->Weakest());
  weakest_->setVisible(!model_->Weakest().isEmpty());
  plots_->setVisible(model_->Solution() != nullptr);
  ShowPlot();
  ShowProgress();
}

void SolvePage::ShowProgress() {
  cancel_->setEnabled(model_->Reading() || model_->Solving());
}

void SolvePage::ShowPlot() {
  const std::shared_ptr<const ChainSolution> solution = model_->Solution();
  if (!solution) {
    shown_.reset();
    return;
  }
  const int plot = plot_->currentIndex();
  const bool on_image = plot == kLidarAfter || plot == kLidarBefore;
  lamps_->setVisible(on_image);
  lidar_->setVisible(on_image);
  corners_->setVisible(plot == kCorners);
  boards_->setVisible(plot == kBoards);
  if (on_image) {
    lamps_->Show(model_->Places(), model_->SelectedPlace(), model_->SelectedStop());
    lidar_->Show(
        model_->SelectedImage(), model_->SelectedView(), model_->ImageWidth(),
        model_->ImageHeight(), model_->SelectedPoints(),
        plot == kLidarAfter ? LidarImageView::Which::kAfter : LidarImageView::Which::kBefore);
  }
  if (solution == shown_) return;
  shown_ = solution;
  corners_->Show({}, model_->ImageWidth(), model_->ImageHeight(), solution->errors);
  QStringList poses;
  for (const PatternPose& pose : model_->Session()->poses)
    poses << QString::fromStdString(pose.name);
  boards_->Show(solution->boards, poses);
}

}  // namespace foresight
