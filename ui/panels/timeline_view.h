#pragma once

#include <QWidget>
#include <optional>

#include "ui/viewmodels/timeline_model.h"

namespace foresight {

/// The timeline drawn: a ruler with the play head, and below it a lane for each sort of entry,
/// named by an icon and a word. Marks that are too close together are one mark with their number.
/// Only what is in sight is looked at. The wheel zooms at the mouse, dragging pans; on the ruler,
/// dragging moves the play head.
class TimelineView : public QWidget {
  Q_OBJECT

 public:
  explicit TimelineView(TimelineModel* model, QWidget* parent = nullptr);

  /// The moment that is shown (0 = none), and the scan.
  void SetNow(std::int64_t utc_ns, const std::string& scan_uuid);

  /// What a tip says of the mark at this point; empty where there is none.
  QString TextAt(const QPoint& point) const;
  /// The middle of the mark of an entry that is in sight.
  QPoint PointOf(const TimelineEntry& entry) const;
  /// Where a time stands on the ruler.
  QPoint PointOnRuler(std::int64_t utc_ns) const;
  /// That were drawn the last time.
  int DrawnMarks() const { return drawn_marks_; }

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void chosen(const foresight::TimelineEntry& entry);
  /// The operator wants to see this moment.
  void sought(qint64 utc_ns);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  enum class Drag { kNone, kPressed, kPan, kSeek };

  QRect LaneRect(int lane) const;
  double LaneApart(TimelineLane lane) const;
  QRect RectOf(TimelineLane lane, const TimelineMark& mark) const;
  std::optional<TimelineMark> MarkAt(const QPoint& point) const;
  void SeekTo(const QPoint& point);
  void Choose(const TimelineMark& mark);
  void DrawRuler(QPainter& painter) const;
  void DrawLane(QPainter& painter, int lane);
  void DrawBar(QPainter& painter, const QRect& rect, const TimelineMark& mark) const;
  void DrawMark(QPainter& painter, const QRect& rect, const TimelineMark& mark, int room_px) const;
  void DrawNow(QPainter& painter) const;
  const TimelineEntry& First(const TimelineMark& mark) const;

  TimelineModel* model_;
  std::int64_t now_utc_ns_ = 0;
  std::string scan_uuid_;
  Drag drag_ = Drag::kNone;
  QPoint pressed_;
  QPoint last_;
  int drawn_marks_ = 0;
};

}  // namespace foresight
