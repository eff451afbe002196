#pragma once

#include <Eigen/Geometry>
#include <QObject>
#include <optional>

namespace foresight {

/// A box along the axes of the frame that the cloud pane shows: what is outside is not drawn and
/// not picked. Its sides are dragged or typed.
class ClipBoxModel : public QObject {
  Q_OBJECT

 public:
  explicit ClipBoxModel(QObject* parent = nullptr) : QObject(parent) {}

  bool On() const { return on_; }
  /// The box while it is on.
  std::optional<Eigen::AlignedBox3d> Box() const {
    return on_ ? std::optional(box_) : std::nullopt;
  }
  /// The box that is there when it is switched on again.
  const Eigen::AlignedBox3d& LastBox() const { return box_; }
  /// What the pane shows; a box that was never set begins as the middle half of it.
  void SetBounds(const Eigen::AlignedBox3d& bounds) { bounds_ = bounds; }
  /// Sides that were given the wrong way round change places; none is shorter than kShortest_m.
  void SetBox(const Eigen::AlignedBox3d& box);
  static constexpr double kShortest_m = 0.02;

 public Q_SLOTS:
  void toggle() { setOn(!on_); }
  void setOn(bool on);
  /// Begins anew, as the middle half of what the pane shows.
  void reset();

 Q_SIGNALS:
  void changed();

 private:
  bool on_ = false;
  Eigen::AlignedBox3d box_;
  Eigen::AlignedBox3d bounds_;
};

}  // namespace foresight
