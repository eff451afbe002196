#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "ui/viewmodels/stand_place_row.h"

namespace foresight {

/// The places of the stand as rows, the stops of the motor as lamps: hollow = not captured, a dot =
/// no board in the image, half = one board, full = both, a cross = left out; a line below = lidar
/// lines are there. The last lamp of a row is the sweep. A click selects a stop.
class StandLamps : public QWidget {
  Q_OBJECT

 public:
  explicit StandLamps(QWidget* parent = nullptr);

  void Show(const std::vector<StandPlaceRow>& places, int selected_place, int selected_stop);

  /// "no board in the image".
  static QString InWords(StopLamp::State state);

  /// The middle of a lamp.
  QPoint PlaceOf(int place, int stop) const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 Q_SIGNALS:
  void selected(int place, int stop);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  struct At {
    int place = -1;
    int stop = -1;
  };
  int ColumnOf(double motor_rad) const;
  double ColumnWidth() const;
  QPointF Middle(int place, int column) const;
  std::optional<At> StopAt(const QPoint& point) const;
  void PaintLamp(QPainter& painter, const QPointF& middle, const StopLamp& lamp) const;
  void PaintSweep(QPainter& painter, const QPointF& middle, const StandPlaceRow& row) const;

  std::vector<StandPlaceRow> places_;
  std::vector<double> angles_;  ///< of all places, increasing
  At selected_;
};

}  // namespace foresight
