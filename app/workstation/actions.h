#pragma once

#include <QAction>
#include <QObject>
#include <QVector>

#include "app/workstation/workbench.h"

namespace foresight {

/// Every command of the workstation with its key. The sheet of shortcuts is made from these.
class Actions : public QObject {
  Q_OBJECT

 public:
  explicit Actions(Workbench* bench, QObject* parent = nullptr);

  const QVector<QAction*>& All() const { return all_; }

  QAction* open;
  QAction* save;
  QAction* export_cloud;
  QAction* quit;
  QAction* scan;
  QAction* abort;
  QAction* home;
  QAction* stop;
  QAction* region_tool;
  QAction* valve_tool;
  QAction* leave_tool;
  QAction* fit;
  QAction* undo_region;
  QAction* reset_view;
  QAction* toggle_mask;
  QAction* toggle_layer;
  QAction* toggle_rejected;
  QAction* reset_layout;
  QAction* shortcuts;

 private:
  QAction* Add(const char* icon, const QString& text, const QKeySequence& key, const QString& tip);
  void BindToBench();
  void Refresh();

  Workbench* bench_;
  QVector<QAction*> all_;
};

}  // namespace foresight
