#include <algorithm>
#include <memory>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "app/ctl/fit_subject.h"
#include "core/detection/cylinder_json.h"
#include "core/fitting/cylinder/fit_cylinder.h"
#include "core/geometry/angles.h"
#include "core/io/png.h"

namespace foresight {
namespace {

struct FitCylinderArguments {
  FitArguments fit;
  std::uint64_t seed = 1;
  std::vector<double> radius_mm = {10.0, 600.0};
};

std::string SourceOf(const FitSubject& subject, const FitArguments& arguments) {
  if (!subject.depth_m.empty()) return "depth map";
  return subject.scan ? arguments.source : "cloud";
}

void PrintSummary(const CylinderDetection& found, const SensorRig& rig) {
  const auto robot_from_object = rig.robot_from_base * found.base_from_object;
  const Eigen::Vector3d at = 1000.0 * robot_from_object.translation();
  const Eigen::Vector3d axis = robot_from_object.Rotate(Eigen::Vector3d::UnitZ());
  const CylinderEvidence& evidence = found.evidence;
  PrintLine(fmt::format("{}: {}", ToString(found.level), found.reason));
  PrintLine(fmt::format("{:<15} {:.0f} +- {:.0f} mm", "Radius", 1000.0 * found.model.radius_m,
                        1000.0 * found.sigma_radius_m));
  PrintLine(fmt::format("{:<15} {:.0f} mm seen", "Length", 1000.0 * found.model.length_m));
  PrintLine(fmt::format("{:<15} x {:.0f}, y {:.0f}, z {:.0f} mm; across +- {:.0f} mm", "Middle",
                        at.x(), at.y(), at.z(), 1000.0 * found.sigma_across_m));
  PrintLine(fmt::format("{:<15} {:.3f}, {:.3f}, {:.3f}; +- {:.1f} deg", "Axis", axis.x(), axis.y(),
                        axis.z(), DegreesFromRadians(found.sigma_axis_rad)));
  PrintLine(fmt::format("{:<15} {} beams on it, {:.0f} % agree, {:.0f} % went through", "Support",
                        evidence.hits, 100.0 * evidence.inlier_ratio,
                        100.0 * evidence.see_through));
  PrintLine(fmt::format("{:<15} median {:.0f} mm; {:.0f} deg of the girth seen", "Residual",
                        1000.0 * evidence.residual_mad_m,
                        DegreesFromRadians(evidence.seen_arc_rad)));
}

Result<CylinderDetection> FitIn(const FitSubject& subject, const FitCylinderArguments& arguments,
                                const RunContext& context) {
  FitCylinderOptions options;
  options.up = subject.rig.robot_from_base.Inverse().Rotate(UpOf(arguments.fit));
  options.seed = arguments.seed;
  options.min_radius_m = 1e-3 * arguments.radius_mm[0];
  options.max_radius_m = 1e-3 * arguments.radius_mm[1];
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(const RaySet rays,
                RaysIn(subject, arguments.fit, BoxRays::kPassThrough, context.Part(0.0, 0.5)));
  FORESIGHT_TRY(CylinderDetection found, FitCylinder(rays, options, context.Part(0.5, 1.0)));
  found.origin.roi = subject.roi;
  found.origin.source = SourceOf(subject, arguments.fit);
  return found;
}

Result<ExitCode> Fit(const FitCylinderArguments& arguments, const RunContext& context) {
  FORESIGHT_CHECK(CheckFitArguments(arguments.fit));
  FORESIGHT_TRY(const FitSubject subject, OpenFitSubject(arguments.fit, context.Part(0.0, 0.2)));
  const auto answer = FitIn(subject, arguments, context.Part(0.2, 1.0));
  if (!answer && arguments.fit.json && IsNegative(answer.error())) {
    PrintNote("foresightctl: {}", answer.error().message);
    PrintJson({{"kind", "cylinder"},
               {"verdict", "UNSURE"},
               {"probability", nullptr},
               {"reason", answer.error().message}});
    return ExitCode::kNegative;
  }
  FORESIGHT_TRY(const CylinderDetection found, answer);
  if (!arguments.fit.picture.empty())
    FORESIGHT_CHECK(WritePng(arguments.fit.picture, PictureOf(subject, {OutlineOf(found)})));
  if (arguments.fit.json)
    PrintLine(CylinderToJson(found, subject.rig.robot_from_base));
  else
    PrintSummary(found, subject.rig);
  return found.level == VerdictLevel::kUnsure ? ExitCode::kNegative : ExitCode::kDone;
}

}  // namespace

void AddFitCylinderCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<FitCylinderArguments>();
  CLI::App* command =
      app.add_subcommand("cylinder", "Fit a pole, a pipe or anything else that is round");
  AddSubjectArguments(*command, arguments->fit);
  command
      ->add_option("--radius-mm", arguments->radius_mm, "Least and largest radius in millimetres")
      ->expected(2)
      ->delimiter(',')
      ->capture_default_str();
  AddSeedOption(*command, "--seed", arguments->seed, "Seed of the random search")
      ->capture_default_str();
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Fit(*arguments, context); };
  });
}

}  // namespace foresight
