#include "core/simulation/world.h"

#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "core/base/contract.h"
#include "core/base/parallel.h"
#include "core/simulation/image_renderer.h"
#include "core/simulation/image_sensor.h"
#include "core/simulation/lidar_simulator.h"
#include "core/simulation/lidar_view.h"
#include "core/simulation/motor_simulator.h"
#include "core/simulation/noise_stream.h"
#include "core/simulation/ray_caster.h"

namespace foresight {
namespace {

std::shared_ptr<const Scene> Checked(std::shared_ptr<const Scene> scene, const SensorRig& rig,
                                     const WorldOptions& options) {
  FORESIGHT_EXPECTS(scene != nullptr, "a world needs a scene");
  const Status rig_status = rig.Check();
  FORESIGHT_EXPECTS(rig_status.has_value(), rig_status.error().message);
  const Status options_status = options.Check();
  FORESIGHT_EXPECTS(options_status.has_value(), options_status.error().message);
  return scene;
}

}  // namespace

/// The scene with its stand at one place, ready to be looked at.
struct ShownScene {
  ShownScene(const std::shared_ptr<const Scene>& from, int at, const SensorRig& rig,
             const WorldOptions& options)
      : place(at),
        caster(at == 0 ? from : std::make_shared<const Scene>(AtPlace(*from, at))),
        lidar(caster, rig, options.lidar, options.seed),
        renderer(caster, rig.camera, options.camera.samples_side) {}

  const int place;
  RayCaster caster;
  LidarSimulator lidar;
  ImageRenderer renderer;
};

struct World::Impl {
  Impl(std::shared_ptr<const Scene> from, const SensorRig& true_rig, const WorldOptions& with)
      : scene(Checked(std::move(from), true_rig, with)),
        rig(true_rig),
        options(with),
        motor(with.motor, with.seed),
        sensor(true_rig.camera, with.camera, with.seed),
        shown(Show(scene->places.empty() ? 0 : 1)) {}

  double Jitter(NoisePurpose purpose, std::int64_t seq) const {
    if (!options.motor.enabled) return 0.0;
    return options.motor.jitter_rad * NoiseStream(options.seed, purpose, seq).Normal();
  }
  Rigid<frame::Robot, frame::Camera> RobotFromCamera(double plate_rad) const {
    return rig.robot_from_base * HeadFromBase(plate_rad).Inverse() * rig.camera_from_head.Inverse();
  }
  std::shared_ptr<const ShownScene> Show(int place) const {
    return std::make_shared<const ShownScene>(scene, place, rig, options);
  }
  std::shared_ptr<const ShownScene> Shown() const {
    const std::lock_guard lock(mutex);
    return shown;
  }

  std::shared_ptr<const Scene> scene;
  SensorRig rig;
  WorldOptions options;
  MotorSimulator motor;
  ImageSensor sensor;
  mutable std::mutex mutex;  ///< guards what follows
  mutable std::shared_ptr<const ShownScene> shown;
};

World::World(std::shared_ptr<const Scene> scene, const SensorRig& true_rig,
             const WorldOptions& options)
    : impl_(std::make_shared<const Impl>(std::move(scene), true_rig, options)) {}

const Scene& World::scene() const {
  return *impl_->scene;
}

const SensorRig& World::true_rig() const {
  return impl_->rig;
}

const WorldOptions& World::options() const {
  return impl_->options;
}

Status World::MoveStand(int place) const {
  const auto places = static_cast<int>(impl_->scene->places.size());
  if (place < 0 || place > places)
    return Fail(ErrorCode::kInvalidInput, "scene '{}': there is no place {}; it has {}",
                impl_->scene->name, place, places);
  auto shown = impl_->Show(place);
  const std::lock_guard lock(impl_->mutex);
  impl_->shown = std::move(shown);
  return {};
}

int World::StandAt() const {
  return impl_->Shown()->place;
}

double World::PlateAngle(double motor_rad, bool moving_up) const {
  return impl_->motor.PlateAngle(motor_rad, moving_up);
}

double World::EncoderAngle(double motor_rad) const {
  return impl_->motor.EncoderAngle(motor_rad);
}

AngleCorrection World::CalibratedCorrection() const {
  return impl_->motor.CalibratedCorrection();
}

LidarLine World::MeasureLine(std::int64_t seq, double time_s,
                             const std::function<double(double)>& motor_rad_at) const {
  const LidarModel& lidar = impl_->rig.lidar;
  const bool moving_up = motor_rad_at(time_s + lidar.BeamTime(lidar.beams - 1)) >=
                         motor_rad_at(time_s + lidar.BeamTime(0));
  const double jitter_rad = impl_->Jitter(NoisePurpose::kLidarJitter, seq);
  return impl_->Shown()->lidar.Measure(seq, time_s, [&](double beam_time_s) {
    return PlateAngle(motor_rad_at(beam_time_s), moving_up) + jitter_rad;
  });
}

CameraFrame World::CaptureImage(std::int64_t seq, double time_s, double exposure_s, double gain_db,
                                const std::function<double(double)>& motor_rad_at,
                                const RunContext& context) const {
  const double start_s = time_s - 0.5 * exposure_s;
  const bool moving_up = motor_rad_at(start_s + exposure_s) >= motor_rad_at(start_s);
  const double jitter_rad = impl_->Jitter(NoisePurpose::kImageJitter, seq);
  ImageRenderer::CameraMotion motion;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double moment_s =
        start_s + exposure_s * (static_cast<double>(i) + 0.5) / static_cast<double>(motion.size());
    motion[i] = impl_->RobotFromCamera(PlateAngle(motor_rad_at(moment_s), moving_up) + jitter_rad);
  }

  CameraFrame frame{.seq = seq,
                    .time_s = time_s,
                    .exposure_s = exposure_s,
                    .gain_db = gain_db,
                    .motor_angle_rad = EncoderAngle(motor_rad_at(time_s)),
                    .target_angle_rad = 0.0,
                    .image = {}};
  const CameraModel& camera = impl_->rig.camera;
  const auto width = static_cast<std::size_t>(camera.width);
  ColorImage image(camera.width, camera.height);
  const auto shown = impl_->Shown();
  const bool finished = ParallelFor(camera.height, context, [&](int y) {
    std::vector<Eigen::Vector3f> light(width);
    shown->renderer.RenderRow(motion, y, light);
    impl_->sensor.ExposeRow(seq, y, exposure_s, gain_db, light, {image.row(y), width});
  });
  if (finished) frame.image = std::move(image);
  return frame;
}

DepthImage World::TrueDepth(double motor_rad, const RunContext& context) const {
  const CameraModel& camera = impl_->rig.camera;
  const auto robot_from_camera = impl_->RobotFromCamera(PlateAngle(motor_rad, true));
  DepthImage depth(camera.width, camera.height);
  const auto shown = impl_->Shown();
  const bool finished = ParallelFor(camera.height, context, [&](int y) {
    shown->renderer.RenderDepthRow(robot_from_camera, y,
                                   {depth.row(y), static_cast<std::size_t>(camera.width)});
  });
  return finished ? depth : DepthImage();
}

MaskImage World::SeenByLidar(const DepthImage& true_depth_m, double motor_rad, double from_rad,
                             double to_rad, const RunContext& context) const {
  const CameraModel& camera = impl_->rig.camera;
  FORESIGHT_EXPECTS(true_depth_m.width() == camera.width && true_depth_m.height() == camera.height,
                    "the true depth is of the head's camera");
  const auto shown = impl_->Shown();
  const LidarView view(shown->caster, impl_->rig, PlateAngle(from_rad, true),
                       PlateAngle(to_rad, true));
  const auto robot_from_camera = impl_->RobotFromCamera(PlateAngle(motor_rad, true));
  const Eigen::Vector3d nowhere =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  MaskImage mask(camera.width, camera.height);
  const bool finished = ParallelFor(camera.height, context, [&](int y) {
    const auto width = static_cast<std::size_t>(camera.width);
    std::vector<Eigen::Vector3d> points(width, nowhere);
    for (int x = 0; x < camera.width; ++x)
      if (const auto in_plane = camera.UnprojectToPlane(Eigen::Vector2d(x, y)))
        points[static_cast<std::size_t>(x)] =
            robot_from_camera * (double{true_depth_m(x, y)} * in_plane->homogeneous());
    const std::span<std::uint8_t> row(mask.row(y), width);
    view.Seen(points, row);
    for (std::uint8_t& value : row) value = value != 0 ? 255 : 0;
  });
  return finished ? mask : MaskImage();
}

Rigid<frame::Base, frame::Robot> World::BaseFromRobot() const {
  return impl_->rig.robot_from_base.Inverse();
}

}  // namespace foresight
