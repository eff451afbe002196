#include "ui/panels/timeline_view.h"

#include <QApplication>
#include <QDateTime>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/panels/theme.h"

namespace foresight {
namespace {

using Kind = TimelineEntry::Kind;

constexpr int kNames_px = 108;  ///< the column with the lanes' names
constexpr int kRuler_px = 22;
constexpr int kLeastLane_px = 15;
constexpr int kMost_px = 24;
constexpr int kMark_px = 16;
constexpr int kTickApart_px = 90;
constexpr double kWheelStep = 1.25;
const QColor kGround(28, 31, 36), kLine(52, 57, 64), kWords(164, 172, 182), kDark(22, 24, 28);

struct LaneLook {
  const char* icon;
  const char* name;
};
constexpr LaneLook kLanes[kTimelineLanes] = {
    {"timeline_scans", QT_TRANSLATE_NOOP("foresight::TimelineView", "Scans")},
    {"timeline_depth", QT_TRANSLATE_NOOP("foresight::TimelineView", "Depth")},
    {"timeline_found", QT_TRANSLATE_NOOP("foresight::TimelineView", "Fits")},
    {"timeline_accepted", QT_TRANSLATE_NOOP("foresight::TimelineView", "Decisions")},
    {"timeline_sent", QT_TRANSLATE_NOOP("foresight::TimelineView", "Sent")},
    {"timeline_alarm", QT_TRANSLATE_NOOP("foresight::TimelineView", "Alarms")},
    {"timeline_linked", QT_TRANSLATE_NOOP("foresight::TimelineView", "Link")}};

/// How a mark looks: told apart by its icon and its word, the colour only helps.
struct MarkLook {
  const char* icon;
  QString word;
  QColor color;
};

MarkLook LookOf(Kind kind) {
  switch (kind) {
    case Kind::kScan:
      return {"", TimelineView::tr("scan"), state_color::kActive};
    case Kind::kCutScan:
      return {"", TimelineView::tr("cut short"), state_color::kCaution};
    case Kind::kDepth:
      return {"mark_depth", TimelineView::tr("depth"), state_color::kNeutral};
    case Kind::kFound:
      return {"mark_found", TimelineView::tr("found"), state_color::kActive};
    case Kind::kAccepted:
      return {"mark_accepted", TimelineView::tr("accepted"), state_color::kGood};
    case Kind::kRejected:
      return {"mark_rejected", TimelineView::tr("rejected"), state_color::kCaution};
    case Kind::kOtherAction:
      return {"mark_other", TimelineView::tr("changed"), state_color::kNeutral};
    case Kind::kSent:
      return {"mark_sent", TimelineView::tr("sent"), state_color::kGood};
    case Kind::kWarning:
      return {"mark_alarm", TimelineView::tr("warning"), state_color::kCaution};
    case Kind::kError:
      return {"mark_error", TimelineView::tr("error"), state_color::kBad};
    case Kind::kLinkUp:
      return {"", TimelineView::tr("there"), state_color::kGood};
    case Kind::kLinkLost:
      break;
  }
  return {"", TimelineView::tr("lost"), state_color::kBad};
}

bool IsBarLane(TimelineLane lane) {
  return lane == TimelineLane::kScans || lane == TimelineLane::kLink;
}

QString TimeText(std::int64_t utc_ns) {
  return QDateTime::fromMSecsSinceEpoch(utc_ns / 1'000'000)
      .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss"));
}

void DrawIcon(QPainter& painter, const char* name, const QRect& rect) {
  if (*name != '\0') Icon(name).paint(&painter, rect);
}

}  // namespace

TimelineView::TimelineView(TimelineModel* model, QWidget* parent) : QWidget(parent), model_(model) {
  setAccessibleName(tr("Timeline"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  connect(model_, &TimelineModel::changed, this, QOverload<>::of(&QWidget::update));
  connect(model_, &TimelineModel::sightChanged, this, QOverload<>::of(&QWidget::update));
}

QSize TimelineView::sizeHint() const {
  return {600, kRuler_px + kTimelineLanes * 21};
}

QSize TimelineView::minimumSizeHint() const {
  return {260, kRuler_px + kTimelineLanes * kLeastLane_px};
}

void TimelineView::SetNow(std::int64_t utc_ns, const std::string& scan_uuid) {
  if (utc_ns == now_utc_ns_ && scan_uuid == scan_uuid_) return;
  now_utc_ns_ = utc_ns;
  scan_uuid_ = scan_uuid;
  update();
}

const TimelineEntry& TimelineView::First(const TimelineMark& mark) const {
  return model_->Timeline()->entries[static_cast<std::size_t>(mark.entries.front())];
}

QRect TimelineView::LaneRect(int lane) const {
  const int each = std::clamp((height() - kRuler_px) / kTimelineLanes, kLeastLane_px, kMost_px);
  return {kNames_px, kRuler_px + lane * each, width() - kNames_px, each};
}

double TimelineView::LaneApart(TimelineLane lane) const {
  return IsBarLane(lane) ? 5.0 : kMark_px + 2.0;
}

QRect TimelineView::RectOf(TimelineLane lane, const TimelineMark& mark) const {
  const QRect row = LaneRect(static_cast<int>(lane)).adjusted(0, 2, 0, -2);
  const int x = kNames_px + static_cast<int>(std::lround(mark.x));
  if (!IsBarLane(lane)) {
    const int width = mark.count > 1 ? kMark_px + 10 : kMark_px;
    return {x - kMark_px / 2, row.top(), width, row.height()};
  }
  const int end = kNames_px + static_cast<int>(std::lround(std::min(mark.x_end, 1e6)));
  return {x, row.top(), std::max(4, end - x), row.height()};
}

std::optional<TimelineMark> TimelineView::MarkAt(const QPoint& point) const {
  if (!model_->Timeline() || point.x() < kNames_px) return std::nullopt;
  for (int lane = 0; lane < kTimelineLanes; ++lane) {
    if (!LaneRect(lane).contains(point)) continue;
    const auto which = static_cast<TimelineLane>(lane);
    for (const TimelineMark& mark :
         model_->Marks().InSight(which, model_->Axis(), LaneApart(which)))
      if (RectOf(which, mark).adjusted(-1, -3, 1, 3).contains(point)) return mark;
  }
  return std::nullopt;
}

QString TimelineView::TextAt(const QPoint& point) const {
  const auto mark = MarkAt(point);
  if (!mark) return {};
  const TimelineEntry& entry = First(*mark);
  if (mark->count > 1) {
    const TimelineEntry& last =
        model_->Timeline()->entries[static_cast<std::size_t>(mark->entries.back())];
    return tr("%1 entries from %2 to %3; click to look closer\n%4")
        .arg(mark->count)
        .arg(TimeText(entry.begin_utc_ns), TimeText(last.begin_utc_ns),
             QString::fromStdString(entry.text));
  }
  QString text = tr("%1\n%2").arg(QString::fromStdString(entry.text), TimeText(entry.begin_utc_ns));
  if (entry.end_utc_ns > entry.begin_utc_ns)
    text += tr(", %1 s").arg(1e-9 * static_cast<double>(entry.end_utc_ns - entry.begin_utc_ns), 0,
                             'f', 1);
  if (entry.in_review) text += tr(", in a review");
  return text;
}

QPoint TimelineView::PointOf(const TimelineEntry& entry) const {
  for (const TimelineMark& mark :
       model_->Marks().InSight(entry.lane, model_->Axis(), LaneApart(entry.lane)))
    if (First(mark) == entry) {
      const QRect rect = RectOf(entry.lane, mark);
      return {std::min(rect.left() + kMark_px / 2, rect.center().x()), rect.center().y()};
    }
  return {-1, -1};
}

QPoint TimelineView::PointOnRuler(std::int64_t utc_ns) const {
  return {kNames_px + static_cast<int>(std::lround(model_->Axis().XOf(utc_ns))), kRuler_px / 2};
}

void TimelineView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), kGround);
  drawn_marks_ = 0;
  if (!model_->Timeline()) return;
  QFont words = font();
  words.setPixelSize(std::clamp(LaneRect(0).height() - 4, 10, 13));
  painter.setFont(words);
  DrawRuler(painter);
  for (int lane = 0; lane < kTimelineLanes; ++lane) DrawLane(painter, lane);
  DrawNow(painter);
}

void TimelineView::DrawRuler(QPainter& painter) const {
  painter.setClipRect(kNames_px, 0, width() - kNames_px, height());
  for (const TimelineAxis::Tick& tick : model_->Axis().Ticks(kTickApart_px)) {
    const int x = kNames_px + static_cast<int>(std::lround(tick.x));
    painter.setPen(kLine);
    painter.drawLine(x, 0, x, height());
    painter.setPen(kWords);
    painter.drawText(QRect(x + 4, 0, kTickApart_px, kRuler_px), Qt::AlignVCenter, tick.text);
  }
  painter.setClipping(false);
  painter.setPen(kLine);
  painter.drawLine(0, kRuler_px - 1, width(), kRuler_px - 1);
}

void TimelineView::DrawLane(QPainter& painter, int lane) {
  const auto which = static_cast<TimelineLane>(lane);
  const QRect row = LaneRect(lane);
  painter.setClipping(false);
  DrawIcon(painter, kLanes[lane].icon, {8, row.center().y() - 7, 15, 15});
  painter.setPen(kWords);
  painter.drawText(QRect(30, row.top(), kNames_px - 32, row.height()), Qt::AlignVCenter,
                   tr(kLanes[lane].name));
  painter.setPen(kLine);
  painter.drawLine(0, row.bottom(), width(), row.bottom());
  painter.setClipRect(row);
  const auto marks = model_->Marks().InSight(which, model_->Axis(), LaneApart(which));
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const QRect rect = RectOf(which, marks[i]);
    const int next = i + 1 < marks.size() ? RectOf(which, marks[i + 1]).left() : width();
    if (IsBarLane(which))
      DrawBar(painter, rect, marks[i]);
    else
      DrawMark(painter, rect, marks[i], next - rect.right());
  }
  drawn_marks_ += static_cast<int>(marks.size());
}

void TimelineView::DrawBar(QPainter& painter, const QRect& rect, const TimelineMark& mark) const {
  const TimelineEntry& entry = First(mark);
  const MarkLook look = LookOf(entry.kind);
  const bool broken = entry.kind == Kind::kCutScan || entry.kind == Kind::kLinkLost;
  painter.fillRect(rect, broken ? look.color.darker(260) : look.color);
  if (broken) painter.fillRect(rect, QBrush(look.color, Qt::BDiagPattern));
  if (!scan_uuid_.empty() && entry.scan_uuid == scan_uuid_ && mark.count == 1) {
    painter.setPen(QPen(Qt::white, 2));
    painter.drawRect(rect.adjusted(1, 1, -1, -1));
  }
  // A bar that begins before what is in sight names itself where it can be seen.
  QRect words = rect.intersected(LaneRect(static_cast<int>(entry.lane))).adjusted(4, 0, -2, 0);
  QString text;
  if (mark.count > 1)
    text = QString::number(mark.count);
  else if (entry.lane == TimelineLane::kLink)
    text = look.word;
  else
    text = QString::fromStdString(entry.text);
  const QFontMetrics metrics(painter.font());
  if (mark.count == 1 && metrics.horizontalAdvance(text) > words.width())
    text = text.section(QLatin1Char(','), 0, 0);
  if (metrics.horizontalAdvance(text) > words.width()) text = text.section(QLatin1Char(' '), -1);
  if (metrics.horizontalAdvance(text) > words.width()) return;
  painter.setPen(broken ? QColor(Qt::white) : kDark);
  painter.drawText(words, Qt::AlignVCenter | Qt::AlignLeft, text);
}

void TimelineView::DrawMark(QPainter& painter, const QRect& rect, const TimelineMark& mark,
                            int room_px) const {
  const TimelineEntry& entry = First(mark);
  const MarkLook look = LookOf(entry.kind);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(mark.count > 1 ? state_color::kNeutral : look.color);
  painter.drawRoundedRect(rect, 3, 3);
  painter.setRenderHint(QPainter::Antialiasing, false);
  if (mark.count > 1) {
    painter.setPen(kDark);
    painter.drawText(rect, Qt::AlignCenter, QString::number(mark.count));
    return;
  }
  const int side = std::min(rect.width(), rect.height()) - 2;
  const QPoint middle = rect.center();
  DrawIcon(painter, look.icon, {middle.x() - side / 2, middle.y() - side / 2, side, side});
  if (painter.fontMetrics().horizontalAdvance(look.word) + 8 > room_px) return;
  painter.setPen(kWords);
  painter.drawText(QRect(rect.right() + 4, rect.top(), room_px, rect.height()), Qt::AlignVCenter,
                   look.word);
}

void TimelineView::DrawNow(QPainter& painter) const {
  if (now_utc_ns_ == 0) return;
  const int x = PointOnRuler(now_utc_ns_).x();
  if (x < kNames_px || x > width()) return;
  painter.setClipping(false);
  painter.setPen(QPen(Qt::white, 1));
  painter.drawLine(x, kRuler_px / 2, x, height());
  painter.setBrush(Qt::white);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPoint handle[] = {{x - 6, 2}, {x + 6, 2}, {x, kRuler_px / 2 + 4}};
  painter.drawPolygon(handle, 3);
}

bool TimelineView::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  const QString text = TextAt(help->pos());
  if (text.isEmpty())
    QToolTip::hideText();
  else
    QToolTip::showText(help->globalPos(), text, this);
  return true;
}

void TimelineView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  model_->SetWidth(std::max(1, width() - kNames_px));
}

void TimelineView::wheelEvent(QWheelEvent* event) {
  event->accept();
  const QPoint turned = event->angleDelta();
  const bool sideways =
      event->modifiers().testFlag(Qt::ShiftModifier) || std::abs(turned.x()) > std::abs(turned.y());
  const double steps = (turned.x() != 0 && sideways ? turned.x() : turned.y()) / 120.0;
  if (sideways)
    model_->PanBy(-steps * 0.1 * model_->Axis().Width());
  else
    model_->ZoomAt(std::max(0.0, event->position().x() - kNames_px), std::pow(kWheelStep, steps));
}

void TimelineView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !model_->Timeline()) return;
  pressed_ = last_ = event->pos();
  const bool on_ruler = event->pos().y() < kRuler_px && event->pos().x() >= kNames_px;
  drag_ = on_ruler ? Drag::kSeek : Drag::kPressed;
  if (on_ruler) SeekTo(event->pos());
}

void TimelineView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_ == Drag::kPressed &&
      (event->pos() - pressed_).manhattanLength() >= QApplication::startDragDistance())
    drag_ = Drag::kPan;
  if (drag_ == Drag::kPan) model_->PanBy(last_.x() - event->pos().x());
  if (drag_ == Drag::kSeek) SeekTo(event->pos());
  last_ = event->pos();
}

void TimelineView::mouseReleaseEvent(QMouseEvent* event) {
  const Drag was = std::exchange(drag_, Drag::kNone);
  if (was != Drag::kPressed || event->button() != Qt::LeftButton) return;
  if (const auto mark = MarkAt(event->pos())) Choose(*mark);
}

void TimelineView::Choose(const TimelineMark& mark) {
  if (mark.count == 1) {
    const TimelineEntry entry = First(mark);  // what is shown may change meanwhile
    Q_EMIT chosen(entry);
    return;
  }
  const TimelineEntry& last =
      model_->Timeline()->entries[static_cast<std::size_t>(mark.entries.back())];
  model_->ShowSpan(First(mark).begin_utc_ns, last.end_utc_ns);
}

void TimelineView::SeekTo(const QPoint& point) {
  Q_EMIT sought(model_->Axis().TimeAt(std::clamp(point.x() - kNames_px, 0, width() - kNames_px)));
}

void TimelineView::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Plus:
      return model_->zoomIn();
    case Qt::Key_Minus:
      return model_->zoomOut();
    case Qt::Key_Left:
      return model_->panEarlier();
    case Qt::Key_Right:
      return model_->panLater();
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace foresight
