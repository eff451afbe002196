#pragma once

#include <QObject>

#include "ui/viewmodels/depth_view_model.h"

namespace foresight {

/// A second image beside the depth, parted from it by a line that the operator moves: another
/// method, the camera's image, or the depth as it was a moment ago. Belongs to one image of one
/// scan; another method follows to the next image, a frozen depth is dropped there.
class CompareViewModel : public QObject {
  Q_OBJECT

 public:
  enum class Kind { kNothing, kMethod, kFrozen, kImage };

  CompareViewModel(SessionModel* session, DepthViewModel* depth, QObject* parent = nullptr);

  Kind With() const { return kind_; }
  DepthMethod OtherMethod() const { return method_; }
  /// The second depth and its mask; nullptr while it is being computed and for other kinds.
  const std::shared_ptr<const DepthResult>& Second() const { return second_; }
  const std::shared_ptr<const MaskImage>& SecondMask() const { return second_mask_; }
  /// The options the second depth was made with, its threshold included.
  const DepthOptions& SecondOptions() const { return second_options_; }
  /// What stands right of the line, in words.
  QString SecondTitle() const;
  /// Where the line is, in [0, 1] of the image's width.
  double Wipe() const { return wipe_; }
  TaskRunner* Runner() { return &runner_; }

 public Q_SLOTS:
  void compareWithNothing();
  void compareWithMethod(foresight::DepthMethod method);
  void compareWithImage();
  /// Keeps the depth on the screen with its mask, to be compared with what comes.
  void compareWithFrozen();
  void setWipe(double fraction);

 Q_SIGNALS:
  void changed();
  void wipeChanged(double fraction);

 private:
  void Choose(Kind kind);
  void FollowDepth();
  void Compute();

  SessionModel* session_;
  DepthViewModel* depth_;
  TaskRunner runner_{session_->Tasks()};
  Kind kind_ = Kind::kNothing;
  DepthMethod method_ = DepthMethod::kPaper;
  DepthOptions second_options_;
  std::shared_ptr<const DepthResult> second_;
  std::shared_ptr<const MaskImage> second_mask_;
  double wipe_ = 0.5;
};

}  // namespace foresight
