#include "app/workstation/shortcut_sheet.h"

#include <QDialog>
#include <QGridLayout>
#include <QKeySequence>
#include <QLabel>
#include <QScreen>

#include "ui/widgets/dock_parts.h"

namespace foresight {

void ShowShortcutSheet(const CommandTable& commands, QWidget* parent) {
  auto* sheet = new QDialog(parent);
  sheet->setAttribute(Qt::WA_DeleteOnClose);
  sheet->setObjectName(QStringLiteral("shortcut_sheet"));
  sheet->setWindowTitle(QObject::tr("Shortcuts"));
  auto* rows = new QWidget;
  auto* grid = new QGridLayout(rows);
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
  // More rows than a screen is high: they scroll.
  FillWithScroll(sheet, rows);
  const QSize room = sheet->screen()->availableGeometry().size() * 9 / 10;
  sheet->resize((rows->sizeHint() + QSize(24, 4)).boundedTo(room));
  sheet->show();
}

}  // namespace foresight
