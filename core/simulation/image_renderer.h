#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/rigid.h"
#include "core/sensor/camera_model.h"
#include "core/simulation/pixel_rays.h"
#include "core/simulation/ray_caster.h"
#include "core/simulation/surface_color.h"

namespace foresight {

/// The light that reaches a camera in a scene: Lambert and a little gloss under point lights with
/// hard shadows, and light from everywhere. `caster` outlives the renderer.
class ImageRenderer {
 public:
  static constexpr int kMoments = 16;
  /// Where the camera is at evenly spread moments of the exposure.
  using CameraMotion = std::array<Rigid<frame::Robot, frame::Camera>, kMoments>;

  ImageRenderer(const RayCaster& caster, const CameraModel& camera, int samples_side);

  /// The light of each pixel of row y; what a white surface under light 1 sends is 1.
  void RenderRow(const CameraMotion& motion, int y, std::span<Eigen::Vector3f> light) const;

  /// The depth along z through the pixel centres of row y; NaN = nothing there.
  void RenderDepthRow(const Rigid<frame::Robot, frame::Camera>& robot_from_camera, int y,
                      std::span<float> depth_m) const;

 private:
  struct Samples;

  void AimRow(const CameraMotion& motion, int y, Samples& samples) const;
  void ShadeAmbient(Samples& samples) const;
  Eigen::Vector3f Albedo(std::size_t sample, Samples& samples) const;
  void AddLight(const Light& light, Samples& samples) const;

  const RayCaster& caster_;
  CameraModel camera_;
  PixelRays rays_;
  SurfaceColor color_;
  int samples_side_;
};

}  // namespace foresight
