#pragma once

#include <QAction>
#include <QList>
#include <QObject>
#include <QVector>

#include "ui/viewmodels/command_table.h"

namespace foresight {

/// A QAction for every row of the command table, for menus, tool bars and keys. Rows that are added
/// later are not seen.
class Actions : public QObject {
  Q_OBJECT

 public:
  explicit Actions(CommandTable* commands, QObject* parent = nullptr);

  QAction* Of(const char* id) const;
  QList<QAction*> All() const;
  QList<QAction*> OfMenu(const char* menu) const;
  QList<QAction*> OfToolBar() const;

 private:
  struct Row {
    const Command* command;
    QAction* action;
  };
  void Refresh();

  QVector<Row> rows_;
};

}  // namespace foresight
