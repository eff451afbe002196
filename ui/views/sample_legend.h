#pragma once

#include <QString>
#include <QVector>
#include <QWidget>

#include "core/pictures/sample_marks.h"

namespace foresight {

/// Names the marks that are drawn over an image: symbol, colour, word and how many there are.
/// Hidden while nothing is drawn.
class SampleLegend : public QWidget {
  Q_OBJECT

 public:
  explicit SampleLegend(QWidget* parent);
  /// With a second set of samples, right of a wipe, both are counted: "Flying: 120 | 97".
  void Show(const AlignedSamples* samples, const SampleLayers& layers,
            const AlignedSamples* second = nullptr);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Row {
    RejectReason kind;
    QString text;
  };
  QVector<Row> rows_;
};

/// "Kept samples", "Flying", ...
QString NameOf(RejectReason kind);

}  // namespace foresight
