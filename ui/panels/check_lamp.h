#pragma once

#include <QFrame>

#include "ui/viewmodels/scan_check_model.h"

class QLabel;

namespace foresight {

class QuietLabel;

/// The sign of a check's light; every light has its own shape, not only its own colour.
QPixmap CheckPixmap(CheckLight light);

/// What the scan on the screen says about itself: a lamp, green, amber, red, or grey where nothing
/// can be told, and one sentence. Always as high; never takes the focus. A click asks for details.
class CheckLamp : public QFrame {
  Q_OBJECT

 public:
  explicit CheckLamp(ScanCheckModel* check, QWidget* parent = nullptr);

 Q_SIGNALS:
  void clicked();

 protected:
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  void Show();

  ScanCheckModel* check_;
  QLabel* sign_;
  QuietLabel* sentence_;
};

}  // namespace foresight
