#pragma once

#include <QObject>

namespace foresight {

/// Keeps the mouse wheel from changing a number or a choice that the pointer only passes while a
/// dock is scrolled: fields, lists and sliders take the wheel where they have the focus, which a
/// click gives them.
class WheelGuard : public QObject {
  Q_OBJECT

 public:
  /// Watches the application until it is destroyed.
  explicit WheelGuard(QObject* parent = nullptr);

  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace foresight
