#include "app/ctl/demo_sources.h"

#include "core/depth/depth_method.h"
#include "core/detection/facts.h"
#include "core/detection/fit_in_scan.h"
#include "core/geometry/angles.h"
#include "core/pictures/detection_picture.h"

namespace foresight {
namespace {

Result<ValveDetection> FitToDepth(const DepthResult& depth, const DemoSubject& subject,
                                  const RunContext& context) {
  return FitValveInScan({subject.rig, subject.cloud, {}, &depth}, FitSource::kDepthAlone,
                        subject.roi, FitValveOptions(), context);
}

Result<ValveDetection> FitToDepthOf(DepthMethod method, const DemoSubject& subject,
                                    const RunContext& context) {
  if (method == DepthMethods().front().method) return FitToDepth(subject.depth, subject, context);
  FORESIGHT_TRY(
      const DepthResult depth,
      ComputeDepthInFrame(subject.cloud, subject.rig, subject.frame, DefaultsOf(method), context));
  return FitToDepth(depth, subject, context);
}

std::string TextOf(const DemoAnswer& answer) {
  if (!answer.valve) return "nothing found: " + answer.valve.error().message;
  return AgainstTruth(answer.valve->verdict, *answer.error);
}

}  // namespace

std::string AgainstTruth(const Verdict& verdict, const ValveError& error) {
  return fmt::format("{} ({}), {:.1f} mm and {:.2f} deg from the truth, spokes {}",
                     ToString(verdict.level), ProbabilityText(verdict.probability),
                     1000.0 * error.center_m, DegreesFromRadians(error.axis_rad),
                     error.spokes == 0 ? "right" : "wrong");
}

Result<std::vector<DemoAnswer>> FitToEverySource(const DemoSubject& subject,
                                                 const RunContext& context) {
  std::vector<DemoAnswer> answers;
  answers.push_back({"raw",
                     FitValveInScan({subject.rig, subject.cloud}, FitSource::kRaw, subject.roi,
                                    FitValveOptions(), context),
                     std::nullopt});
  for (const DepthMethodInfo& method : DepthMethods())
    answers.push_back({NameOf({FitSource::kDepthAlone, method.method}),
                       FitToDepthOf(method.method, subject, context), std::nullopt});
  for (DemoAnswer& answer : answers) {
    if (!answer.valve && answer.valve.error().code == ErrorCode::kCancelled)
      return tl::unexpected(answer.valve.error());
    if (answer.valve)
      answer.error = CompareWithTruth(answer.valve->best, subject.truth, subject.world);
  }
  return answers;
}

HtmlReport::Table TableOf(const std::vector<DemoAnswer>& answers) {
  HtmlReport::Table table{"The same region, every source", {}};
  for (const DemoAnswer& answer : answers)
    table.rows.push_back({SourceTitle(answer.source), TextOf(answer)});
  return table;
}

std::vector<HtmlReport::Picture> PicturesOf(const std::vector<DemoAnswer>& answers,
                                            const DemoSubject& subject) {
  std::vector<HtmlReport::Picture> pictures;
  for (const DemoAnswer& answer : answers) {
    ColorImage picture = subject.frame.image;
    if (answer.valve)
      DrawDetection(picture, *answer.valve, 0, subject.rig, subject.frame.motor_angle_rad);
    else
      DrawRegion(picture, subject.roi, subject.rig, subject.frame.motor_angle_rad);
    pictures.push_back({"fit-" + answer.source + ".png", "Fit to " + SourceTitle(answer.source),
                        TextOf(answer), AroundRegion(picture, subject.roi)});
  }
  return pictures;
}

}  // namespace foresight
