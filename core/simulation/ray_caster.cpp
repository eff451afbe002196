#include "core/simulation/ray_caster.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "core/base/contract.h"

namespace foresight {
namespace {

constexpr float kNoRange = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kPacket = 16;

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using ScenePtr = std::unique_ptr<RTCSceneTy, SceneRelease>;

void ThrowOnError(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(
        fmt::format("Embree: {} failed with code {}", what, static_cast<int>(error)));
}

void AttachMesh(RTCDevice device, RTCScene scene, const SceneMesh& mesh, unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Vector3i) == 12);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Eigen::Vector3f),
                                           std::max<std::size_t>(1, mesh.vertices.size()));
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(Eigen::Vector3i), mesh.triangles.size());
  ThrowOnError(device, "the buffer of a mesh");
  std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(Eigen::Vector3f));
  std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(Eigen::Vector3i));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

SceneHit HitOf(float distance, unsigned mesh, Eigen::Vector3f normal,
               const Eigen::Vector3f& direction) {
  if (mesh == RTC_INVALID_GEOMETRY_ID) return {kNoRange, -1, Eigen::Vector3f::Zero()};
  normal.normalize();
  const bool from_behind = normal.dot(direction) > 0.0f;
  if (from_behind) normal = -normal;
  return {distance, static_cast<int>(mesh), normal, from_behind};
}

/// Works for RTCRay16 and, through its `ray` member, RTCRayHit16.
void SetRay(RTCRay16& packet, std::size_t lane, const SceneRay& ray, float distance) {
  packet.org_x[lane] = ray.origin.x();
  packet.org_y[lane] = ray.origin.y();
  packet.org_z[lane] = ray.origin.z();
  packet.dir_x[lane] = ray.direction.x();
  packet.dir_y[lane] = ray.direction.y();
  packet.dir_z[lane] = ray.direction.z();
  packet.tnear[lane] = 0.0f;
  packet.tfar[lane] = distance;
  packet.time[lane] = 0.0f;
  packet.mask[lane] = ~0u;
  packet.id[lane] = 0;
  packet.flags[lane] = 0;
}

RTCRay MakeRay(const SceneRay& from, float distance) {
  RTCRay ray{};
  ray.org_x = from.origin.x();
  ray.org_y = from.origin.y();
  ray.org_z = from.origin.z();
  ray.dir_x = from.direction.x();
  ray.dir_y = from.direction.y();
  ray.dir_z = from.direction.z();
  ray.tfar = distance;
  ray.mask = ~0u;
  return ray;
}

RTCIntersectContext CoherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

}  // namespace

struct RayCaster::Impl {
  std::shared_ptr<const Scene> scene;
  DevicePtr device;
  ScenePtr embree_scene;  // released before the device
};

RayCaster::RayCaster(std::shared_ptr<const Scene> scene) : impl_(std::make_unique<Impl>()) {
  FORESIGHT_EXPECTS(scene != nullptr, "a ray caster needs a scene");
  impl_->scene = std::move(scene);
  impl_->device.reset(rtcNewDevice(nullptr));
  if (!impl_->device) ThrowOnError(nullptr, "starting a device");
  impl_->embree_scene.reset(rtcNewScene(impl_->device.get()));
  RTCScene embree_scene = impl_->embree_scene.get();
  // Without it single rays slip through the edges between triangles: black specks in the image.
  rtcSetSceneFlags(embree_scene, RTC_SCENE_FLAG_ROBUST);
  // Scenes are small: the time that a better tree takes comes back with the first image.
  rtcSetSceneBuildQuality(embree_scene, RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < impl_->scene->meshes.size(); ++i)
    if (!impl_->scene->meshes[i].triangles.empty())
      AttachMesh(impl_->device.get(), embree_scene, impl_->scene->meshes[i],
                 static_cast<unsigned>(i));
  rtcCommitScene(embree_scene);
  ThrowOnError(impl_->device.get(), "building the scene");
}

RayCaster::~RayCaster() = default;

const Scene& RayCaster::scene() const {
  return *impl_->scene;
}

SceneHit RayCaster::Cast(const SceneRay& ray) const {
  RTCRayHit query{};
  query.ray = MakeRay(ray, kInfinity);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->embree_scene.get(), &context, &query);
  return HitOf(query.ray.tfar, query.hit.geomID, {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z},
               ray.direction);
}

void RayCaster::Cast(std::span<const SceneRay> rays, std::span<SceneHit> hits) const {
  FORESIGHT_EXPECTS(rays.size() == hits.size(), "one hit for every ray");
  RTCIntersectContext context = CoherentContext();
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    alignas(64) int valid[kPacket];
    RTCRayHit16 packet;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      valid[lane] = lane < count ? -1 : 0;
      SetRay(packet.ray, lane, rays[first + std::min(lane, count - 1)], kInfinity);
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, impl_->embree_scene.get(), &context, &packet);
    for (std::size_t lane = 0; lane < count; ++lane)
      hits[first + lane] =
          HitOf(packet.ray.tfar[lane], packet.hit.geomID[lane],
                {packet.hit.Ng_x[lane], packet.hit.Ng_y[lane], packet.hit.Ng_z[lane]},
                rays[first + lane].direction);
  }
}

bool RayCaster::Occluded(const SceneRay& ray, float distance_m) const {
  RTCRay query = MakeRay(ray, distance_m);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->embree_scene.get(), &context, &query);
  return query.tfar < 0.0f;
}

void RayCaster::Occluded(std::span<const SceneRay> rays, std::span<const float> distances_m,
                         std::span<std::uint8_t> occluded) const {
  FORESIGHT_EXPECTS(rays.size() == distances_m.size() && rays.size() == occluded.size(),
                    "one distance and one answer for every ray");
  RTCIntersectContext context = CoherentContext();
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    alignas(64) int valid[kPacket];
    RTCRay16 packet;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      const std::size_t i = first + std::min(lane, count - 1);
      valid[lane] = lane < count ? -1 : 0;
      SetRay(packet, lane, rays[i], distances_m[i]);
    }
    rtcOccluded16(valid, impl_->embree_scene.get(), &context, &packet);
    for (std::size_t lane = 0; lane < count; ++lane)
      occluded[first + lane] = packet.tfar[lane] < 0.0f ? 1 : 0;
  }
}

}  // namespace foresight
