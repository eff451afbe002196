#include "app/workstation/keys_everywhere.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QKeySequence>

namespace foresight {

KeysEverywhere::KeysEverywhere(CommandTable* commands, QObject* parent)
    : QObject(parent), commands_(commands) {
  QCoreApplication::instance()->installEventFilter(this);
}

bool KeysEverywhere::eventFilter(QObject*, QEvent* event) {
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::ShortcutOverride) return false;
  auto* key = static_cast<QKeyEvent*>(event);
  const QKeySequence pressed(key->key() | static_cast<int>(key->modifiers() & ~Qt::KeypadModifier));
  for (const auto& command : commands_->All()) {
    if (command->scope != Command::Scope::kEverywhere || pressed != QKeySequence(command->keys))
      continue;
    event->accept();
    // Qt first asks who wants the key, then sends it: the second one counts.
    if (event->type() == QEvent::KeyPress && !key->isAutoRepeat()) commands_->Run(command->id);
    return true;
  }
  return false;
}

}  // namespace foresight
