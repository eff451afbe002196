#pragma once

#include <QWidget>
#include <array>

#include "core/depth/compare_depth.h"

namespace foresight {

/// How many pixels differ by how much: a bar a millimetre in the colours of the difference map,
/// with an axis in mm.
class DifferenceHistogram : public QWidget {
  Q_OBJECT

 public:
  explicit DifferenceHistogram(QWidget* parent = nullptr);
  void Set(const DepthComparison& comparison);
  QSize sizeHint() const override { return {260, 160}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::array<std::int64_t, DepthComparison::kBins> bins_ = {};
  std::int64_t below_ = 0;
  std::int64_t above_ = 0;
};

}  // namespace foresight
