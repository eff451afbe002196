#pragma once

#include <QWidget>
#include <vector>

#include "core/calibration/view_coverage.h"

namespace foresight {

/// The image as cells, the darker the fewer corners, with the errors of the chosen model as arrows.
class CoverageMap : public QWidget {
  Q_OBJECT

 public:
  explicit CoverageMap(QWidget* parent = nullptr);

  void Show(const ViewCoverage& coverage, int width, int height, std::vector<ImageErrors> errors);
  /// How many times longer than the error an arrow is.

  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  QSize sizeHint() const override { return {280, 210}; }
  QSize minimumSizeHint() const override { return {160, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void PaintCells(QPainter& painter) const;
  void PaintErrors(QPainter& painter) const;

  ViewCoverage coverage_;
  int image_width_ = 4;
  int image_height_ = 3;
  std::vector<ImageErrors> errors_;
  double magnification_ = 100.0;
};

/// Three small histograms side by side: distance from the middle of the image, tilt, distance.
class ViewBars : public QWidget {
  Q_OBJECT

 public:
  explicit ViewBars(QWidget* parent = nullptr);

  void Show(const ViewCoverage& coverage);

  QSize sizeHint() const override { return {280, 84}; }
  QSize minimumSizeHint() const override { return {160, 84}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  ViewCoverage coverage_;
};

}  // namespace foresight
