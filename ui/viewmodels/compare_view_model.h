#pragma once

#include <QObject>

#include "ui/viewmodels/depth_view_model.h"

namespace foresight {

/// A second image beside the depth, parted from it by a line that the operator moves: another
/// method, the camera's image, the depth as it was a moment ago, or one of two results of which the
/// other takes the place of the depth (side results). Belongs to one image of one scan; another
/// method follows to the next image, anything else is dropped there.
class CompareViewModel : public QObject {
  Q_OBJECT

 public:
  enum class Kind { kNothing, kMethod, kFrozen, kImage, kResults };

  /// A depth map beside another one, and what it is called.
  struct Side {
    std::shared_ptr<const DepthResult> depth;
    QString title;
  };

  CompareViewModel(SessionModel* session, DepthViewModel* depth, QObject* parent = nullptr);

  Kind With() const { return kind_; }
  DepthMethod OtherMethod() const { return method_; }
  /// What stands left of the line in place of the session's depth; nullptr = nothing.
  const std::shared_ptr<const DepthResult>& First() const { return first_.depth; }
  QString FirstTitle() const { return first_.title; }
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
  /// Two depth maps of the image that is shown, A left of the line and B right of it.
  void CompareResults(Side first, Side second);

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
  Side first_;
  QString second_title_;
  std::shared_ptr<const DepthResult> second_;
  std::shared_ptr<const MaskImage> second_mask_;
  double wipe_ = 0.5;
};

}  // namespace foresight
