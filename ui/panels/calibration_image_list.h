#pragma once

#include <QListWidget>

#include "ui/viewmodels/camera_calibration_model.h"

namespace foresight {

/// Images of a calibration with what became of each; its mark leaves an image out.
class CalibrationImageList : public QListWidget {
  Q_OBJECT

 public:
  explicit CalibrationImageList(QWidget* parent = nullptr);

  /// Hides itself where there is none.
  void Show(const std::vector<CalibrationImageRow>& rows);

 Q_SIGNALS:
  void marked(int row, bool excluded);  ///< by the operator
};

}  // namespace foresight
