#pragma once

#include <QElapsedTimer>

#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/head_view_model.h"

namespace foresight {

/// A preview of the depth while the head sweeps: the lines so far under the picture of the scan
/// before, where that was planned at the same angles. One thread, about once a second, and nothing
/// waits for it; gone when the scan ends.
class LiveDepthViewModel : public QObject {
  Q_OBJECT

 public:
  LiveDepthViewModel(HeadViewModel* head, SessionModel* session, QObject* parent = nullptr);

  /// nullptr unless a scan is running and its picture was seen before.
  const std::shared_ptr<const DepthResult>& Depth() const { return depth_; }
  /// How many lines the preview is made from.
  int Lines() const { return lines_; }
  static DepthMethod Method() { return DepthMethods().front().method; }
  TaskRunner* Runner() { return &runner_; }

 Q_SIGNALS:
  void changed();

 private:
  void RememberScan();
  void Grow();
  void Clear();

  HeadViewModel* head_;
  SessionModel* session_;
  TaskRunner runner_;
  QElapsedTimer since_last_;
  std::shared_ptr<const Scan> last_scan_;  ///< with a picture
  std::shared_ptr<const DepthResult> depth_;
  int lines_ = 0;
};

}  // namespace foresight
