#include "ui/panels/stand_lamps.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "ui/panels/theme.h"

namespace foresight {
namespace {

constexpr int kRow_px = 24;
constexpr int kHeader_px = 16;
constexpr int kName_px = 64;
constexpr double kRadius_px = 6.0;
constexpr double kSame_rad = 2e-4;

QString Degrees(double angle_rad) {
  return QString::number(DegreesFromRadians(angle_rad), 'g', 4);
}

QString TipOf(const StandPlaceRow& row, const StopLamp& lamp) {
  QString text = StandLamps::tr("%1, %2°: %3")
                     .arg(row.name, Degrees(lamp.motor_rad), StandLamps::InWords(lamp.state));
  if (lamp.has_lines) text += StandLamps::tr(", lidar lines");
  if (std::isfinite(lamp.rms_px)) text += StandLamps::tr(", rms %1 px").arg(lamp.rms_px, 0, 'f', 2);
  if (lamp.stands_out) text += StandLamps::tr("\nIt fits much worse than the others.");
  return text;
}

}  // namespace

QString StandLamps::InWords(StopLamp::State state) {
  using State = StopLamp::State;
  switch (state) {
    case State::kWaiting:
      return tr("not captured yet");
    case State::kLooking:
      return tr("looking for the boards");
    case State::kNoImage:
      return tr("no image");
    case State::kNoBoard:
      return tr("no board in the image");
    case State::kOneBoard:
      return tr("one board found");
    case State::kBothBoards:
      return tr("all boards found");
    case State::kExcluded:
      break;
  }
  return tr("left out by you");
}

StandLamps::StandLamps(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("Stops at each place of the stand"));
}

void StandLamps::Show(const std::vector<StandPlaceRow>& places, int selected_place,
                      int selected_stop) {
  const std::size_t rows_before = places_.size();
  places_ = places;
  selected_ = {selected_place, selected_stop};
  angles_.clear();
  for (const StandPlaceRow& row : places_)
    for (const StopLamp& lamp : row.stops) angles_.push_back(lamp.motor_rad);
  std::sort(angles_.begin(), angles_.end());
  angles_.erase(std::unique(angles_.begin(), angles_.end(),
                            [](double a, double b) { return std::abs(a - b) < kSame_rad; }),
                angles_.end());
  if (rows_before != places_.size()) updateGeometry();
  setVisible(!places_.empty());
  update();
}

QSize StandLamps::sizeHint() const {
  return {220, kHeader_px + kRow_px * static_cast<int>(places_.size())};
}

int StandLamps::ColumnOf(double motor_rad) const {
  const auto at = std::lower_bound(angles_.begin(), angles_.end(), motor_rad - kSame_rad);
  return static_cast<int>(at - angles_.begin());
}

/// The sweep has the last column.
double StandLamps::ColumnWidth() const {
  return static_cast<double>(width() - kName_px) / static_cast<double>(angles_.size() + 1);
}

QPointF StandLamps::Middle(int place, int column) const {
  return {kName_px + (column + 0.5) * ColumnWidth(), kHeader_px + (place + 0.5) * kRow_px};
}

QPoint StandLamps::PlaceOf(int place, int stop) const {
  const auto& stops = places_[static_cast<std::size_t>(place)].stops;
  return Middle(place, ColumnOf(stops[static_cast<std::size_t>(stop)].motor_rad)).toPoint();
}

std::optional<StandLamps::At> StandLamps::StopAt(const QPoint& point) const {
  const int place = (point.y() - kHeader_px) / kRow_px;
  if (point.y() < kHeader_px || place >= static_cast<int>(places_.size())) return std::nullopt;
  const auto& stops = places_[static_cast<std::size_t>(place)].stops;
  for (int stop = 0; stop < static_cast<int>(stops.size()); ++stop)
    if (std::abs(PlaceOf(place, stop).x() - point.x()) <= 0.5 * ColumnWidth())
      return At{place, stop};
  return std::nullopt;
}

void StandLamps::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor faint = palette().color(QPalette::PlaceholderText);
  QFont small = font();
  small.setPointSizeF(0.8 * small.pointSizeF());
  painter.setFont(small);
  painter.setPen(faint);
  // Every label that has room.
  const int every = std::max(1, static_cast<int>(std::ceil(26.0 / ColumnWidth())));
  for (int column = 0; column < static_cast<int>(angles_.size()); column += every) {
    const QPointF middle = Middle(0, column);
    painter.drawText(QRectF(middle.x() - 20, 0, 40, kHeader_px), Qt::AlignCenter,
                     Degrees(angles_[static_cast<std::size_t>(column)]));
  }
  for (int place = 0; place < static_cast<int>(places_.size()); ++place) {
    const StandPlaceRow& row = places_[static_cast<std::size_t>(place)];
    const QRect name(0, kHeader_px + place * kRow_px, kName_px - 4, kRow_px);
    painter.setPen(row.excluded ? faint : palette().color(QPalette::WindowText));
    painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(row.name, Qt::ElideRight, name.width()));
    painter.setOpacity(row.excluded ? 0.4 : 1.0);
    for (int stop = 0; stop < static_cast<int>(row.stops.size()); ++stop) {
      const StopLamp& lamp = row.stops[static_cast<std::size_t>(stop)];
      const QPointF middle = Middle(place, ColumnOf(lamp.motor_rad));
      if (place == selected_.place && stop == selected_.stop) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(palette().color(QPalette::Highlight));
        painter.drawRoundedRect(QRectF(middle.x() - 9, middle.y() - 11, 18, 22), 4, 4);
      }
      PaintLamp(painter, middle, lamp);
    }
    PaintSweep(painter, Middle(place, static_cast<int>(angles_.size())), row);
    painter.setOpacity(1.0);
  }
}

void StandLamps::PaintLamp(QPainter& painter, const QPointF& middle, const StopLamp& lamp) const {
  using State = StopLamp::State;
  const QRectF circle(middle.x() - kRadius_px, middle.y() - kRadius_px, 2 * kRadius_px,
                      2 * kRadius_px);
  const QColor ring = lamp.stands_out ? state_color::kCaution : state_color::kNeutral;
  painter.setPen(QPen(ring, lamp.stands_out ? 2.5 : 1.2));
  painter.setBrush(Qt::NoBrush);
  switch (lamp.state) {
    case State::kWaiting:
      painter.drawEllipse(circle);
      break;
    case State::kLooking:
      painter.setPen(QPen(state_color::kActive, 1.2, Qt::DotLine));
      painter.drawEllipse(circle);
      break;
    case State::kNoImage:
      painter.drawLine(middle - QPointF(4, 0), middle + QPointF(4, 0));
      break;
    case State::kNoBoard:
      painter.setBrush(state_color::kNeutral);
      painter.drawEllipse(middle, 2.0, 2.0);
      break;
    case State::kOneBoard:
      painter.drawEllipse(circle);
      painter.setPen(Qt::NoPen);
      painter.setBrush(state_color::kGood);
      painter.drawPie(circle, 90 * 16, 180 * 16);
      break;
    case State::kBothBoards:
      painter.setBrush(state_color::kGood);
      if (!lamp.stands_out) painter.setPen(Qt::NoPen);
      painter.drawEllipse(circle);
      break;
    case State::kExcluded:
      painter.drawLine(circle.topLeft(), circle.bottomRight());
      painter.drawLine(circle.topRight(), circle.bottomLeft());
      break;
  }
  if (!lamp.has_lines) return;
  painter.setPen(QPen(state_color::kActive, 1.5));
  painter.drawLine(middle + QPointF(-4, 9), middle + QPointF(4, 9));
}

void StandLamps::PaintSweep(QPainter& painter, const QPointF& middle,
                            const StandPlaceRow& row) const {
  if (row.sweep == StandPlaceRow::Sweep::kNone) return;
  const bool there = row.sweep == StandPlaceRow::Sweep::kThere;
  painter.setPen(there ? state_color::kActive : state_color::kNeutral);
  painter.drawText(QRectF(middle.x() - 10, middle.y() - 10, 20, 20), Qt::AlignCenter,
                   there ? QStringLiteral("⇅") : QStringLiteral("✗"));
}

void StandLamps::mousePressEvent(QMouseEvent* event) {
  if (const auto at = StopAt(event->pos())) Q_EMIT selected(at->place, at->stop);
}

bool StandLamps::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  if (const auto at = StopAt(help->pos())) {
    const StandPlaceRow& row = places_[static_cast<std::size_t>(at->place)];
    QToolTip::showText(help->globalPos(), TipOf(row, row.stops[static_cast<std::size_t>(at->stop)]),
                       this);
  } else {
    QToolTip::hideText();
  }
  return true;
}

}  // namespace foresight
