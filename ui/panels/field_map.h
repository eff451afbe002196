#pragma once

#include <QWidget>

#include "core/calibration/projection_maps.h"

namespace foresight {

/// A number at each place of an image as colours, with a scale: dark = 0, bright = `full` and more.
class FieldMap : public QWidget {
  Q_OBJECT

 public:
  explicit FieldMap(QWidget* parent = nullptr);

  void Show(const ImageField& field, double full);

  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  QSize sizeHint() const override { return {280, heightForWidth(280)}; }
  QSize minimumSizeHint() const override { return {160, 140}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  ImageField field_;
  double full_ = 1.0;
};

}  // namespace foresight
