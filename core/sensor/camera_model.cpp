#include "core/sensor/camera_model.h"

#include <array>
#include <cmath>

#include "core/base/contract.h"
#include "core/sensor/fisheye_rays.h"

namespace foresight {
namespace {

/// Squares of what is farther overflow. NaN is not.
bool IsOfThisWorld(const Eigen::Vector3d& point) {
  constexpr double kFarthest_m = 1e100;
  return std::abs(point.x()) < kFarthest_m && std::abs(point.y()) < kFarthest_m &&
         std::abs(point.z()) < kFarthest_m;
}

template <class L>
constexpr int kParameterCount = static_cast<int>(L::kParameters.size());

template <class L>
std::optional<Eigen::Vector2d> ProjectThrough(const L& lens, const CameraModel& camera,
                                              const Eigen::Vector3d& point,
                                              CameraModel::ByPoint* by_point,
                                              CameraModel::ByParameters* by_parameters) {
  Eigen::Matrix<double, 2, kParameterCount<L>> by_lens;
  const auto image = lens.Project(point, by_point, by_parameters == nullptr ? nullptr : &by_lens);
  if (!image) return std::nullopt;
  const double x = image->x(), y = image->y();
  if (by_point != nullptr) {
    by_point->row(0) *= camera.fx;
    by_point->row(1) *= camera.fy;
  }
  if (by_parameters != nullptr) {
    by_parameters->resize(2, 4 + kParameterCount<L>);
    by_parameters->template leftCols<4>() << x, 0.0, 1.0, 0.0,  //
        0.0, y, 0.0, 1.0;
    by_parameters->row(0).tail(kParameterCount<L>) = camera.fx * by_lens.row(0);
    by_parameters->row(1).tail(kParameterCount<L>) = camera.fy * by_lens.row(1);
  }
  return Eigen::Vector2d(camera.fx * x + camera.cx, camera.fy * y + camera.cy);
}

std::string_view NameOf(const FisheyeLens& lens) {
  return lens.k == 0.0 ? "pinhole" : "fisheye with k";
}
std::string_view NameOf(const RadialTangentialLens&) {
  return "radial-tangential";
}
std::string_view NameOf(const KannalaBrandtLens&) {
  return "Kannala-Brandt (KB4)";
}
std::string_view NameOf(const ExtendedUnifiedLens&) {
  return "extended unified (EUCM)";
}

}  // namespace

std::optional<ParameterFault> CameraModel::FindFault() const {
  const auto size_fault = [&](std::string_view which) {
    return ParameterFault{
        which, fmt::format("image size {} x {} is not between 1 and 20000", width, height)};
  };
  if (width < 1 || width > 20000) return size_fault("width");
  if (height < 1 || height > 20000) return size_fault("height");
  const auto focal_fault = [&](std::string_view which) {
    return ParameterFault{which,
                          fmt::format("focal lengths fx {} and fy {} must be positive", fx, fy)};
  };
  if (!(fx > 0.0) || !std::isfinite(fx)) return focal_fault("fx");
  if (!(fy > 0.0) || !std::isfinite(fy)) return focal_fault("fy");
  if (!std::isfinite(cx) || !std::isfinite(cy))
    return ParameterFault{std::isfinite(cx) ? "cy" : "cx",
                          fmt::format("principal point ({}, {}) is not finite", cx, cy)};
  return std::visit([](const auto& l) { return l.FindFault(); }, lens);
}

Status CameraModel::Check() const {
  if (const auto fault = FindFault())
    return Fail(ErrorCode::kInvalidOptions, "camera: {}", fault->message);
  return {};
}

std::string_view CameraModel::Key() const {
  return std::visit([](const auto& l) { return l.kModel; }, lens);
}

std::string_view CameraModel::Name() const {
  return std::visit([](const auto& l) { return NameOf(l); }, lens);
}

std::vector<std::string_view> CameraModel::ParameterNames() const {
  std::vector<std::string_view> names = {"fx", "fy", "cx", "cy"};
  std::visit(
      [&](const auto& l) { names.insert(names.end(), l.kParameters.begin(), l.kParameters.end()); },
      lens);
  return names;
}

CameraModel::Parameters CameraModel::Values() const {
  return std::visit(
      [this](const auto& l) {
        const auto of_lens = l.Parameters();
        Parameters values(4 + static_cast<Eigen::Index>(of_lens.size()));
        values.head<4>() << fx, fy, cx, cy;
        for (std::size_t i = 0; i < of_lens.size(); ++i)
          values[4 + static_cast<Eigen::Index>(i)] = of_lens[i];
        return values;
      },
      lens);
}

CameraModel CameraModel::WithValues(const Parameters& values) const {
  FORESIGHT_EXPECTS(values.size() == Values().size(), "a value for each parameter");
  CameraModel changed = *this;
  changed.fx = values[0];
  changed.fy = values[1];
  changed.cx = values[2];
  changed.cy = values[3];
  changed.lens = std::visit(
      [&](const auto& l) -> Lens {
        auto of_lens = l.Parameters();
        for (std::size_t i = 0; i < of_lens.size(); ++i)
          of_lens[i] = values[4 + static_cast<Eigen::Index>(i)];
        return l.FromParameters(of_lens);
      },
      lens);
  return changed;
}

std::optional<Eigen::Vector2d> CameraModel::Project(const Eigen::Vector3d& point) const {
  // The lens of most heads, without a call: every beam of a scan passes here.
  if (const auto* fisheye = std::get_if<FisheyeLens>(&lens)) {
    if (!IsOfThisWorld(point)) return std::nullopt;
    const auto per_h = FisheyeRadiusPerH(fisheye->k, std::hypot(point.x(), point.y()), point.z());
    if (!per_h) return std::nullopt;
    return Eigen::Vector2d(fx * (*per_h * point.x()) + cx, fy * (*per_h * point.y()) + cy);
  }
  return Project(point, nullptr, nullptr);
}

std::optional<Eigen::Vector2d> CameraModel::Project(const Eigen::Vector3d& point, ByPoint* by_point,
                                                    ByParameters* by_parameters) const {
  if (!IsOfThisWorld(point)) return std::nullopt;
  return std::visit(
      [&](const auto& l) { return ProjectThrough(l, *this, point, by_point, by_parameters); },
      lens);
}

std::optional<Eigen::Vector3d> CameraModel::Unproject(const Eigen::Vector2d& pixel) const {
  const double x = (pixel.x() - cx) / fx, y = (pixel.y() - cy) / fy;
  if (const auto* fisheye = std::get_if<FisheyeLens>(&lens)) return FisheyeRay(fisheye->k, x, y);
  return std::visit([&](const auto& l) { return l.Unproject({x, y}); }, lens);
}

std::optional<Eigen::Vector2d> CameraModel::UnprojectToPlane(const Eigen::Vector2d& pixel) const {
  const auto ray = Unproject(pixel);
  if (!ray || ray->z() < 1e-6) return std::nullopt;
  return Eigen::Vector2d(ray->x() / ray->z(), ray->y() / ray->z());
}

CameraModel PinholeCamera(int width, int height, double focal_px, double cx, double cy) {
  return {.width = width,
          .height = height,
          .fx = focal_px,
          .fy = focal_px,
          .cx = cx,
          .cy = cy,
          .lens = FisheyeLens{0.0}};
}

}  // namespace foresight
