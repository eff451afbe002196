#pragma once

#include <QObject>
#include <QString>
#include <memory>

#include "hardware/api/head_link.h"
#include "hardware/api/sensor_head.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Has the head fit in the scan that is still coming: region and pose alone cross the link, so an
/// answer is here long before the scan is. What is looked for, and how, is what the fit here would
/// take.
class RobotFitModel : public QObject {
  Q_OBJECT

 public:
  /// `head` has a link.
  RobotFitModel(std::shared_ptr<SensorHead> head, SessionModel* live, const FitViewModel* fit,
                const DepthViewModel* depth, QObject* parent = nullptr);

  /// Why the robot cannot fit now, as a sentence; empty when it can.
  QString WhyNot() const;
  TaskRunner* Runner() { return &runner_; }

 public Q_SLOTS:
  void fit();

 Q_SIGNALS:
  void changed();

 private:
  HeadFitOrder Order() const;
  void Accept(const std::shared_ptr<const Scan>& scan, const Result<HeadFit>& made);

  std::shared_ptr<SensorHead> head_;
  HeadLink* link_;  ///< of head_
  SessionModel* session_;
  const FitViewModel* fit_;
  const DepthViewModel* depth_;
  TaskRunner runner_{session_->Tasks()};
};

}  // namespace foresight
