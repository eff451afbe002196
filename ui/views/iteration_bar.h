#pragma once

#include <QWidget>

#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/layers_view_model.h"

class QLabel;
class QSlider;

namespace foresight {

class ChangeBars;

/// Steps through the passes of the filter, D0 to Dn, beside how much each pass changed on average.
class IterationBar : public QWidget {
  Q_OBJECT

 public:
  IterationBar(SessionModel* session, DepthViewModel* depth, LayersViewModel* layers,
               QWidget* parent = nullptr);

  QSlider* Slider() { return slider_; }

 private:
  void Refresh();

  SessionModel* session_;
  DepthViewModel* depth_;
  LayersViewModel* layers_;
  QLabel* text_;
  QSlider* slider_;
  ChangeBars* bars_;
  QLabel* unit_;
};

}  // namespace foresight
