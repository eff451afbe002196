#pragma once

#include <QWidget>

#include "core/objects/calibration_board.h"

class QComboBox;
class QDoubleSpinBox;
class QSpinBox;

namespace foresight {

/// Kind, inner corners and size of a calibration board.
class BoardFields : public QWidget {
  Q_OBJECT

 public:
  explicit BoardFields(QWidget* parent = nullptr);

  /// Leaves alone what somebody types into.
  void Show(const CalibrationBoard& board);
  /// What was shown, with what was typed.
  CalibrationBoard Board() const;

 Q_SIGNALS:
  void edited();  ///< by the operator

 private:
  CalibrationBoard shown_;
  QComboBox* kind_;
  QSpinBox* columns_;
  QSpinBox* rows_;
  QDoubleSpinBox* square_mm_;
};

}  // namespace foresight
