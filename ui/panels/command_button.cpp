#include "ui/panels/command_button.h"

#include <QAbstractButton>
#include <QKeySequence>

namespace foresight {

QString ToolTipOf(const Command& command) {
  QString tip = command.tip;
  if (!command.keys.isEmpty())
    tip +=
        QStringLiteral(" (%1)").arg(QKeySequence(command.keys).toString(QKeySequence::NativeText));
  const QString why_not = command.WhyNot();
  return why_not.isEmpty() ? tip : tip + QLatin1Char('\n') + why_not;
}

void BindButton(QAbstractButton* button, CommandTable* commands, const char* id) {
  const Command* command = &commands->Get(id);
  const auto show = [button, command] {
    button->setEnabled(command->Allowed());
    const QString tip = ToolTipOf(*command);
    if (button->toolTip() != tip) button->setToolTip(tip);
    if (command->checked) button->setChecked(command->checked());
  };
  QObject::connect(button, &QAbstractButton::clicked, commands,
                   [commands, id] { commands->Run(id); });
  QObject::connect(commands, &CommandTable::changed, button, show);
  show();
}

}  // namespace foresight
