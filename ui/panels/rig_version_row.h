#pragma once

#include <QWidget>
#include <functional>

#include "ui/viewmodels/rig_version_model.h"

class QLabel;
class QPushButton;

namespace foresight {

/// Saves a calibration as a new rig file, puts it in force on the head, and rolls it back.
class RigVersionRow : public QWidget {
  Q_OBJECT

 public:
  /// What the calibration says of the rig that it would save.
  struct Source {
    QString what;  ///< tip of the button that saves
    std::function<QString()> why_not_save;
    std::function<QString()> suggested_file;
    std::function<void(const QString&)> save;
  };

  RigVersionRow(RigVersionModel* rig, Source source, QWidget* parent = nullptr);

  void Refresh();

 private:
  void ChooseFile();

  RigVersionModel* rig_;
  Source source_;
  QPushButton* save_;
  QPushButton* force_;
  QPushButton* back_;
  QLabel* saved_;
};

}  // namespace foresight
