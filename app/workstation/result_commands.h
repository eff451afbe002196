#pragma once

#include <QString>
#include <functional>

namespace foresight {

class Workbench;

/// What the commands of side results and reports need of a window.
struct ResultWindow {
  std::function<void()> show_results;
  std::function<void()> show_comparison;
  std::function<QString()> name;  ///< for the next run; empty = one is made up
  /// Each asks for a file or a folder, and tells which was chosen.
  std::function<void(const QString& title, const QString& filter,
                     const std::function<void(QString)>& chosen)>
      choose_file;
  std::function<void(const QString& title, const std::function<void(QString)>& chosen)>
      choose_folder;
};

/// The rows of the command table for side results and reports.
void AddResultCommands(Workbench* bench, const ResultWindow& window);

}  // namespace foresight
