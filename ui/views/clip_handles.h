#pragma once

#include <vtkActor.h>
#include <vtkPlane.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <initializer_list>
#include <optional>

#include "ui/views/outline_actors.h"

class QPointF;

namespace foresight {

/// The twelve edges of a box.
Polylines EdgesOf(const Eigen::AlignedBox3d& box);

/// A clip box in the cloud: its edges, a handle in the middle of each side, and the planes that cut
/// what is drawn. A handle is dragged along its axis.
class ClipHandles {
 public:
  using ToWidget = std::function<QPointF(const Eigen::Vector3d&)>;

  /// Cuts the actors.
  ClipHandles(vtkRenderer* renderer, std::initializer_list<vtkActor*> cut);

  void Set(const std::optional<Eigen::AlignedBox3d>& box);
  const std::optional<Eigen::AlignedBox3d>& Box() const { return box_; }

  /// Takes the handle under the mouse; false where there is none.
  bool Grab(const QPointF& position, const ToWidget& to_widget);
  bool Grabbed() const { return grabbed_ >= 0; }
  /// The box with the grabbed side where the mouse is now.
  Eigen::AlignedBox3d Drag(const QPointF& position, const ToWidget& to_widget) const;
  void Release() { grabbed_ = -1; }
  /// The middle of a side: 2 * axis, and 1 more for the far one.
  Eigen::Vector3d HandleAt(int side) const;

 private:
  std::optional<Eigen::AlignedBox3d> box_;
  std::vector<vtkActor*> cut_;
  std::array<vtkSmartPointer<vtkPlane>, 6> planes_;
  OutlineActors edges_;
  vtkSmartPointer<vtkActor> handles_;
  int grabbed_ = -1;
};

}  // namespace foresight
