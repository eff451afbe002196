#pragma once

#include <cstdint>
#include <vector>

#include "core/depth/pipeline.h"

namespace foresight {

/// How far a depth may be off to count as right, as the confidence of local planes means it: 50 mm
/// or 1 %, whichever is more.
double RightWithin_m(double depth_m);

/// Which beams of a scan stay out of a depth map, so that they can check it.
struct HoldOutPlan {
  enum class Pattern {
    kScattered,  ///< single beams; no two of them are neighbours on the grid
    kLines,      ///< whole lines
    kBoth,       ///< what both of them leave out: one map serves both
  };

  Pattern pattern = Pattern::kScattered;
  int one_in = 10;      ///< every so manieth beam or line, or group of lines
  int turn = 0;         ///< which of them, in [0, one_in)
  bool others = false;  ///< all the others stay out instead: a map made of a quarter of the rings
  int together = 1;     ///< so many neighbouring lines stay out together; of lines only

  bool LeavesOut(int line, int beam) const;
  bool LeavesOutLine(int line) const;  ///< as a whole
  /// Fails with kInvalidOptions.
  Status Check() const;
};

/// A beam that stayed out, against the map that was made without it.
struct HeldOutBeam {
  int line = 0;
  int beam = 0;
  float depth_m = 0.0f;     ///< as the beam measured it, along the camera's z
  float map_m = 0.0f;       ///< as the map has it there; NaN = none
  float confidence = 0.0f;  ///< of the map there
  bool kept = false;        ///< the map's mask keeps it
  bool at_edge = false;     ///< of depth: off the plane through its neighbours on the grid

  double Error_m() const { return static_cast<double>(map_m) - depth_m; }
  bool IsRight() const;  ///< within RightWithin_m
};

/// The beams of a scan as its own image sees them, before any is left out.
struct JudgedBeams {
  AlignedSamples samples;             ///< with the reason of each rejection
  std::vector<std::uint8_t> counts;   ///< one a sample; 0 = says nothing about the map
  std::vector<std::uint8_t> at_edge;  ///< one a sample
};

/// Judges aligned samples. Those that the options reject do not count, nor those that float between
/// two surfaces, far from both neighbours along or across the line, or that the camera cannot see
/// (Fig. 4 with Foresight's margin), whatever the method. Fails as RejectOutliers does. O(samples).
/// @param aligned without rejections
Result<JudgedBeams> JudgeBeams(AlignedSamples aligned, const DepthOptions& options,
                               const RunContext& context);

/// The depth map without some beams, by the same method and options. The others keep the
/// rejections that all beams led to: a cell of Fig. 4 needs its corners. With `plan.others` they
/// are rejected anew, and lines that stay become neighbours. Fails as ComputeDepth does. Costs a
/// depth map.
Result<DepthResult> MapWithout(const JudgedBeams& beams, const ColorImage& guide,
                               const DepthOptions& options, const HoldOutPlan& plan,
                               const RunContext& context);

/// The beams that stayed out, against the map that was made without them. Beams that do not count
/// are not compared. Fails with kTooFewPoints where no beam is left to compare.
Result<std::vector<HeldOutBeam>> CompareWithMap(const JudgedBeams& beams, const DepthResult& map,
                                                const HoldOutPlan& plan);

/// MapWithout, then CompareWithMap.
Result<std::vector<HeldOutBeam>> HoldOut(const JudgedBeams& beams, const ColorImage& guide,
                                         const DepthOptions& options, const HoldOutPlan& plan,
                                         const RunContext& context);

}  // namespace foresight
