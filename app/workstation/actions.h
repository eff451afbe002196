#pragma once

#include <QAction>
#include <QObject>
#include <QVector>
#include <array>
#include <utility>

#include "app/workstation/workbench.h"

namespace foresight {

/// Every command of the workstation with its key. The sheet of shortcuts is made from these.
class Actions : public QObject {
  Q_OBJECT

 public:
  explicit Actions(Workbench* bench, QObject* parent = nullptr);

  const QVector<QAction*>& All() const { return all_; }
  /// Keys that act only while a pane has the focus, where the same key means something elsewhere.
  QList<QAction*> OfPanes() const { return {next_candidate, previous_candidate}; }

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
  QAction* drill_tool;
  QAction* terrain_tool;
  QAction* leave_tool;
  QAction* fit;
  QAction* compare_sources;
  QAction* next_candidate;
  QAction* previous_candidate;
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
  std::array<std::pair<QAction*, ObjectKind>, 3> Tools() const {
    return {{{valve_tool, ObjectKind::kValve},
             {drill_tool, ObjectKind::kDrill},
             {terrain_tool, ObjectKind::kTerrain}}};
  }
  void Refresh();

  Workbench* bench_;
  QVector<QAction*> all_;
};

}  // namespace foresight
