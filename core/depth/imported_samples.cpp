#include "core/depth/imported_samples.h"

#include <algorithm>

namespace foresight {
namespace {

constexpr std::int64_t kMaxGridPlaces = 100'000'000;

Result<Eigen::Vector3f> PointOf(const CsvSample& row, const CameraModel* camera,
                                const std::string& source) {
  const double depth_m = 1e-3 * row.depth_mm;
  if (camera == nullptr) return Eigen::Vector3f(0.0f, 0.0f, static_cast<float>(depth_m));
  const auto ray = camera->UnprojectToPlane({row.u, row.v});
  if (!ray)
    return Fail(ErrorCode::kInvalidInput,
                "{}: line {}, beam {}: the camera has no ray through pixel ({}, {})", source,
                row.line, row.beam, row.u, row.v);
  return Eigen::Vector3f((depth_m * ray->homogeneous()).cast<float>());
}

}  // namespace

Result<AlignedSamples> ImportSamples(std::span<const CsvSample> rows, int width, int height,
                                     const CameraModel* camera, const std::string& source,
                                     int* outside) {
  if (camera != nullptr && (camera->width != width || camera->height != height))
    return Fail(ErrorCode::kInvalidInput,
                "the camera is calibrated for {} x {} pixels, but the image has {} x {}",
                camera->width, camera->height, width, height);
  AlignedSamples samples;
  samples.width = width;
  samples.height = height;
  *outside = 0;
  for (const CsvSample& row : rows) {
    samples.lines = std::max(samples.lines, row.line + 1);
    samples.beams = std::max(samples.beams, row.beam + 1);
  }
  if (static_cast<std::int64_t>(samples.lines) * samples.beams > kMaxGridPlaces)
    return Fail(ErrorCode::kBadData, "{}: a grid of {} lines x {} beams is beyond any lidar",
                source, samples.lines, samples.beams);
  Image<std::uint8_t> taken(samples.beams, samples.lines, 0);
  for (const CsvSample& row : rows) {
    if (taken(row.beam, row.line)++ != 0)
      return Fail(ErrorCode::kBadData, "{}: line {}, beam {} is there twice", source, row.line,
                  row.beam);
    if (!(row.u >= -0.5 && row.v >= -0.5 && row.u < width - 0.5 && row.v < height - 0.5)) {
      ++*outside;
      continue;
    }
    FORESIGHT_TRY(const Eigen::Vector3f point, PointOf(row, camera, source));
    samples.samples.push_back({static_cast<float>(row.u), static_cast<float>(row.v), point.z(),
                               row.line, row.beam, point});
  }
  if (samples.samples.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "{}: none of {} samples lies in the image of {} x {} pixels", source, rows.size(),
                width, height);
  samples.reasons.assign(samples.samples.size(), RejectReason::kKept);
  if (camera != nullptr) samples.rays = RaysOf(*camera);
  return samples;
}

std::vector<CsvSample> ExportSamples(const AlignedSamples& samples) {
  std::vector<CsvSample> rows;
  rows.reserve(samples.samples.size());
  for (const AlignedSample& s : samples.samples)
    rows.push_back({s.line, s.beam, static_cast<double>(s.u), static_cast<double>(s.v),
                    1000.0 * static_cast<double>(s.depth_m)});
  return rows;
}

}  // namespace foresight
