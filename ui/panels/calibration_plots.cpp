#include "ui/panels/calibration_plots.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/panels/theme.h"

namespace foresight {
namespace {

const QColor kEmpty(28, 31, 36);
const QColor kLines(62, 68, 76);
/// This many corners in a cell, and more, have the full colour.
constexpr double kManyCorners = 40.0;
constexpr double kArrowAlpha = 0.85;

QColor CellColor(int corners) {
  if (corners == 0) return kEmpty;
  const double full = std::min(1.0, std::sqrt(corners / kManyCorners));
  const auto mix = [full](int from, int to) {
    return static_cast<int>(from + (0.25 + 0.75 * full) * (to - from));
  };
  const QColor& good = state_color::kGood;
  return {mix(kEmpty.red(), good.red()), mix(kEmpty.green(), good.green()),
          mix(kEmpty.blue(), good.blue())};
}

/// Of the errors' direction, so that a region that leans one way is of one colour.
QColor DirectionColor(const Eigen::Vector2d& error) {
  const double turn = (std::atan2(error.y(), error.x()) + M_PI) / (2.0 * M_PI);
  QColor color = QColor::fromHsvF(std::clamp(turn, 0.0, 0.999), 0.45, 1.0);
  color.setAlphaF(kArrowAlpha);
  return color;
}

struct Bars {
  QString title;
  std::vector<int> counts;
  QStringList labels;
};

void PaintBars(QPainter& painter, const QRect& room, const Bars& bars) {
  const int line = painter.fontMetrics().height();
  const QPalette palette;
  painter.setPen(palette.color(QPalette::PlaceholderText));
  painter.drawText(QRect(room.left(), room.top(), room.width(), line), Qt::AlignLeft,
                   painter.fontMetrics().elidedText(bars.title, Qt::ElideRight, room.width()));
  const int most = std::max(1, *std::max_element(bars.counts.begin(), bars.counts.end()));
  const QRect plot = room.adjusted(0, line + 2, 0, -line);
  const int n = static_cast<int>(bars.counts.size());
  for (int i = 0; i < n; ++i) {
    const int left = plot.left() + i * plot.width() / n;
    const int right = plot.left() + (i + 1) * plot.width() / n - 2;
    const int count = bars.counts[static_cast<std::size_t>(i)];
    const int height = count * plot.height() / most;
    painter.fillRect(QRect(QPoint(left, plot.top()), QPoint(right, plot.bottom())), kEmpty);
    painter.fillRect(QRect(left, plot.bottom() + 1 - height, right - left + 1, height),
                     state_color::kActive);
    painter.drawText(QRect(left, plot.bottom() + 1, right - left + 1, line), Qt::AlignCenter,
                     bars.labels.value(i));
  }
}

}  // namespace

CoverageMap::CoverageMap(QWidget* parent) : QWidget(parent) {
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  setAccessibleName(tr("Where the image has corners"));
}

void CoverageMap::Show(const ViewCoverage& coverage, int width, int height,
                       std::vector<ImageErrors> errors) {
  coverage_ = coverage;
  image_width_ = width > 0 ? width : 4;
  image_height_ = height > 0 ? height : 3;
  errors_ = std::move(errors);
  setToolTip(errors_.empty()
                 ? tr("Green: where the image has corners, the brighter the more")
                 : tr("Green: where the image has corners, the brighter the more. Lines: the "
                      "error of each corner, %1 times longer; one colour a direction")
                       .arg(magnification_, 0, 'f', 0));
  updateGeometry();
  update();
}

int CoverageMap::heightForWidth(int width) const {
  return std::min(260, width * image_height_ / image_width_);
}

void CoverageMap::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double scale = std::min(static_cast<double>(width()) / image_width_,
                                static_cast<double>(height()) / image_height_);
  painter.translate(0.5 * (width() - scale * image_width_),
                    0.5 * (height() - scale * image_height_));
  painter.scale(scale, scale);
  PaintCells(painter);
  PaintErrors(painter);
}

void CoverageMap::PaintCells(QPainter& painter) const {
  QPen pen(kLines);
  pen.setCosmetic(true);
  painter.setPen(pen);
  const double w = static_cast<double>(image_width_) / ViewCoverage::kColumns;
  const double h = static_cast<double>(image_height_) / ViewCoverage::kRows;
  for (int row = 0; row < ViewCoverage::kRows; ++row)
    for (int column = 0; column < ViewCoverage::kColumns; ++column) {
      painter.setBrush(CellColor(coverage_.Cell(column, row)));
      painter.drawRect(QRectF(column * w, row * h, w, h));
    }
}

void CoverageMap::PaintErrors(QPainter& painter) const {
  for (const ImageErrors& image : errors_)
    for (std::size_t i = 0; i < image.pixels.size() && i < image.errors_px.size(); ++i) {
      const Eigen::Vector2d& error = image.errors_px[i];
      if (!error.allFinite()) continue;
      QPen pen(DirectionColor(error));
      pen.setCosmetic(true);
      painter.setPen(pen);
      const Eigen::Vector2d end = image.pixels[i] + magnification_ * error;
      painter.drawLine(QPointF(image.pixels[i].x(), image.pixels[i].y()),
                       QPointF(end.x(), end.y()));
    }
}

ViewBars::ViewBars(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("How the boards were held"));
  setToolTip(
      tr("Corners by distance from the middle of the image, in fifths of half its diagonal; "
         "images by the angle between board and line of sight; images by the distance of "
         "the board, in times that of the nearest"));
}

void ViewBars::Show(const ViewCoverage& coverage) {
  coverage_ = coverage;
  update();
}

void ViewBars::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  QFont font = painter.font();
  font.setPointSizeF(0.8 * font.pointSizeF());
  painter.setFont(font);
  const auto list = [](const auto& counts) {
    return std::vector<int>(counts.begin(), counts.end());
  };
  const Bars all[] = {
      {tr("radius"), list(coverage_.rings), {tr("0"), QString(), QString(), QString(), tr("1")}},
      {tr("tilt, deg"), list(coverage_.tilts), {"0", "10", "20", "35"}},
      {tr("distance"), list(coverage_.distances), {"1", "1.3", "2"}}};
  constexpr int kGap = 12;
  const int each = (width() - 2 * kGap) / 3;
  for (int i = 0; i < 3; ++i)
    PaintBars(painter, QRect(i * (each + kGap), 0, each, height()), all[i]);
}

}  // namespace foresight
