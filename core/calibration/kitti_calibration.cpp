#include "core/calibration/kitti_calibration.h"

#include <Eigen/Dense>
#include <charconv>
#include <cmath>
#include <map>
#include <vector>

#include "core/geometry/nearest_rotation.h"
#include "core/io/cloud_columns.h"

namespace foresight {
namespace {

using Rows = std::map<std::string, std::vector<double>, std::less<>>;

Result<std::vector<double>> Numbers(const std::vector<std::string_view>& words,
                                    const std::string& source) {
  std::vector<double> numbers;
  for (std::size_t i = 1; i < words.size(); ++i) {
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(words[i].data(), words[i].data() + words[i].size(), value);
    if (error != std::errc() || end != words[i].data() + words[i].size() || !std::isfinite(value))
      return Fail(ErrorCode::kBadData, "{}: {} '{}' is not a number", source,
                  words[0].substr(0, 32), words[i].substr(0, 32));
    numbers.push_back(value);
  }
  return numbers;
}

Result<Rows> ReadRows(std::string_view text, const std::string& source) {
  Rows rows;
  while (const auto line = TakeLine(text)) {
    std::vector<std::string_view> words = Words(*line);
    if (words.empty()) continue;
    std::string_view key = words[0];
    if (key.ends_with(':')) key.remove_suffix(1);
    const bool wanted = key.starts_with("P") || key.starts_with("R") || key.starts_with("Tr");
    if (!wanted) continue;
    FORESIGHT_TRY(rows[std::string(key.substr(0, 32))], Numbers(words, source));
  }
  return rows;
}

/// The first of the names that is there, with `count` numbers.
Result<std::vector<double>> Row(const Rows& rows, std::initializer_list<const char*> names,
                                std::size_t count, const std::string& source) {
  for (const char* name : names) {
    const auto row = rows.find(std::string_view(name));
    if (row == rows.end()) continue;
    if (row->second.size() == count) return row->second;
    return Fail(ErrorCode::kBadData, "{}: {} has {} numbers instead of {}", source, name,
                row->second.size(), count);
  }
  return Fail(ErrorCode::kBadData, "{}: is no calibration of KITTI: it has no row {}", source,
              *names.begin());
}

using Matrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
using Matrix33 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// A rotation as printed: its digits are rounded.
Result<Eigen::Matrix3d> RotationFrom(const Eigen::Matrix3d& matrix, const char* name,
                                     const std::string& source) {
  constexpr double kRounding = 1e-3;
  const Eigen::Matrix3d rotation = NearestRotation(matrix);
  if (matrix.allFinite() && (rotation - matrix).cwiseAbs().maxCoeff() < kRounding) return rotation;
  return Fail(ErrorCode::kBadData, "{}: {} is no rotation", source, name);
}

}  // namespace

bool LooksLikeKittiCalibration(std::string_view text) {
  return text.starts_with("P0:") || text.starts_with("P2:") ||
         text.find("\nP2:") != std::string_view::npos;
}

Result<KittiCamera> KittiCameraFrom(std::string_view text, int number, const std::string& source) {
  FORESIGHT_TRY(const Rows rows, ReadRows(text, source));
  const std::string name = fmt::format("P{}", number);
  FORESIGHT_TRY(const std::vector<double> p, Row(rows, {name.c_str()}, 12, source));
  FORESIGHT_TRY(const std::vector<double> tr,
                Row(rows, {"Tr_velo_to_cam", "Tr_velo_cam", "Tr"}, 12, source));
  const Eigen::Map<const Matrix34> projection(p.data());
  const Eigen::Map<const Matrix34> camera_from_velodyne(tr.data());
  Eigen::Matrix3d rectified = Eigen::Matrix3d::Identity();
  if (rows.contains("R0_rect") || rows.contains("R_rect")) {
    FORESIGHT_TRY(const std::vector<double> r, Row(rows, {"R0_rect", "R_rect"}, 9, source));
    FORESIGHT_TRY(rectified, RotationFrom(Eigen::Map<const Matrix33>(r.data()), "R0_rect", source));
  }
  FORESIGHT_TRY(const Eigen::Matrix3d turn,
                RotationFrom(camera_from_velodyne.leftCols<3>(), "Tr_velo_to_cam", source));
  KittiCamera found;
  found.camera.fx = projection(0, 0);
  found.camera.fy = projection(1, 1);
  found.camera.cx = projection(0, 2);
  found.camera.cy = projection(1, 2);
  found.camera.lens = FisheyeLens{0.0};
  const Eigen::Matrix3d k = projection.leftCols<3>();
  if (!(found.camera.fx > 1.0 && found.camera.fy > 1.0) ||
      !k.isApprox((Eigen::Matrix3d() << found.camera.fx, 0, found.camera.cx, 0, found.camera.fy,
                   found.camera.cy, 0, 0, 1)
                      .finished(),
                  1e-9))
    return Fail(ErrorCode::kBadData, "{}: {} is no projection of a rectified camera", source, name);
  // P = K [I | t]: where the camera stands beside the reference camera.
  const Eigen::Vector3d beside = k.inverse() * projection.col(3);
  const Eigen::Matrix3d rotation = rectified * turn;
  found.camera_from_velodyne = Rigid<frame::Camera, frame::Robot>(
      NearestRotation(rotation), rectified * camera_from_velodyne.col(3) + beside);
  constexpr double kMostAside_m = 2.0;  // as in SensorRig::Check
  const Eigen::Vector3d& aside = found.camera_from_velodyne.translation();
  if (!aside.allFinite() || aside.norm() > kMostAside_m)
    return Fail(ErrorCode::kBadData, "{}: {} stands {:.3g} m from the velodyne (at most {})",
                source, name, aside.norm(), kMostAside_m);
  return found;
}

}  // namespace foresight
