#pragma once

#include <Eigen/Core>
#include <QObject>

#include "core/detection/fit_in_scan.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// From a region the operator drew to a found valve.
class FitViewModel : public QObject {
  Q_OBJECT

 public:
  explicit FitViewModel(SessionModel* session, QObject* parent = nullptr);

  bool ValveTool() const { return valve_tool_; }
  bool RoiTool() const { return roi_tool_ || valve_tool_; }
  FitSource From() const { return source_; }
  void SetSource(FitSource source);
  bool CanFit() const;
  TaskRunner* Runner() { return &runner_; }

  /// Two opposite corners in pixels of the current picture. Fits at once while the valve tool is
  /// on. A region too small to be meant is ignored.
  void DrawRoi(const Eigen::Vector2d& corner_a, const Eigen::Vector2d& corner_b);

 public Q_SLOTS:
  /// Drawing a region also fits a valve into it.
  void setValveTool(bool on);
  /// Drawing a region only selects it.
  void setRoiTool(bool on);
  void leaveTools();
  void fit();

 Q_SIGNALS:
  void changed();
  void valveFound(const foresight::FoundValve& valve);

 private:
  void Accept(const std::shared_ptr<const Scan>& scan, const Result<ValveDetection>& detection);

  SessionModel* session_;
  TaskRunner runner_;
  FitSource source_ = FitSource::kRaw;
  bool valve_tool_ = false;
  bool roi_tool_ = false;
};

}  // namespace foresight
