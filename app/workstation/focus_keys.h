#pragma once

#include <QObject>

namespace foresight {

/// Leaves Space to a control that uses it, so that it starts no scan while a button, a box, a list
/// or a field has the focus. Enter presses the button that has the focus.
class FocusKeys : public QObject {
  Q_OBJECT

 public:
  /// Watches the application until it is destroyed.
  explicit FocusKeys(QObject* parent = nullptr);

  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace foresight
