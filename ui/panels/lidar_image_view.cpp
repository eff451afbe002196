#include "ui/panels/lidar_image_view.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "core/pictures/color_map.h"
#include "ui/panels/theme.h"

namespace foresight {
namespace {

constexpr double kFullColour_m = 0.030;
constexpr int kScale_px = 18;

/// White on the board, full colours from 30 mm on.
QColor ColorOfResidual(double residual_m) {
  const Rgb8 color = ColorOf(ColorMap::kBalance, 0.5 + 0.5 * residual_m / kFullColour_m);
  return {color.r, color.g, color.b};
}

}  // namespace

LidarImageView::LidarImageView(QWidget* parent) : QWidget(parent) {
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  setAccessibleName(tr("Lidar points on the image"));
}

int LidarImageView::heightForWidth(int width) const {
  return width * height_ / width_ + kScale_px;
}

void LidarImageView::Show(const GrayImage& image, const MountView* view, int width, int height,
                          const std::vector<LidarImagePoint>& points, Which which) {
  image_ = {};
  if (!image.empty()) {
    const QImage borrowed(image.data(), image.width(), image.height(), image.width(),
                          QImage::Format_Grayscale8);
    image_ = borrowed.copy();
  }
  corners_.clear();
  if (view != nullptr)
    for (const auto* board : {&view->a, &view->b})
      if (*board) corners_.insert(corners_.end(), (*board)->pixels.begin(), (*board)->pixels.end());
  width_ = std::max(1, width);
  height_ = std::max(1, height);
  points_ = points;
  which_ = which;
  updateGeometry();
  update();
}

void LidarImageView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  const double scale = static_cast<double>(width()) / width_;
  const QRectF room(0.0, 0.0, width(), scale * height_);
  painter.fillRect(room, QColor(28, 31, 36));
  if (!image_.isNull()) {
    painter.setOpacity(0.6);
    painter.drawImage(room, image_);
    painter.setOpacity(1.0);
  }
  const auto at = [scale](const Eigen::Vector2d& pixel) {
    return QPointF((pixel.x() + 0.5) * scale, (pixel.y() + 0.5) * scale);
  };
  painter.setClipRect(room);
  painter.setPen(Qt::NoPen);
  painter.setBrush(state_color::kNeutral);
  for (const Eigen::Vector2d& corner : corners_) painter.drawEllipse(at(corner), 1.2, 1.2);
  const bool before = which_ == Which::kBefore;
  for (const LidarImagePoint& point : points_) {
    const Eigen::Vector2d& pixel = before ? point.pixel_before : point.pixel_after;
    const double residual = before ? point.residual_before_m : point.residual_after_m;
    if (!pixel.allFinite() || !std::isfinite(residual)) continue;
    painter.setBrush(ColorOfResidual(residual));
    painter.drawEllipse(at(pixel), 2.0, 2.0);
  }
  painter.setClipping(false);
  PaintScale(painter);
}

void LidarImageView::PaintScale(QPainter& painter) const {
  const QRect room(0, height() - kScale_px + 3, width(), kScale_px - 3);
  QFont small = font();
  small.setPointSizeF(0.8 * small.pointSizeF());
  painter.setFont(small);
  painter.setPen(palette().color(QPalette::PlaceholderText));
  painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter, tr("-30 mm, too near"));
  painter.drawText(room, Qt::AlignRight | Qt::AlignVCenter, tr("too far, +30 mm"));
  const int bar = width() / 3;
  for (int x = 0; x < bar; ++x) {
    painter.setPen(ColorOfResidual(kFullColour_m * (2.0 * x / bar - 1.0)));
    painter.drawLine(width() / 3 + x, room.top() + 4, width() / 3 + x, room.bottom() - 3);
  }
}

}  // namespace foresight
