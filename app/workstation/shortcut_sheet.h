#pragma once

#include <QAction>
#include <QVector>

class QWidget;

namespace foresight {

/// Opens a window with the keys of these actions. It does not block the one below.
void ShowShortcutSheet(const QVector<QAction*>& actions, QWidget* parent);

}  // namespace foresight
