#pragma once

#include <QObject>
#include <QTimer>
#include <QWidget>
#include <string>

#include "app/workstation/workbench.h"

namespace foresight {

/// What the program does without an operator, from its command line.
struct UnattendedOptions {
  bool scan = false;       ///< start a scan as soon as the head is ready
  std::string screenshot;  ///< save an image of the window when all is computed, then quit
};

/// Carries these out, by looking at the view-models ten times a second.
class Unattended : public QObject {
  Q_OBJECT

 public:
  Unattended(Workbench* bench, QWidget* window, const UnattendedOptions& options);

 private:
  void Look();

  Workbench* bench_;
  QWidget* window_;
  UnattendedOptions options_;
  QTimer timer_;
  int idle_looks_ = 0;
};

}  // namespace foresight
