#include "ui/panels/board_bars.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/panels/theme.h"

namespace foresight {
namespace {

constexpr int kRow_px = 18;
constexpr int kName_px = 84;
constexpr int kNumber_px = 44;
const QColor kGround(28, 31, 36);

}  // namespace

BoardBars::BoardBars(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("Residuals of each board"));
  setToolTip(
      tr("Root mean square of each board: corners in px, and how far lidar returns lie from it "
         "along the beams in mm, sweeps too; the tick is the lidar's mean"));
}

QSize BoardBars::sizeHint() const {
  return {220, kRow_px * (static_cast<int>(boards_.size()) + 1)};
}

void BoardBars::Show(const std::vector<BoardFit>& boards, const QStringList& poses) {
  boards_ = boards;
  poses_ = poses;
  updateGeometry();
  update();
}

void BoardBars::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  QFont small = font();
  small.setPointSizeF(0.8 * small.pointSizeF());
  painter.setFont(small);
  double most_px = 1e-9, most_m = 1e-9;
  for (const BoardFit& board : boards_) {
    most_px = std::max(most_px, board.rms_px);
    most_m = std::max(most_m, board.rms_m);
  }
  const int bar = (width() - kName_px - 2 * kNumber_px) / 2;
  const int corners_left = kName_px, lidar_left = kName_px + bar + kNumber_px;
  const QColor faint = palette().color(QPalette::PlaceholderText);
  painter.setPen(faint);
  painter.drawText(QRect(corners_left, 0, bar + kNumber_px, kRow_px), Qt::AlignVCenter,
                   tr("corners, px"));
  painter.drawText(QRect(lidar_left, 0, bar + kNumber_px, kRow_px), Qt::AlignVCenter,
                   tr("lidar, mm"));
  const auto row = [&](int left, int top, double value, double most, const QColor& color,
                       const QString& number) {
    painter.fillRect(left, top + 3, bar, kRow_px - 6, kGround);
    painter.fillRect(left, top + 3, static_cast<int>(bar * value / most), kRow_px - 6, color);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRect(left + bar + 4, top, kNumber_px - 6, kRow_px), Qt::AlignVCenter, number);
  };
  for (int i = 0; i < static_cast<int>(boards_.size()); ++i) {
    const BoardFit& board = boards_[static_cast<std::size_t>(i)];
    const int top = kRow_px * (i + 1);
    painter.setPen(faint);
    const QString name = tr("%1, %2").arg(poses_.value(board.pose),
                                          board.on_b ? QStringLiteral("B") : QStringLiteral("A"));
    painter.drawText(QRect(0, top, kName_px - 4, kRow_px), Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(name, Qt::ElideRight, kName_px - 4));
    if (board.corners > 0)
      row(corners_left, top, board.rms_px, most_px, state_color::kActive,
          QString::number(board.rms_px, 'f', 2));
    if (board.returns == 0) continue;
    row(lidar_left, top, board.rms_m, most_m, state_color::kGood,
        QString::number(1000.0 * board.rms_m, 'f', 1));
    const int tick = static_cast<int>(bar * std::min(1.0, std::abs(board.mean_m) / most_m));
    painter.setPen(QPen(state_color::kCaution, 2));
    painter.drawLine(lidar_left + tick, top + 2, lidar_left + tick, top + kRow_px - 3);
  }
}

}  // namespace foresight
