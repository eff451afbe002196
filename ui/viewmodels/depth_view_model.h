#pragma once

#include <QObject>

#include "core/depth/pipeline.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// The straight line after a scan: points, alignment to the chosen picture, depth, mask. It starts
/// by itself when a scan or a picture is chosen. Moving the threshold only redoes the mask.
class DepthViewModel : public QObject {
  Q_OBJECT

 public:
  explicit DepthViewModel(SessionModel* session, QObject* parent = nullptr);

  const DepthOptions& Options() const { return options_; }
  double Threshold() const { return options_.mask.threshold; }
  TaskRunner* Runner() { return &runner_; }
  /// How often the depth was computed; a mask alone does not count.
  int ComputedCount() const { return computed_; }

 public Q_SLOTS:
  /// In [0, 1], of the largest confidence in the image.
  void setThreshold(double threshold);
  /// Computes the depth of the current picture again.
  void compute();

 Q_SIGNALS:
  void thresholdChanged(double threshold);

 private:
  void ComputeOn(const std::shared_ptr<const Scan>& scan, int picture);
  void Accept(Result<DepthResult> depth);

  SessionModel* session_;
  DepthOptions options_;
  TaskRunner runner_;
  int computed_ = 0;
};

}  // namespace foresight
