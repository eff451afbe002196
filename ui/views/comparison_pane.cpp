#include "ui/views/comparison_pane.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QScrollArea>
#include <QSplitter>
#include <QVBoxLayout>

#include "core/pictures/difference_picture.h"
#include "ui/render/point_set.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

constexpr double kFullScale_mm = 1000.0 * DepthComparison::kFullScale_m;

QLabel* Words(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QString::fromLatin1(name));
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

PointSet CloudOf(const ResultComparison::MeasuredCloud& cloud, const ComparedResult& result) {
  std::vector<float> distances_mm;
  distances_mm.reserve(cloud.distances_m.size());
  for (const float distance_m : cloud.distances_m) distances_mm.push_back(1000.0f * distance_m);
  return PointsOf(cloud.points, std::move(distances_mm),
                  result.rig.robot_from_base.translation().cast<float>());
}

QString Count(std::int64_t pixels) {
  return QLocale().toString(static_cast<qlonglong>(pixels));
}

}  // namespace

ComparisonPane::ComparisonPane(SideResultsModel* model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      difference_(new DepthCanvas),
      difference_colors_(new ColorBar),
      histogram_(new DifferenceHistogram),
      counts_(Words("differenceCounts")),
      no_map_(Words("faint")),
      cloud_a_(new CloudCanvas),
      cloud_b_(new CloudCanvas),
      cloud_colors_(new ColorBar),
      title_a_(Words("faint")),
      title_b_(Words("faint")) {
  auto* splitter = new QSplitter(Qt::Vertical);
  splitter->addWidget(BuildMap());
  splitter->addWidget(BuildClouds());
  splitter->setChildrenCollapsible(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addWidget(no_map_);
  layout->addWidget(splitter, 1);
  // One camera: whichever is moved, the other one follows.
  connect(cloud_a_, &CloudCanvas::cameraMoved, cloud_b_,
          [this] { cloud_b_->SetCamera(cloud_a_->Camera()); });
  connect(cloud_b_, &CloudCanvas::cameraMoved, cloud_a_,
          [this] { cloud_a_->SetCamera(cloud_b_->Camera()); });
  connect(model_, &SideResultsModel::compared, this, &ComparisonPane::Show);
  Show();
}

QWidget* ComparisonPane::BuildMap() {
  map_ = new QWidget;
  auto* layout = new QHBoxLayout(map_);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* numbers = new QWidget;
  auto* side = new QVBoxLayout(numbers);
  side->setContentsMargins(0, 0, 0, 0);
  side->addWidget(histogram_, 1);
  side->addWidget(counts_);
  layout->addWidget(difference_, 3);
  layout->addWidget(difference_colors_);
  layout->addWidget(VerticalScroll(numbers), 2);  // in a low dock they would lie on each other
  difference_colors_->Set(ColorMap::kBalance, {-kFullScale_mm, kFullScale_mm}, tr("B - A, mm"));
  return map_;
}

QWidget* ComparisonPane::BuildClouds() {
  auto* clouds = new QWidget;
  auto* layout = new QHBoxLayout(clouds);
  layout->setContentsMargins(0, 0, 0, 0);
  const auto add = [layout](QLabel* title, CloudCanvas* canvas) {
    auto* column = new QVBoxLayout;
    column->addWidget(title);
    column->addWidget(canvas, 1);
    layout->addLayout(column, 1);
  };
  add(title_a_, cloud_a_);
  add(title_b_, cloud_b_);
  layout->addWidget(cloud_colors_);
  cloud_colors_->Set(ColorMap::kCividis, {0.0, kFullScale_mm}, tr("away, mm"));
  return clouds;
}

void ComparisonPane::Show() {
  const auto& [a, b, comparison] = model_->Last();
  if (!comparison) return;
  map_->setVisible(comparison->depth.has_value());
  no_map_->setVisible(!comparison->depth);
  no_map_->setText(tr("A and B are not depth maps of one image: their clouds are compared."));
  if (const auto& depth = comparison->depth) {
    difference_->SetImage(PaintDifference(*depth, a->depth->dense.depth_m, a->depth->mask,
                                          b->depth->dense.depth_m, b->depth->mask));
    histogram_->Set(*depth);
    counts_->setText(
        tr("Pixels in both: %1\nonly in A (violet): %2\nonly in B (green): %3\n|B - A|: median %4 "
           "mm, 95 % %5 mm")
            .arg(Count(depth->in_both), Count(depth->only_in_first), Count(depth->only_in_second))
            .arg(1000.0 * depth->median_abs_m, 0, 'f', 1)
            .arg(1000.0 * depth->p95_abs_m, 0, 'f', 1));
  }
  const bool masked = comparison->masked.has_value();
  const QString what = masked ? tr("masked depth") : tr("lidar returns");
  title_a_->setText(tr("A: %1, %2").arg(QString::fromStdString(comparison->first), what));
  title_b_->setText(tr("B: %1, %2").arg(QString::fromStdString(comparison->second), what));
  const ValueRange range = {0.0, kFullScale_mm};
  cloud_a_->SetPoints(CloudOf(comparison->first_cloud, *a), ColorMap::kCividis, range);
  cloud_b_->SetPoints(CloudOf(comparison->second_cloud, *b), ColorMap::kCividis, range);
  cloud_b_->SetCamera(cloud_a_->Camera());
}

}  // namespace foresight
