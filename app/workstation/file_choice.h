#pragma once

#include <QString>
#include <QStringList>
#include <functional>

class QFileDialog;
class QWidget;

namespace foresight {

/// Dialogues for files. None is modal: a scan may be running, and the stop button must stay within
/// reach.
class FileChoice {
 public:
  using Chosen = std::function<void(const QString&)>;

  /// `folder` = where a dialogue begins.
  FileChoice(QWidget* window, std::function<QString()> folder);

  void ToOpen(const QString& title, const QString& filter, const Chosen& chosen) const;
  void ManyToOpen(const QString& title, const QString& filter,
                  const std::function<void(const QStringList&)>& chosen) const;
  /// `suffix` is added to a name without one.
  void ToSave(const QString& title, const QString& filter, const QString& suffix,
              const Chosen& chosen) const;
  void Folder(const QString& title, const Chosen& chosen) const;

 private:
  QFileDialog* Dialog(const QString& title, const QString& filter) const;
  void Ask(QFileDialog* dialog, const Chosen& chosen) const;

  QWidget* window_;
  std::function<QString()> folder_;
};

}  // namespace foresight
