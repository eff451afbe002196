#pragma once

#include <functional>

#include "core/depth/live_depth.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/head_view_model.h"

namespace foresight {

/// The sweep that a preview follows: a head's, or one that is replayed.
struct SweepSource {
  std::function<bool()> running;
  std::function<ScanPlan()> plan;
};

/// A preview of the depth while the head sweeps: the lines so far under the scan's own image once
/// it has been taken, before that under the image of the scan before, where that was planned at the
/// same angles. Only what new lines can change is computed
/// again, with lengths fixed by the plan. One thread, at most once each time that the points grow,
/// and nothing waits for it; gone when the scan ends.
class LiveDepthViewModel : public QObject {
  Q_OBJECT

 public:
  LiveDepthViewModel(HeadViewModel* head, SessionModel* session, QObject* parent = nullptr);
  /// Call `clear` when the sweep begins, ends, or loses lines again.
  LiveDepthViewModel(SweepSource sweep, SessionModel* session, QObject* parent = nullptr);

  /// nullptr unless a scan is running and its image was seen before.
  const std::shared_ptr<const DepthResult>& Depth() const { return depth_; }
  /// How many lines the preview is made from.
  int Lines() const { return lines_; }
  /// Whether the image under it is the running scan's own.
  bool HasOwnImage() const { return image_ && image_ == own_image_; }
  static DepthMethod Method() { return DepthMethods().front().method; }
  TaskRunner* Runner() { return &runner_; }

 public Q_SLOTS:
  void clear();

 Q_SIGNALS:
  void changed();

 private:
  void RememberScan();
  void Grow();
  void Begin(std::shared_ptr<const CameraFrame> image);
  std::shared_ptr<const CameraFrame> ImageToUse();

  SweepSource sweep_;
  SessionModel* session_;
  TaskRunner runner_{session_->Tasks()};
  std::shared_ptr<const Scan> last_scan_;         ///< with an image
  std::shared_ptr<const CameraFrame> own_image_;  ///< of the running scan, once it is there
  std::shared_ptr<const CameraFrame> image_;      ///< that live_ works under
  std::shared_ptr<LiveDepth> live_;  ///< of the running scan; one task at a time uses it
  std::shared_ptr<const DepthResult> depth_;
  int lines_ = 0;
};

}  // namespace foresight
