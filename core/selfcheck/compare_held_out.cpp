#include "core/selfcheck/compare_held_out.h"

#include <chrono>
#include <cmath>

#include "core/depth/depth_method.h"

namespace foresight {
namespace {

/// Where `mask_of`, beams of another map in the same order, is kept.
HeldOutErrors ErrorsWithin(const std::vector<HeldOutBeam>& beams,
                           const std::vector<HeldOutBeam>& mask_of) {
  std::vector<HeldOutBeam> masked = beams;
  for (std::size_t i = 0; i < masked.size(); ++i) masked[i].kept = mask_of[i].kept;
  return HeldOutErrorsOf(masked, [](const HeldOutBeam& beam) { return beam.kept; });
}

}  // namespace

Result<std::vector<MethodOnHeldOut>> CompareOnHeldOut(const RegisteredScan& cloud,
                                                      const SensorRig& rig,
                                                      const CameraFrame& frame,
                                                      std::span<const DepthMethod> methods,
                                                      int keep_one_in, const RunContext& context) {
  const DepthOptions ours = DefaultsOf(DepthMethod::kForesight);
  FORESIGHT_TRY(AlignedSamples aligned, AlignToImage(cloud, rig, frame.motor_angle_rad, context));
  FORESIGHT_TRY(const JudgedBeams judged, JudgeBeams(std::move(aligned), ours, context));
  HoldOutPlan plan;
  plan.pattern = HoldOutPlan::Pattern::kLines;
  plan.one_in = keep_one_in;
  plan.others = true;
  FORESIGHT_TRY(const std::vector<HeldOutBeam> by_us,
                HoldOut(judged, frame.image, ours, plan, context));
  std::vector<MethodOnHeldOut> answers;
  for (const DepthMethod method : methods) {
    const auto start = std::chrono::steady_clock::now();
    FORESIGHT_TRY(const std::vector<HeldOutBeam> beams,
                  HoldOut(judged, frame.image, DefaultsOf(method), plan, context));
    MethodOnHeldOut answer;
    answer.method = method;
    answer.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    answer.beams = static_cast<int>(beams.size());
    answer.without_mask = HeldOutErrorsOf(beams, [](const HeldOutBeam&) { return true; });
    answer.own_mask = HeldOutErrorsOf(beams, [](const HeldOutBeam& beam) { return beam.kept; });
    answer.our_mask = ErrorsWithin(beams, by_us);
    answers.push_back(answer);
  }
  return answers;
}

}  // namespace foresight
