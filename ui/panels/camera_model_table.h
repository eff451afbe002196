#pragma once

#include <QTableWidget>

#include "ui/viewmodels/camera_calibration_model.h"

namespace foresight {

/// As checkboxes and tables have room for it: "k", "EUCM".
QString ShortNameOf(LensModel model);

/// The models of a camera side by side; a click on one chooses it.
class CameraModelTable : public QTableWidget {
  Q_OBJECT

 public:
  explicit CameraModelTable(QWidget* parent = nullptr);

  /// Hides itself where there is none.
  void Show(const std::vector<CalibrationModelRow>& rows, int chosen);
};

}  // namespace foresight
