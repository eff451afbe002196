#include "ui/views/clip_handles.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <QPointF>
#include <algorithm>
#include <cmath>

#include "ui/render/vtk_data.h"

namespace foresight {
namespace {

constexpr double kGrip_px = 12.0;
constexpr Rgb8 kEdgeColor = {204, 121, 167};

}  // namespace

Polylines EdgesOf(const Eigen::AlignedBox3d& box) {
  const auto corner = [&box](int index) {
    return Eigen::Vector3d((index & 1 ? box.max() : box.min()).x(),
                           (index & 2 ? box.max() : box.min()).y(),
                           (index & 4 ? box.max() : box.min()).z());
  };
  Polylines edges;
  for (int from = 0; from < 8; ++from)
    for (const int bit : {1, 2, 4})
      if ((from & bit) == 0) edges.push_back({corner(from), corner(from | bit)});
  return edges;
}

ClipHandles::ClipHandles(vtkRenderer* renderer, std::initializer_list<vtkActor*> cut)
    : cut_(cut), edges_(renderer, 0.0), handles_(vtkSmartPointer<vtkActor>::New()) {
  for (int side = 0; side < 6; ++side) {
    auto& plane = planes_[static_cast<std::size_t>(side)];
    plane = vtkSmartPointer<vtkPlane>::New();
    const Eigen::Vector3d inwards = (side % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(side / 2);
    plane->SetNormal(inwards.x(), inwards.y(), inwards.z());
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(VtkPointsOf({}, 0));
  handles_->SetMapper(mapper);
  handles_->GetProperty()->SetPointSize(12.0f);
  handles_->GetProperty()->RenderPointsAsSpheresOn();
  handles_->GetProperty()->LightingOff();
  handles_->VisibilityOff();
  renderer->AddActor(handles_);
}

Eigen::Vector3d ClipHandles::HandleAt(int side) const {
  Eigen::Vector3d at = box_->center();
  const int axis = side / 2;
  at[axis] = side % 2 == 0 ? box_->min()[axis] : box_->max()[axis];
  return at;
}

void ClipHandles::Set(const std::optional<Eigen::AlignedBox3d>& box) {
  box_ = box;
  edges_.Clear();
  handles_->SetVisibility(box ? 1 : 0);
  for (vtkActor* actor : cut_) actor->GetMapper()->RemoveAllClippingPlanes();
  if (!box) {
    grabbed_ = -1;
    return;
  }
  PointSet points;
  for (int side = 0; side < 6; ++side) {
    const Eigen::Vector3d at = HandleAt(side);
    planes_[static_cast<std::size_t>(side)]->SetOrigin(at.x(), at.y(), at.z());
    points.points.push_back(at.cast<float>());
    points.colors.push_back(kEdgeColor);
  }
  for (vtkActor* actor : cut_)
    for (const auto& plane : planes_) actor->GetMapper()->AddClippingPlane(plane);
  edges_.Add(EdgesOf(*box), {kEdgeColor, 1.5f});
  static_cast<vtkPolyDataMapper*>(handles_->GetMapper())->SetInputData(VtkPointsOf(points, 6));
}

bool ClipHandles::Grab(const QPointF& position, const ToWidget& to_widget) {
  grabbed_ = -1;
  if (!box_) return false;
  double nearest_px = kGrip_px;
  for (int side = 0; side < 6; ++side) {
    const QPointF off = to_widget(HandleAt(side)) - position;
    const double distance_px = std::hypot(off.x(), off.y());
    if (distance_px > nearest_px) continue;
    nearest_px = distance_px;
    grabbed_ = side;
  }
  return grabbed_ >= 0;
}

Eigen::AlignedBox3d ClipHandles::Drag(const QPointF& position, const ToWidget& to_widget) const {
  Eigen::AlignedBox3d box = *box_;
  const int axis = grabbed_ / 2;
  const Eigen::Vector3d handle = HandleAt(grabbed_);
  constexpr double kStep_m = 0.1;
  const QPointF at = to_widget(handle);
  const QPointF way = to_widget(handle + kStep_m * Eigen::Vector3d::Unit(axis)) - at;
  const double squared = QPointF::dotProduct(way, way);
  if (squared < 1.0) return box;  // we look along the axis: nothing tells how far
  const double by_m = kStep_m * QPointF::dotProduct(position - at, way) / squared;
  double& side = grabbed_ % 2 == 0 ? box.min()[axis] : box.max()[axis];
  constexpr double kShortest_m = 0.02;
  side = grabbed_ % 2 == 0 ? std::min(side + by_m, box.max()[axis] - kShortest_m)
                           : std::max(side + by_m, box.min()[axis] + kShortest_m);
  return box;
}

}  // namespace foresight
