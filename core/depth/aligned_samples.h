#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/image.h"
#include "core/base/result.h"
#include "core/depth/ray_field.h"
#include "core/registration/register_scan.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// Why a sample does not take part in upsampling.
enum class RejectReason : std::uint8_t {
  kKept = 0,
  kFlying,    ///< Eq. (7): floats between two surfaces
  kIsolated,  ///< alone in the image after Eq. (7)
  kFlipping,  ///< Fig. 4: hidden from the camera by a nearer surface
};
const char* ToString(RejectReason reason);

/// One lidar measurement seen from the camera.
struct AlignedSample {
  float u = 0.0f;  ///< pixels; (0, 0) is the centre of the first pixel
  float v = 0.0f;
  float depth_m = 0.0f;  ///< along the camera's z axis
  std::int32_t line = 0;
  std::int32_t beam = 0;
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< in camera, metres; z = depth_m
};

/// Lidar measurements in one image, each knowing its place on the lidar's grid. Only samples with
/// 0 <= line < lines, 0 <= beam < beams, inside the image and with a depth in [kNearest_m,
/// kFarthest_m] are in here.
struct AlignedSamples {
  /// Wider than any lidar measures; squares of depths and of inverse depths still fit into a float.
  static constexpr float kNearest_m = 1e-3f;
  static constexpr float kFarthest_m = 1e4f;
  static bool IsDepth(float depth_m) { return depth_m >= kNearest_m && depth_m <= kFarthest_m; }

  int width = 0;  ///< of the image, pixels
  int height = 0;
  int lines = 0;  ///< of the lidar grid
  int beams = 0;
  /// The motor's angle of the image; NaN = not known.
  double motor_rad = std::numeric_limits<double>::quiet_NaN();
  std::vector<AlignedSample> samples;
  std::vector<RejectReason> reasons;  ///< one a sample
  /// Where the image's pixels look; null = a pinhole, or not known: pixels are taken for rays.
  std::shared_ptr<const RayField> rays;

  /// Samples per pixel of the whole image.
  double Density() const {
    return width > 0 && height > 0 ? static_cast<double>(samples.size()) / width / height : 0.0;
  }
  std::size_t KeptCount() const;

  /// Fails with kInvalidInput where a sample breaks one of the promises above.
  Status Check() const;
};

/// What every method needs: a guide of the samples' image size (else kInvalidInput) and a sample
/// that is kept (else kTooFewPoints).
Status CheckUpsamplingInput(const AlignedSamples& samples, const ColorImage& guide);

/// Index into samples for each cell of the lidar's grid, -1 = no sample; (beam, line) = (x, y).
/// With `only_kept`, rejected samples are left out.
Image<std::int32_t> GridOf(const AlignedSamples& samples, bool only_kept);

/// Median distance in pixels between neighbours along a line and between lines.
struct SampleSpacing {
  double along_line_px = 0.0;
  double between_lines_px = 0.0;
};
/// Fails with kTooFewPoints when there are no neighbours in one of the directions.
Result<SampleSpacing> MeasureSpacing(const AlignedSamples& samples);

/// Samples per pixel where the lidar looked: a scan need not cover the whole image, and what the
/// filter needs to know is how far its next sample is. The paper's proportion of measured points,
/// Fig. 6(a).
double LocalDensity(const AlignedSamples& samples);
/// The same where the spacing was measured already.
double LocalDensity(const AlignedSamples& samples, const Result<SampleSpacing>& spacing);

/// Section IV: projects the scan into the image taken at `motor_rad`. Points behind the camera or
/// outside the image are left out. Fails with kTooFewPoints when none is left. O(points).
Result<AlignedSamples> AlignToImage(const RegisteredScan& scan, const SensorRig& rig,
                                    double motor_rad, const RunContext& context);

/// The same for a scan that grows: adds the returns of the lines from `first_line` on to samples
/// that AlignToImage, or this, made of the lines before them, or to empty ones. Nothing in the
/// image is no failure here. O(points of these lines).
Status AlignMoreLines(const RegisteredScan& scan, int first_line, const SensorRig& rig,
                      double motor_rad, AlignedSamples& aligned, const RunContext& context);

}  // namespace foresight
