#pragma once

#include <QWidget>

#include "ui/viewmodels/side_results_model.h"
#include "ui/views/cloud_canvas.h"
#include "ui/views/color_bar.h"
#include "ui/views/depth_canvas.h"
#include "ui/views/difference_histogram.h"

class QLabel;

namespace foresight {

/// A and B set against each other: the map of the depth difference with its histogram, and the two
/// clouds, coloured by how far each point is from the other cloud, under one camera.
class ComparisonPane : public QWidget {
  Q_OBJECT

 public:
  explicit ComparisonPane(SideResultsModel* model, QWidget* parent = nullptr);

  DepthCanvas* Difference() { return difference_; }
  CloudCanvas* CloudA() { return cloud_a_; }
  CloudCanvas* CloudB() { return cloud_b_; }
  ColorBar* DifferenceColors() { return difference_colors_; }
  QLabel* Counts() { return counts_; }

 private:
  QWidget* BuildMap();
  QWidget* BuildClouds();
  void Show();

  SideResultsModel* model_;
  DepthCanvas* difference_;
  ColorBar* difference_colors_;
  DifferenceHistogram* histogram_;
  QLabel* counts_;
  QLabel* no_map_;
  QWidget* map_;
  CloudCanvas* cloud_a_;
  CloudCanvas* cloud_b_;
  ColorBar* cloud_colors_;
  QLabel* title_a_;
  QLabel* title_b_;
};

}  // namespace foresight
