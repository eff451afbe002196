#pragma once

#include <QObject>

#include "ui/viewmodels/command_table.h"

namespace foresight {

/// Runs the commands whose key acts everywhere, whatever window, dialogue, menu or floating dock
/// has the focus: it sees every key of the program before anything else does.
class KeysEverywhere : public QObject {
  Q_OBJECT

 public:
  /// Watches the application until it is destroyed.
  explicit KeysEverywhere(CommandTable* commands, QObject* parent = nullptr);

  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  CommandTable* commands_;
};

}  // namespace foresight
