#include "ui/widgets/wheel_guard.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QSlider>

namespace foresight {
namespace {

bool HoldsAValue(const QObject* object) {
  return qobject_cast<const QAbstractSpinBox*>(object) != nullptr ||
         qobject_cast<const QComboBox*>(object) != nullptr ||
         qobject_cast<const QSlider*>(object) != nullptr;
}

}  // namespace

WheelGuard::WheelGuard(QObject* parent) : QObject(parent) {
  QCoreApplication::instance()->installEventFilter(this);
}

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Polish && event->type() != QEvent::Wheel) return false;
  if (!HoldsAValue(watched)) return false;
  auto* widget = static_cast<QWidget*>(watched);
  // Else the wheel gives the focus before anybody sees it.
  if (widget->focusPolicy() == Qt::WheelFocus) widget->setFocusPolicy(Qt::StrongFocus);
  if (event->type() != QEvent::Wheel || widget->hasFocus()) return false;
  event->ignore();  // what lies round it scrolls
  return true;
}

}  // namespace foresight
