// Any samples, any image, any options of any method: a defined depth map or an error.
#include <fuzzer/FuzzedDataProvider.h>

#include <bit>
#include <cmath>

#include "core/depth/depth_method.h"
#include "tests/fuzz/require.h"

namespace foresight {
namespace {

/// A lens that bends, and sees nothing in a corner.
std::shared_ptr<const RayField> CurvedRays(int width, int height) {
  auto rays = std::make_shared<RayField>();
  rays->x = FloatImage(width, height);
  rays->y = rays->x;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float stretch = 1.0f + 0.02f * static_cast<float>(x * x + y * y);
      rays->x(x, y) = 0.01f * stretch * static_cast<float>(x);
      rays->y(x, y) = 0.01f * stretch * static_cast<float>(y);
    }
  rays->x(width - 1, height - 1) = rays->y(width - 1, height - 1) = NAN;
  return rays;
}

AlignedSamples SamplesFrom(FuzzedDataProvider& data, int width, int height) {
  AlignedSamples samples;
  samples.width = width;
  samples.height = height;
  samples.lines = data.ConsumeIntegralInRange(1, 8);
  samples.beams = data.ConsumeIntegralInRange(1, 12);
  // Most inputs are sane but for a few samples, or nothing behind the checks is ever reached.
  const bool wild = data.ConsumeIntegralInRange(0, 7) == 0;
  const int count = data.ConsumeIntegralInRange(0, samples.lines * samples.beams);
  for (int i = 0; i < count; ++i) {
    AlignedSample s;
    s.line = i / samples.beams;
    s.beam = i % samples.beams;
    s.u = static_cast<float>(data.ConsumeIntegralInRange(0, 255)) / 256.0f *
              static_cast<float>(width) -
          0.5f;
    s.v = static_cast<float>(data.ConsumeIntegralInRange(0, 255)) / 256.0f *
              static_cast<float>(height) -
          0.5f;
    // 1 mm to 7 km, evenly in its logarithm.
    s.depth_m = 1e-3f * std::exp2(static_cast<float>(data.ConsumeIntegralInRange(0, 255)) / 11.2f);
    if (wild) s.depth_m = std::bit_cast<float>(data.ConsumeIntegral<std::uint32_t>());
    s.point = {s.u * s.depth_m / 100.0f, s.v * s.depth_m / 100.0f, s.depth_m};
    samples.samples.push_back(s);
  }
  samples.reasons.assign(samples.samples.size(), RejectReason::kKept);
  if (data.ConsumeBool()) samples.rays = CurvedRays(width, height);
  return samples;
}

ColorImage GuideFrom(FuzzedDataProvider& data, int width, int height) {
  ColorImage guide(width, height);
  const auto colours = data.ConsumeBytes<std::uint8_t>(64);
  for (std::size_t i = 0; i < guide.size() && !colours.empty(); ++i) {
    const std::uint8_t c = colours[i * 7 % colours.size()];
    guide.values()[i] = {c, static_cast<std::uint8_t>(255 - c), colours[i % colours.size()]};
  }
  return guide;
}

template <class T>
T Choose(FuzzedDataProvider& data, std::initializer_list<T> values) {
  return values.begin()[data.ConsumeIntegralInRange<std::size_t>(0, values.size() - 1)];
}

DepthOptions OptionsFrom(FuzzedDataProvider& data) {
  const auto methods = DepthMethods();
  DepthOptions options =
      DefaultsOf(methods[data.ConsumeIntegralInRange<std::size_t>(0, methods.size() - 1)].method);
  using Flying = FlyingPointOptions;
  using Flipping = FlippingPointOptions;
  using Weights = UpsampleOptions::Weights;
  options.flying.rule = Choose(
      data, {Flying::Rule::kOff, Flying::Rule::kAnyNeighbourFar, Flying::Rule::kBothNeighboursFar});
  options.flying.distance = Choose(data, {Flying::Distance::kEuclidean, Flying::Distance::kDepth});
  options.flying.threshold_m = Choose(data, {0.03, 1.0, 1e4});
  options.flying.threshold_per_step = Choose(data, {0.0, 2.0});
  options.isolated.enabled = data.ConsumeBool();
  options.flipping.test =
      Choose(data, {Flipping::Test::kOff, Flipping::Test::kCells, Flipping::Test::kMesh});
  options.flipping.cells =
      Choose(data, {Flipping::Cells::kFromKeptSamples, Flipping::Cells::kFromAllSamples});
  options.flipping.margin_m = Choose(data, {0.0, 0.05});
  options.flipping.connected_step_m = Choose(data, {0.1, 1e5});
  options.upsample.weights = Choose(data, {Weights::kProduct, Weights::kLiteral});
  options.upsample.confidence_terms = Choose(data, {Weights::kProduct, Weights::kLiteral});
  options.upsample.confidence_passes = Choose(
      data, {ConfidencePasses::kAll, ConfidencePasses::kEveryDepth, ConfidencePasses::kGuided});
  options.upsample.iterations = data.ConsumeIntegralInRange(0, 5);
  options.upsample.sigma_spatial_px = Choose(data, {0.0, 0.5, 8.0});
  options.upsample.keep_iterations = data.ConsumeBool();
  options.local_plane.sigma_spatial_px = options.upsample.sigma_spatial_px;
  options.local_plane.iterations = 1 + options.upsample.iterations;
  options.local_plane.keep_iterations = options.upsample.keep_iterations;
  options.tgv.iterations = 1 + 4 * options.upsample.iterations;
  options.nonlocal.iterations = options.tgv.iterations;
  options.nonlocal.window_radius_px = 2;
  options.mask.reference = Choose(data, {ConfidenceMaskOptions::Reference::kLargest,
                                         ConfidenceMaskOptions::Reference::kNominal});
  return options;
}

void RequireDefined(const DepthResult& result) {
  Require(std::isfinite(result.dense.max_confidence) && result.dense.nominal_confidence > 0.0f,
          "the confidence has a reference");
  for (std::size_t i = 0; i < result.dense.depth_m.size(); ++i) {
    const float depth_m = result.dense.depth_m.values()[i];
    Require(!std::isinf(depth_m), "a depth is finite or NaN");
    Require(result.dense.confidence.values()[i] >= 0.0f &&
                std::isfinite(result.dense.confidence.values()[i]),
            "a confidence is finite and not negative");
    Require(!std::isnan(depth_m) || result.mask.values()[i] == 0, "a mask only where a depth is");
  }
  for (const DepthImage& pass : result.dense.iterations)
    for (const float depth_m : pass.values())
      Require(!std::isinf(depth_m), "a depth of a pass is finite or NaN");
}

}  // namespace
}  // namespace foresight

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  FuzzedDataProvider data(bytes, size);
  const int width = data.ConsumeIntegralInRange(1, 40);
  const int height = data.ConsumeIntegralInRange(1, 24);
  const DepthOptions options = OptionsFrom(data);
  const ColorImage guide = GuideFrom(data, width, height);
  const AlignedSamples samples = SamplesFrom(data, width, height);
  RunContext context;
  context.threads = 1;
  const auto result = ComputeDepth(samples, guide, options, context);
  if (result)
    RequireDefined(*result);
  else
    Require(!result.error().message.empty(), "an error has a message");
  return 0;
}
