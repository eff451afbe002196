#pragma once

namespace foresight::frame {

/// The frames of docs/conventions.md. They carry no data: they make Rigid<To, From> a distinct
/// type.
struct Robot {  ///< REP-103: x forward, y left, z up; origin chosen by the robot
  static constexpr const char* kName = "robot";
};
struct Base {  ///< the motor's frame, fixed to the robot: x = rotation axis to the right, y down, z
               ///< forward
  static constexpr const char* kName = "base";
};
struct Head {  ///< the plate turned by the motor; equals base at motor angle 0
  static constexpr const char* kName = "head";
};
struct Camera {  ///< x right, y down, z forward; pixel (0, 0) is the centre of the first pixel
  static constexpr const char* kName = "camera";
};
struct Lidar {  ///< x forward (beam at 0 deg), y left, z along the spin axis; beams lie in z = 0
  static constexpr const char* kName = "lidar";
};
struct Pattern {  ///< a calibration board: z = 0 on its plane
  static constexpr const char* kName = "pattern";
};
struct Object {  ///< a fitted object's own frame, see docs/conventions.md for each kind
  static constexpr const char* kName = "object";
};

}  // namespace foresight::frame
