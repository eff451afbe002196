#pragma once

#include <QMenu>
#include <QVector>

#include "ui/viewmodels/layers_view_model.h"

namespace foresight {

/// What the depth pane shows and what lies over it, as checkable entries.
class LayersMenu : public QMenu {
  Q_OBJECT

 public:
  explicit LayersMenu(LayersViewModel* layers, QWidget* parent = nullptr);

 private:
  void AddMaps();
  void AddSamples();
  void AddColors();
  void Refresh();

  LayersViewModel* layers_;
  QAction* depth_;
  QAction* confidence_;
  QAction* mask_;
  QAction* iterations_;
  QVector<QAction*> samples_;  ///< one for each of kSampleKinds
  QVector<QAction*> colors_;   ///< one for each of DepthColorMaps
};

}  // namespace foresight
