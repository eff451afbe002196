#include "ui/viewmodels/compare_view_model.h"

#include <algorithm>

#include "ui/viewmodels/depth_task.h"

namespace foresight {

CompareViewModel::CompareViewModel(SessionModel* session, DepthViewModel* depth, QObject* parent)
    : QObject(parent), session_(session), depth_(depth) {
  connect(session_, &SessionModel::depthChanged, this, &CompareViewModel::FollowDepth);
}

QString CompareViewModel::SecondTitle() const {
  switch (kind_) {
    case Kind::kNothing:
      return {};
    case Kind::kImage:
      return tr("Camera image");
    case Kind::kMethod:
      return QString::fromUtf8(InfoOf(method_).title);
    case Kind::kResults:
      return second_title_;
    case Kind::kFrozen:
      break;
  }
  return tr("%1, frozen at %2")
      .arg(QString::fromUtf8(InfoOf(second_options_.method).title))
      .arg(second_options_.mask.threshold, 0, 'f', 2);
}

void CompareViewModel::Choose(Kind kind) {
  runner_.cancel();
  kind_ = kind;
  second_.reset();
  second_mask_.reset();
  first_ = {};
}

void CompareViewModel::CompareResults(Side first, Side second) {
  Choose(Kind::kResults);
  first_ = std::move(first);
  second_ = std::move(second.depth);
  second_mask_ = std::make_shared<const MaskImage>(second_->mask);
  second_options_ = second_->options;
  second_title_ = second.title;
  Q_EMIT changed();
}

void CompareViewModel::compareWithNothing() {
  Choose(Kind::kNothing);
  Q_EMIT changed();
}

void CompareViewModel::compareWithImage() {
  Choose(Kind::kImage);
  Q_EMIT changed();
}

void CompareViewModel::compareWithFrozen() {
  if (!session_->Depth()) return;
  Choose(Kind::kFrozen);
  second_ = session_->Depth();
  second_mask_ = session_->Mask();
  second_options_ = depth_->ShownOptions();
  second_options_.mask = depth_->Options().mask;
  Q_EMIT changed();
}

void CompareViewModel::compareWithMethod(DepthMethod method) {
  Choose(Kind::kMethod);
  method_ = method;
  second_options_ = DefaultsOf(method);
  Compute();
  Q_EMIT changed();
}

void CompareViewModel::setWipe(double fraction) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (fraction == wipe_) return;
  wipe_ = fraction;
  Q_EMIT wipeChanged(fraction);
}

void CompareViewModel::FollowDepth() {
  if (session_->Depth()) {
    if (kind_ == Kind::kMethod && !second_ && !runner_.Busy()) Compute();
    return;
  }
  // Another scan or image: what was beside the old one no longer belongs here.
  const bool ends = kind_ == Kind::kFrozen || kind_ == Kind::kResults;
  Choose(ends ? Kind::kNothing : kind_);
  Q_EMIT changed();
}

void CompareViewModel::Compute() {
  if (!session_->Depth()) return;  // the first depth comes first
  const auto scan = session_->CurrentScan();
  const int image = session_->ImageIndex();
  runner_.Run<DepthResult>(
      tr("Computing the depth to compare with"),
      MakeDepthTask(scan, session_->Cloud(), image, second_options_),
      [this, scan, image](Result<DepthResult> depth) {
        const bool wanted = kind_ == Kind::kMethod && scan == session_->CurrentScan() &&
                            image == session_->ImageIndex();
        if (!wanted) return;
        if (!depth) {
          session_->Report(NoticeOf(tr("Computing the depth to compare with"), depth.error()));
          compareWithNothing();
          return;
        }
        second_ = std::make_shared<const DepthResult>(std::move(*depth));
        second_mask_ = std::make_shared<const MaskImage>(second_->mask);
        Q_EMIT changed();
      });
}

}  // namespace foresight
