#include "core/depth/depth_method.h"

#include <array>

namespace foresight {
namespace {

constexpr std::array<DepthMethodInfo, 5> kMethods = {{
    {DepthMethod::kForesight, "foresight", "Foresight",
     "Local planes guided by colour; keeps what the lidar really saw, with an absolute "
     "confidence."},
    {DepthMethod::kPaper, "paper", "Paper (Shim 2016)",
     "Rejection of flying, isolated and flipping points, joint filter with rolling guidance, "
     "confidence mask."},
    {DepthMethod::kJointBilateral, "jbu", "Joint bilateral (Kopf 2007)",
     "One pass of the joint filter over the raw samples; only pixels out of reach stay empty."},
    {DepthMethod::kTgv, "tgv", "Total generalized variation (Ferstl 2013)",
     "Planes that break at edges of the image, fitted to the raw samples; fills every pixel."},
    {DepthMethod::kNonlocal, "nonlocal", "Nonlocal means (Park 2011)",
     "Least squares that ties pixels with similar neighbourhoods, on the raw samples; fills every "
     "pixel."},
}};

/// A flipping sample must lie clearly behind. Eq. (7) is off: on scenes with mixed pixels it gained
/// 0.1 mm of A95 and cost coverage; a plane's neighbours vote a floating sample down.
DepthOptions ForesightOptions() {
  DepthOptions options;
  options.method = DepthMethod::kForesight;
  options.flying.rule = FlyingPointOptions::Rule::kOff;
  options.isolated.enabled = false;
  options.flipping.margin_m = 0.050;
  options.flipping.cells = FlippingPointOptions::Cells::kFromAllSamples;
  options.mask.threshold = 0.61;
  return options;
}

/// The methods the paper is compared with take the raw samples.
DepthOptions WithoutRejection(DepthMethod method) {
  DepthOptions options;
  options.method = method;
  options.flying.rule = FlyingPointOptions::Rule::kOff;
  options.isolated.enabled = false;
  options.flipping.test = FlippingPointOptions::Test::kOff;
  options.mask.threshold = 0.0;
  return options;
}

}  // namespace

std::span<const DepthMethodInfo> DepthMethods() {
  return kMethods;
}

const DepthMethodInfo& InfoOf(DepthMethod method) {
  for (const DepthMethodInfo& info : kMethods)
    if (info.method == method) return info;
  throw ContractViolation("method", "every method has its entry in kMethods", __FILE__, __LINE__);
}

Result<DepthMethod> DepthMethodFromName(const std::string& name) {
  std::string names;
  for (const DepthMethodInfo& info : kMethods) {
    if (name == info.name) return info.method;
    names += std::string(names.empty() ? "" : ", ") + info.name;
  }
  return Fail(ErrorCode::kInvalidOptions, "depth method '{}' is not known; there are {}", name,
              names);
}

DepthOptions DefaultsOf(DepthMethod method) {
  switch (method) {
    case DepthMethod::kForesight:
      return ForesightOptions();
    case DepthMethod::kPaper:
      return DepthOptions();
    case DepthMethod::kJointBilateral: {
      DepthOptions options = WithoutRejection(method);
      options.upsample.iterations = 0;
      return options;
    }
    case DepthMethod::kTgv:
    case DepthMethod::kNonlocal:
      return WithoutRejection(method);
  }
  return DepthOptions();
}

}  // namespace foresight
