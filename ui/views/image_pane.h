#pragma once

#include <QTimer>

#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/layers_view_model.h"
#include "ui/views/corner_tags.h"
#include "ui/views/image_canvas.h"
#include "ui/views/pane.h"

class QComboBox;

namespace foresight {

/// The camera's image, with the choice between those of the scan and the samples over it.
class ImagePane : public Pane {
  Q_OBJECT

 public:
  ImagePane(SessionModel* session, FitViewModel* fit, LayersViewModel* layers,
            QWidget* parent = nullptr);

  ImageCanvas* Canvas() { return canvas_; }

 private:
  void ShowImage();
  void FillChoice();
  void ShowAge();
  void ShowOutlines();
  void ShowRegion();
  void ShowSamples();

  SessionModel* session_;
  LayersViewModel* layers_;
  ImageCanvas* canvas_;
  CornerTags* tags_;
  QComboBox* choice_;
  QTimer age_timer_;
};

}  // namespace foresight
