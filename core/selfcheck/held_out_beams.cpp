#include "core/selfcheck/held_out_beams.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/depth/depth_method.h"

namespace foresight {
namespace {

/// What a sample's neighbours on the grid say of it.
class Neighbourhood {
 public:
  explicit Neighbourhood(const AlignedSamples& samples)
      : samples_(samples), grid_(GridOf(samples, false)) {}

  bool IsAtEdge(const AlignedSample& s) const {
    return OffTheLine(s, s.beam - 1, s.line, s.beam + 1, s.line) ||
           OffTheLine(s, s.beam, s.line - 1, s.beam, s.line + 1);
  }

  /// Floats between two surfaces, far from both: the footprint lies on both.
  bool Floats(const AlignedSample& s) const {
    return FarFromBoth(s, s.beam - 1, s.line, s.beam + 1, s.line) ||
           FarFromBoth(s, s.beam, s.line - 1, s.beam, s.line + 1);
  }

 private:
  /// NaN where nothing was measured.
  double Depth(int beam, int line) const {
    const std::int32_t at = grid_.Contains(beam, line) ? grid_(beam, line) : -1;
    return at < 0 ? std::nan("") : samples_.samples[static_cast<std::size_t>(at)].depth_m;
  }

  /// Off the line through two neighbours, which a plane never is: inverse depth is linear over the
  /// rays. A neighbour that was not measured hides an edge.
  bool OffTheLine(const AlignedSample& s, int beam_a, int line_a, int beam_b, int line_b) const {
    const double middle_m = 2.0 / (1.0 / Depth(beam_a, line_a) + 1.0 / Depth(beam_b, line_b));
    return !(std::abs(middle_m - s.depth_m) <= RightWithin_m(s.depth_m));
  }

  bool FarFromBoth(const AlignedSample& s, int beam_a, int line_a, int beam_b, int line_b) const {
    // A neighbour that was not measured is not far: NaN fails the comparison.
    const auto far = [&](int beam, int line) {
      return std::abs(Depth(beam, line) - s.depth_m) > RightWithin_m(s.depth_m);
    };
    return OffTheLine(s, beam_a, line_a, beam_b, line_b) && far(beam_a, line_a) &&
           far(beam_b, line_b);
  }

  const AlignedSamples& samples_;
  const Image<std::int32_t> grid_;
};

DepthOptions WithoutRejection(DepthOptions options) {
  options.flying.rule = FlyingPointOptions::Rule::kOff;
  options.isolated.enabled = false;
  options.flipping.test = FlippingPointOptions::Test::kOff;
  return options;
}

/// The samples that stay in the map.
AlignedSamples RestOf(const AlignedSamples& all, const HoldOutPlan& plan) {
  AlignedSamples rest;
  rest.width = all.width;
  rest.height = all.height;
  rest.beams = all.beams;
  rest.motor_rad = all.motor_rad;
  rest.rays = all.rays;
  // Lines on both sides of one that stays out are neighbours, as if it had never been measured.
  std::vector<int> line_in_rest(static_cast<std::size_t>(all.lines), -1);
  for (int line = 0; line < all.lines; ++line)
    if (!plan.LeavesOutLine(line)) line_in_rest[static_cast<std::size_t>(line)] = rest.lines++;
  for (std::size_t i = 0; i < all.samples.size(); ++i) {
    AlignedSample sample = all.samples[i];
    if (plan.LeavesOut(sample.line, sample.beam)) continue;
    sample.line = line_in_rest[static_cast<std::size_t>(sample.line)];
    rest.samples.push_back(sample);
    rest.reasons.push_back(plan.others ? RejectReason::kKept : all.reasons[i]);
  }
  return rest;
}

/// The pixel that a place in the image lies in.
std::pair<int, int> PixelOf(const DepthImage& image, float u, float v) {
  return {std::clamp(static_cast<int>(std::lround(u)), 0, image.width() - 1),
          std::clamp(static_cast<int>(std::lround(v)), 0, image.height() - 1)};
}

/// The map between its pixels, where all four round a place lie on one surface; else that of the
/// nearest one.
float DepthAt(const DepthImage& depth_m, float u, float v) {
  const auto [x, y] = PixelOf(depth_m, u, v);
  const float nearest = depth_m(x, y);
  const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
  if (!depth_m.Contains(left, top) || !depth_m.Contains(left + 1, top + 1)) return nearest;
  const auto fx = static_cast<double>(u - static_cast<float>(left));
  const auto fy = static_cast<double>(v - static_cast<float>(top));
  double inverse = 0.0;
  for (const int dy : {0, 1})
    for (const int dx : {0, 1}) {
      const double depth = depth_m(left + dx, top + dy);
      // NaN fails the comparison.
      if (!(std::abs(depth - nearest) <= RightWithin_m(nearest))) return nearest;
      inverse += (dx == 1 ? fx : 1.0 - fx) * (dy == 1 ? fy : 1.0 - fy) / depth;
    }
  return static_cast<float>(1.0 / inverse);
}

}  // namespace

double RightWithin_m(double depth_m) {
  constexpr double kRight_m = 0.050, kRightOfDepth = 0.01;
  return std::max(kRight_m, kRightOfDepth * depth_m);
}

bool HoldOutPlan::LeavesOut(int line, int beam) const {
  // A step of three beams a line keeps those that stay out from being neighbours.
  const bool is_one = (beam + 3 * line) % one_in == turn;
  switch (pattern) {
    case Pattern::kScattered:
      return is_one != others;
    case Pattern::kLines:
      return LeavesOutLine(line);
    case Pattern::kBoth:
      break;
  }
  return LeavesOutLine(line) || is_one != others;
}

bool HoldOutPlan::LeavesOutLine(int line) const {
  return pattern != Pattern::kScattered && (line / together % one_in == turn) != others;
}

Status HoldOutPlan::Check() const {
  if (one_in < 2 || one_in > 1000)
    return Fail(ErrorCode::kInvalidOptions, "beams held out: one in {} is not in [2, 1000]",
                one_in);
  if (together < 1 || together > 100)
    return Fail(ErrorCode::kInvalidOptions, "beams held out: {} lines together are not in [1, 100]",
                together);
  if (turn < 0 || turn >= one_in)
    return Fail(ErrorCode::kInvalidOptions, "beams held out: turn {} is not in [0, {})", turn,
                one_in);
  return {};
}

bool HeldOutBeam::IsRight() const {
  return std::abs(Error_m()) <= RightWithin_m(depth_m);
}

Result<JudgedBeams> JudgeBeams(AlignedSamples aligned, const DepthOptions& options,
                               const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_CHECK(aligned.Check());
  JudgedBeams beams;
  const Neighbourhood neighbours(aligned);
  std::vector<std::uint8_t> floats;
  for (const AlignedSample& sample : aligned.samples) {
    beams.at_edge.push_back(neighbours.IsAtEdge(sample) ? 1 : 0);
    floats.push_back(neighbours.Floats(sample) ? 1 : 0);
  }
  FORESIGHT_CHECK(RejectOutliers(aligned, options, context));
  beams.samples = aligned;
  FORESIGHT_CHECK(RejectFlipping(aligned, DefaultsOf(DepthMethod::kForesight).flipping, context));
  for (std::size_t i = 0; i < aligned.samples.size(); ++i)
    beams.counts.push_back(aligned.reasons[i] == RejectReason::kKept && floats[i] == 0 ? 1 : 0);
  return beams;
}

Result<DepthResult> MapWithout(const JudgedBeams& beams, const ColorImage& guide,
                               const DepthOptions& options, const HoldOutPlan& plan,
                               const RunContext& context) {
  FORESIGHT_CHECK(plan.Check());
  return ComputeDepth(RestOf(beams.samples, plan), guide,
                      plan.others ? options : WithoutRejection(options), context);
}

Result<std::vector<HeldOutBeam>> CompareWithMap(const JudgedBeams& beams, const DepthResult& map,
                                                const HoldOutPlan& plan) {
  const AlignedSamples& all = beams.samples;
  std::vector<HeldOutBeam> held_out;
  for (std::size_t i = 0; i < all.samples.size(); ++i) {
    const AlignedSample& s = all.samples[i];
    if (beams.counts[i] == 0 || !plan.LeavesOut(s.line, s.beam)) continue;
    const auto [x, y] = PixelOf(map.dense.depth_m, s.u, s.v);
    held_out.push_back({s.line, s.beam, s.depth_m, DepthAt(map.dense.depth_m, s.u, s.v),
                        map.dense.confidence(x, y), map.mask(x, y) != 0, beams.at_edge[i] != 0});
  }
  if (held_out.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "none of the beams that stayed out of the depth map can be compared with it");
  return held_out;
}

Result<std::vector<HeldOutBeam>> HoldOut(const JudgedBeams& beams, const ColorImage& guide,
                                         const DepthOptions& options, const HoldOutPlan& plan,
                                         const RunContext& context) {
  FORESIGHT_TRY(const DepthResult map, MapWithout(beams, guide, options, plan, context));
  return CompareWithMap(beams, map, plan);
}

}  // namespace foresight
