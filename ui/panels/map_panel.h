#pragma once

#include <QWidget>
#include <array>

#include "ui/viewmodels/clip_box_model.h"
#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/map_view_model.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace foresight {

/// Several scans in one map: each scan with its colour, place and residual, or why it is not in the
/// map; what changed between two of them; and the clip box in numbers.
class MapPanel : public QWidget {
  Q_OBJECT

 public:
  MapPanel(MapViewModel* map, ClipBoxModel* clip, CommandTable* commands,
           QWidget* parent = nullptr);

  QListWidget* Scans() { return scans_; }
  QListWidget* Changes() { return changes_; }
  QComboBox* Before() { return before_; }
  QComboBox* After() { return after_; }
  /// Low and high of x, y, z.
  QDoubleSpinBox* Side(int index) { return sides_[static_cast<std::size_t>(index)]; }

 private:
  QWidget* BuildChanges();
  QWidget* BuildClip(CommandTable* commands);
  void ShowMap();
  void ShowClip();
  void TakeClip();

  MapViewModel* map_;
  ClipBoxModel* clip_;
  QLabel* empty_;
  QListWidget* scans_;
  QWidget* changes_box_;  ///< hidden as long as there is no map
  QComboBox* before_;
  QComboBox* after_;
  QPushButton* find_;
  QLabel* changes_text_;
  QListWidget* changes_;
  std::array<QDoubleSpinBox*, 6> sides_{};
  std::shared_ptr<const ShownMap> listed_;  ///< whose scans the choices hold
};

}  // namespace foresight
