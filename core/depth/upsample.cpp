#include "core/depth/upsample.h"

#include <cmath>

#include "core/depth/joint_upsampler.h"

namespace foresight {

Status UpsampleOptions::Check() const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (sigma_spatial_px != 0.0 && !(sigma_spatial_px >= 0.5 && sigma_spatial_px <= 200.0))
    return Fail(ErrorCode::kInvalidOptions,
                "upsampling: sigma_spatial_px {} is neither 0 (automatic) nor in [0.5, 200]",
                sigma_spatial_px);
  if (!(radius_in_sigmas >= 0.5 && radius_in_sigmas <= 4.0))
    return Fail(ErrorCode::kInvalidOptions, "upsampling: radius_in_sigmas {} is not in [0.5, 4]",
                radius_in_sigmas);
  if (!positive(sigma_intensity))
    return Fail(ErrorCode::kInvalidOptions, "upsampling: sigma_intensity {} is not positive",
                sigma_intensity);
  if (!positive(sigma_depth_m))
    return Fail(ErrorCode::kInvalidOptions, "upsampling: sigma_depth_m {} is not positive",
                sigma_depth_m);
  if (iterations < 0 || iterations > 50)
    return Fail(ErrorCode::kInvalidOptions, "upsampling: iterations {} is not in [0, 50]",
                iterations);
  if (iterations == 0 && confidence_passes == ConfidencePasses::kGuided)
    return Fail(ErrorCode::kInvalidOptions,
                "upsampling: confidence_passes of guided passes alone, but iterations is 0");
  return {};
}

Result<DenseDepth> UpsampleDepth(const AlignedSamples& samples, const ColorImage& guide,
                                 const UpsampleOptions& options, const RunContext& context) {
  JointUpsampler upsampler(guide, options);
  FORESIGHT_CHECK(upsampler.Update(samples, context));
  return upsampler.TakeDense();
}

GrayImage ToGray(const ColorImage& image) {
  GrayImage gray(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb8 p = image.values()[i];
    gray.values()[i] = static_cast<std::uint8_t>((299 * p.r + 587 * p.g + 114 * p.b + 500) / 1000);
  }
  return gray;
}

}  // namespace foresight
