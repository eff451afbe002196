#include "app/workstation/actions.h"

#include <cstring>

#include "core/base/contract.h"
#include "ui/panels/command_button.h"
#include "ui/panels/theme.h"

namespace foresight {

Actions::Actions(CommandTable* commands, QObject* parent) : QObject(parent) {
  for (const auto& command : commands->All()) {
    auto* action = new QAction(command->text, this);
    if (*command->icon != '\0') action->setIcon(Icon(command->icon));
    action->setStatusTip(command->tip);
    action->setCheckable(command->checked != nullptr);
    // A key that acts everywhere is seen by KeysEverywhere; here it is only shown.
    if (command->scope == Command::Scope::kEverywhere)
      action->setShortcutContext(Qt::WidgetShortcut);
    action->setShortcut(QKeySequence(command->keys));
    connect(action, &QAction::triggered, commands,
            [commands, id = command->id] { commands->Run(id); });
    rows_.push_back({command.get(), action});
  }
  connect(commands, &CommandTable::changed, this, &Actions::Refresh);
  Refresh();
}

QAction* Actions::Of(const char* id) const {
  for (const Row& row : rows_)
    if (std::strcmp(row.command->id, id) == 0) return row.action;
  throw ContractViolation("rows_", std::string("no such command: ") + id, __FILE__, __LINE__);
}

QList<QAction*> Actions::All() const {
  QList<QAction*> actions;
  for (const Row& row : rows_) actions << row.action;
  return actions;
}

QList<QAction*> Actions::OfMenu(const char* menu) const {
  QList<QAction*> actions;
  for (const Row& row : rows_)
    if (std::strcmp(row.command->menu, menu) == 0) actions << row.action;
  return actions;
}

QList<QAction*> Actions::OfToolBar() const {
  QList<QAction*> actions;
  for (const Row& row : rows_)
    if (row.command->in_tool_bar) actions << row.action;
  return actions;
}

void Actions::Refresh() {
  for (const Row& row : rows_) {
    const bool allowed = row.command->Allowed();
    if (row.action->isEnabled() != allowed) row.action->setEnabled(allowed);
    const QString tip = ToolTipOf(*row.command);
    if (row.action->toolTip() != tip) row.action->setToolTip(tip);
    if (row.command->checked) row.action->setChecked(row.command->checked());
  }
}

}  // namespace foresight
