#pragma once

#include <QWidget>

#include "ui/viewmodels/calibration_check.h"

class QLabel;

namespace foresight {

/// A verdict on a calibration in a sentence, and what it was made from, a line a check.
class VerdictView : public QWidget {
  Q_OBJECT

 public:
  explicit VerdictView(QWidget* parent = nullptr);

  /// Hides itself where there is none.
  void Show(const std::vector<CalibrationCheck>& checks);

 private:
  QLabel* summary_;
  QLabel* checks_;
};

}  // namespace foresight
