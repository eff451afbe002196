#include "app/workstation/shortcut_sheet.h"

#include <QDialog>
#include <QGridLayout>
#include <QKeySequence>
#include <QLabel>

namespace foresight {

void ShowShortcutSheet(const CommandTable& commands, QWidget* parent) {
  auto* sheet = new QDialog(parent);
  sheet->setAttribute(Qt::WA_DeleteOnClose);
  sheet->setObjectName(QStringLiteral("shortcut_sheet"));
  sheet->setWindowTitle(QObject::tr("Shortcuts"));
  auto* grid = new QGridLayout(sheet);
  grid->setContentsMargins(24, 20, 24, 20);
  grid->setHorizontalSpacing(24);
  grid->setVerticalSpacing(8);
  int row = 0;
  for (const auto& command : commands.All()) {
    if (command->keys.isEmpty()) continue;
    auto* key = new QLabel(QKeySequence(command->keys).toString(QKeySequence::NativeText));
    QFont bold = key->font();
    bold.setBold(true);
    key->setFont(bold);
    auto* tip = new QLabel(command->tip);
    tip->setObjectName(QStringLiteral("faint"));
    grid->addWidget(key, row, 0);
    grid->addWidget(new QLabel(command->text), row, 1);
    grid->addWidget(tip, row, 2);
    ++row;
  }
  sheet->show();
}

}  // namespace foresight
