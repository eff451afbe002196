#include "app/workstation/focus_keys.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QGroupBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTextEdit>
#include <QToolButton>

namespace foresight {
namespace {

template <class... Widgets>
bool IsOneOf(const QObject* object) {
  return (... || (qobject_cast<const Widgets*>(object) != nullptr));
}

bool UsesSpace(const QObject* object) {
  return IsOneOf<QAbstractButton, QComboBox, QAbstractItemView, QLineEdit, QAbstractSpinBox,
                 QTextEdit, QPlainTextEdit, QGroupBox>(object);
}

bool HasModifiers(const QKeyEvent& key) {
  return (key.modifiers() & ~Qt::KeypadModifier) != Qt::NoModifier;
}

/// A dialogue has a default button, and Qt presses it.
bool PressFocused(QObject* object) {
  if (!IsOneOf<QPushButton, QToolButton>(object)) return false;
  auto* button = static_cast<QAbstractButton*>(object);
  if (qobject_cast<QDialog*>(button->window()) != nullptr || !button->isEnabled()) return false;
  auto* tool = qobject_cast<QToolButton*>(button);
  if (tool != nullptr && tool->popupMode() == QToolButton::InstantPopup)
    tool->showMenu();
  else
    button->click();
  return true;
}

}  // namespace

FocusKeys::FocusKeys(QObject* parent) : QObject(parent) {
  QCoreApplication::instance()->installEventFilter(this);
}

bool FocusKeys::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::ShortcutOverride) return false;
  auto* key = static_cast<QKeyEvent*>(event);
  if (HasModifiers(*key)) return false;
  // Who accepts this question gets the key, and no shortcut does.
  if (event->type() == QEvent::ShortcutOverride && key->key() == Qt::Key_Space &&
      UsesSpace(watched)) {
    event->accept();
    return true;
  }
  const bool enter = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
  return event->type() == QEvent::KeyPress && enter && !key->isAutoRepeat() &&
         PressFocused(watched);
}

}  // namespace foresight
