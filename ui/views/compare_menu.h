#pragma once

#include <QMenu>

#include "ui/viewmodels/compare_view_model.h"

namespace foresight {

/// What stands right of the wipe line: nothing, the camera's image, the depth as it is now, or
/// another method.
class CompareMenu : public QMenu {
  Q_OBJECT

 public:
  CompareMenu(SessionModel* session, CompareViewModel* compare, QWidget* parent = nullptr);

 private:
  void Fill();
  QAction* Add(const QString& text, bool checked);

  SessionModel* session_;
  CompareViewModel* compare_;
};

}  // namespace foresight
