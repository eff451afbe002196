#include "core/simulation/image_renderer.h"

#include <cmath>
#include <limits>

#include "core/base/contract.h"

namespace foresight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kGlossPower = 60.0f;
constexpr float kShadowGap_m = 2e-4f;  ///< a surface does not shade itself
/// Light 1 gives a surface 2 m away the light 1.
constexpr float kLightDistance2_m2 = 4.0f;

/// Spreads the moments of the exposure over the pixels without a visible pattern: that of a pixel's
/// first sub-ray.
int FirstMomentOf(int x, int y) {
  std::uint32_t h =
      static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca77u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h ^= h >> 13;
  return static_cast<int>(h % ImageRenderer::kMoments);
}

}  // namespace

/// The sub-rays of one row that can be seen, pixel by pixel.
struct ImageRenderer::Samples {
  std::vector<int> pixel;
  std::vector<Eigen::Vector2d> place;  ///< of the sub-ray in the image
  std::vector<std::size_t> moment;     ///< of the exposure
  std::array<Eigen::Matrix3f, kMoments> rotations;
  std::vector<SceneRay> rays;
  std::vector<SceneHit> hits;
  std::vector<Eigen::Vector3f> albedo;
  std::vector<Eigen::Vector3f> light;
  // The shadow rays of one light, and whose they are.
  std::vector<SceneRay> shadow_rays;
  std::vector<float> shadow_lengths;
  std::vector<std::size_t> shadow_owner;
  std::vector<std::uint8_t> occluded;
  SurfaceColor::Neighbourhood near;

  Eigen::Vector3f Point(std::size_t i) const {
    return rays[i].origin + hits[i].distance_m * rays[i].direction;
  }
};

ImageRenderer::ImageRenderer(const RayCaster& caster, const CameraModel& camera, int samples_side)
    : caster_(caster),
      camera_(camera),
      rays_(camera),
      color_(caster.scene()),
      samples_side_(samples_side) {}

void ImageRenderer::AimRow(const CameraMotion& motion, int y, Samples& samples) const {
  const int per_pixel = samples_side_ * samples_side_;
  std::array<Eigen::Matrix3f, kMoments>& rotations = samples.rotations;
  std::array<Eigen::Vector3f, kMoments> origins;
  for (std::size_t i = 0; i < kMoments; ++i) {
    rotations[i] = motion[i].RotationMatrix().cast<float>();
    origins[i] = motion[i].translation().cast<float>();
  }
  const auto count = static_cast<std::size_t>(camera_.width * per_pixel);
  samples.pixel.clear();
  samples.place.clear();
  samples.moment.clear();
  samples.rays.clear();
  samples.pixel.reserve(count);
  samples.rays.reserve(count);
  std::vector<Eigen::Vector2d> offsets;
  for (int s = 0; s < per_pixel; ++s)
    offsets.emplace_back((s % samples_side_ + 0.5) / samples_side_ - 0.5,
                         (s / samples_side_ + 0.5) / samples_side_ - 0.5);
  for (int x = 0; x < camera_.width; ++x) {
    const int first_moment = FirstMomentOf(x, y);
    for (int s = 0; s < per_pixel; ++s) {
      const Eigen::Vector2d place = Eigen::Vector2d(x, y) + offsets[static_cast<std::size_t>(s)];
      const auto ray = rays_.At(place);
      if (!ray) continue;
      const auto moment =
          static_cast<std::size_t>((first_moment + s * kMoments / per_pixel) % kMoments);
      samples.pixel.push_back(x);
      samples.place.push_back(place);
      samples.moment.push_back(moment);
      samples.rays.push_back({origins[moment], rotations[moment] * ray->cast<float>()});
    }
  }
  samples.hits.resize(samples.rays.size());
  caster_.Cast(samples.rays, samples.hits);
}

/// A print is averaged over the sub-ray's part of the pixel: to a twentieth of a pixel its edges
/// are where they are, not where the nearest sub-ray is.
Eigen::Vector3f ImageRenderer::Albedo(std::size_t sample, Samples& samples) const {
  const SceneHit& hit = samples.hits[sample];
  const Eigen::Vector3f point = samples.Point(sample);
  if (!color_.IsPrinted(hit.mesh, hit.normal))
    return color_.At(hit.mesh, point, hit.normal, &samples.near);
  const double half = 0.5 / samples_side_;
  const Eigen::Vector3f& origin = samples.rays[sample].origin;
  const float distance = (point - origin).dot(hit.normal);
  std::array<Eigen::Vector3f, 4> around;
  around.fill(point);
  const std::array<Eigen::Vector2d, 4> corners = {
      Eigen::Vector2d(-half, -half), {half, -half}, {half, half}, {-half, half}};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto ray = rays_.At(samples.place[sample] + corners[i]);
    if (!ray) continue;
    const Eigen::Vector3f direction =
        samples.rotations[samples.moment[sample]] * ray->cast<float>();
    const float along = direction.dot(hit.normal);
    if (along < -0.01f) around[i] = origin + distance / along * direction;
  }
  return color_.MeanOfPrint(hit.mesh, around);
}

void ImageRenderer::ShadeAmbient(Samples& samples) const {
  const Eigen::Vector3f background =
      Eigen::Vector3f::Constant(static_cast<float>(0.5 * caster_.scene().ambient));
  const auto ambient = static_cast<float>(caster_.scene().ambient);
  samples.albedo.resize(samples.rays.size());
  samples.light.resize(samples.rays.size());
  for (std::size_t i = 0; i < samples.rays.size(); ++i) {
    const SceneHit& hit = samples.hits[i];
    if (hit.mesh < 0) {
      samples.light[i] = background;
      continue;
    }
    const Material& material = caster_.scene().meshes[static_cast<std::size_t>(hit.mesh)].material;
    samples.albedo[i] = Albedo(i, samples);
    // More light comes from above than from below, so that shadowed sides still show their shape.
    const float from_everywhere = ambient * (0.8f + 0.2f * hit.normal.z());
    samples.light[i] =
        (from_everywhere + static_cast<float>(material.emission)) * samples.albedo[i];
  }
}

void ImageRenderer::AddLight(const Light& light, Samples& samples) const {
  const Eigen::Vector3f position = light.position_m.cast<float>();
  samples.shadow_rays.clear();
  samples.shadow_lengths.clear();
  samples.shadow_owner.clear();
  for (std::size_t i = 0; i < samples.rays.size(); ++i) {
    if (samples.hits[i].mesh < 0) continue;
    const Eigen::Vector3f start = samples.Point(i) + kShadowGap_m * samples.hits[i].normal;
    const Eigen::Vector3f to_light = position - start;
    if (to_light.dot(samples.hits[i].normal) <= 0.0f) continue;
    const float distance = to_light.norm();
    samples.shadow_rays.push_back({start, to_light / distance});
    samples.shadow_lengths.push_back(distance);
    samples.shadow_owner.push_back(i);
  }
  samples.occluded.resize(samples.shadow_rays.size());
  caster_.Occluded(samples.shadow_rays, samples.shadow_lengths, samples.occluded);

  for (std::size_t k = 0; k < samples.shadow_rays.size(); ++k) {
    if (samples.occluded[k] != 0) continue;
    const std::size_t i = samples.shadow_owner[k];
    const SceneHit& hit = samples.hits[i];
    const Eigen::Vector3f& to_light = samples.shadow_rays[k].direction;
    const float distance = samples.shadow_lengths[k];
    const float arriving =
        static_cast<float>(light.intensity) * kLightDistance2_m2 / (distance * distance);
    samples.light[i] += arriving * hit.normal.dot(to_light) * samples.albedo[i];
    const auto gloss = static_cast<float>(
        caster_.scene().meshes[static_cast<std::size_t>(hit.mesh)].material.specular);
    if (gloss <= 0.0f) continue;
    const Eigen::Vector3f half = (to_light - samples.rays[i].direction).normalized();
    const float shine = std::pow(std::max(0.0f, hit.normal.dot(half)), kGlossPower);
    samples.light[i] += Eigen::Vector3f::Constant(arriving * gloss * shine);
  }
}

void ImageRenderer::RenderRow(const CameraMotion& motion, int y,
                              std::span<Eigen::Vector3f> light) const {
  FORESIGHT_EXPECTS(static_cast<int>(light.size()) == camera_.width, "light for every pixel");
  // Half a megabyte, which would be asked of the system anew for each row.
  static thread_local Samples samples;
  AimRow(motion, y, samples);
  ShadeAmbient(samples);
  for (const Light& lamp : caster_.scene().lights) AddLight(lamp, samples);
  for (Eigen::Vector3f& value : light) value.setZero();
  const float fraction = 1.0f / static_cast<float>(samples_side_ * samples_side_);
  for (std::size_t i = 0; i < samples.rays.size(); ++i)
    light[static_cast<std::size_t>(samples.pixel[i])] += fraction * samples.light[i];
}

void ImageRenderer::RenderDepthRow(const Rigid<frame::Robot, frame::Camera>& robot_from_camera,
                                   int y, std::span<float> depth_m) const {
  FORESIGHT_EXPECTS(static_cast<int>(depth_m.size()) == camera_.width, "a depth for every pixel");
  std::vector<SceneRay> rays;
  std::vector<std::pair<std::size_t, double>> pixel_and_z;
  for (std::size_t x = 0; x < depth_m.size(); ++x) {
    depth_m[x] = kNaN;
    const auto ray = camera_.Unproject(Eigen::Vector2d(static_cast<double>(x), y));
    if (!ray || ray->z() <= 0.0) continue;
    rays.push_back({robot_from_camera.translation().cast<float>(),
                    robot_from_camera.Rotate(*ray).cast<float>()});
    pixel_and_z.emplace_back(x, ray->z());
  }
  std::vector<SceneHit> hits(rays.size());
  caster_.Cast(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i)
    depth_m[pixel_and_z[i].first] = static_cast<float>(hits[i].distance_m * pixel_and_z[i].second);
}

}  // namespace foresight
