#pragma once

#include <QObject>
#include <QString>

#include "core/pictures/sample_marks.h"

class QLabel;
class QWidget;

namespace foresight {

class SampleLegend;

/// Short texts over the corners of a canvas, and the legend of its marks. They take no clicks.
class CornerTags : public QObject {
  Q_OBJECT

 public:
  explicit CornerTags(QWidget* canvas);

  /// Empty hides the tag.
  void SetTopLeft(const QString& text);
  void SetTopRight(const QString& text);
  /// With a second set of samples both are counted.
  void SetLegend(const AlignedSamples* samples, const SampleLayers& layers,
                 const AlignedSamples* second = nullptr);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void Place();

  QWidget* canvas_;
  QLabel* top_left_;
  QLabel* top_right_;
  SampleLegend* legend_;
};

}  // namespace foresight
