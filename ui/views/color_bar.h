#pragma once

#include <QString>
#include <QStringList>
#include <QWidget>

#include "core/pictures/color_map.h"

namespace foresight {

/// What the colours of a canvas mean: the map from bottom to top, with values and their unit.
/// Painted by Qt, because VTK's own bar has no readable small type.
class ColorBar : public QWidget {
  Q_OBJECT

 public:
  explicit ColorBar(QWidget* parent = nullptr);
  void Set(ColorMap map, const ValueRange& range, const QString& title);
  /// The numbers beside the bar, from below.
  QStringList Labels() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  ColorMap map_ = ColorMap::kTurbo;
  ValueRange range_;
  QString title_;
};

}  // namespace foresight
