#pragma once

#include <QApplication>
#include <QMouseEvent>
#include <QWidget>

namespace foresight {

inline void SendMouse(QWidget* widget, QEvent::Type type, const QPoint& position,
                      Qt::MouseButtons held) {
  const Qt::MouseButton button = type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton;
  QMouseEvent event(type, position, widget->mapToGlobal(position), button, held, Qt::NoModifier);
  QApplication::sendEvent(widget, &event);
}

/// Presses, moves and releases the left button. QTest's moves hold no button in Qt 5.
inline void Drag(QWidget* widget, const QPoint& from, const QPoint& to) {
  SendMouse(widget, QEvent::MouseButtonPress, from, Qt::LeftButton);
  for (int step = 1; step <= 8; ++step)
    SendMouse(widget, QEvent::MouseMove, from + (to - from) * step / 8, Qt::LeftButton);
  SendMouse(widget, QEvent::MouseButtonRelease, to, Qt::NoButton);
}

inline void Click(QWidget* widget) {
  const QPoint middle = widget->rect().center();
  SendMouse(widget, QEvent::MouseButtonPress, middle, Qt::LeftButton);
  SendMouse(widget, QEvent::MouseButtonRelease, middle, Qt::NoButton);
}

}  // namespace foresight
