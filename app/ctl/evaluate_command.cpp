#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "core/evaluation/evaluate_methods.h"

namespace foresight {
namespace {

struct EvaluateArguments {
  std::vector<std::string> folders;
  std::vector<std::string> methods = {"foresight", "paper"};
  std::uint64_t seed = 1;
  int scale = 1;
  bool json = false;
};

nlohmann::ordered_json ToJson(const DepthAccuracy& accuracy) {
  return {{"a80_mm", Finite(accuracy.a80_mm)},
          {"a95_mm", Finite(accuracy.a95_mm)},
          {"coverage", accuracy.coverage},
          {"unscored_kept", accuracy.unscored_kept}};
}

nlohmann::ordered_json ToJson(const StereoEvaluation& evaluation) {
  nlohmann::ordered_json json = {{"scene", evaluation.scene}, {"method", evaluation.method}};
  json.update(ToJson(evaluation.with_mask));
  json["seconds"] = evaluation.seconds;
  json["samples"] = evaluation.samples;
  json["rejected"] = evaluation.rejected;
  json["rejection_precision"] = Finite(evaluation.rejection_precision);
  json["rejection_recall"] = Finite(evaluation.rejection_recall);
  json["without_mask"] = ToJson(evaluation.without_mask);
  return json;
}

std::string TableRow(const StereoEvaluation& e) {
  return fmt::format(
      "{:<16} {:<10} {:>8.1f} {:>8.1f} {:>6.3f} {:>6.3f}   {:>8.1f} {:>8.1f} {:>6.3f}   {:>7.2f}",
      e.scene, e.method, e.with_mask.a80_mm, e.with_mask.a95_mm, e.with_mask.coverage,
      e.with_mask.unscored_kept, e.without_mask.a80_mm, e.without_mask.a95_mm,
      e.without_mask.coverage, e.seconds);
}

Result<std::vector<DepthMethod>> MethodsFrom(const std::vector<std::string>& names) {
  std::vector<DepthMethod> methods;
  for (const std::string& name : names) {
    if (name == "all") {
      for (const DepthMethodInfo& info : DepthMethods()) methods.push_back(info.method);
      continue;
    }
    FORESIGHT_TRY(const DepthMethod method, DepthMethodFromName(name));
    methods.push_back(method);
  }
  return methods;
}

Result<ExitCode> Evaluate(const EvaluateArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const std::vector<DepthMethod> methods, MethodsFrom(arguments.methods));
  StereoEvaluationOptions options;
  options.testbed.seed = arguments.seed;
  options.enlarge = arguments.scale;
  std::vector<StereoEvaluation> evaluations;
  for (const std::string& folder : arguments.folders) {
    FORESIGHT_TRY(const StereoScene scene, LoadStereoScene(folder));
    for (const DepthMethod method : methods) {
      fmt::print(stderr, "{}: {}\n", scene.name, InfoOf(method).title);
      options.depth = TestbedOptionsOf(method);
      FORESIGHT_TRY(const StereoEvaluation evaluation, EvaluateOnScene(scene, options, context));
      evaluations.push_back(evaluation);
    }
  }
  if (arguments.json) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& evaluation : evaluations) list.push_back(ToJson(evaluation));
    PrintJson(list);
    return ExitCode::kDone;
  }
  PrintLine(fmt::format("{:<27} {:>31}   {:>24}", "", "masked", "not masked"));
  PrintLine(fmt::format("{:<16} {:<10} {:>8} {:>8} {:>6} {:>6}   {:>8} {:>8} {:>6}   {:>7}",
                        "scene", "method", "A80 mm", "A95 mm", "cover", "holes", "A80 mm", "A95 mm",
                        "cover", "seconds"));
  for (const auto& evaluation : evaluations) PrintLine(TableRow(evaluation));
  return ExitCode::kDone;
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate", "Score depth maps on stereo scenes with ground truth (Section V-A of the paper)");
  command
      ->add_option("folders", arguments->folders,
                   "Folders in Middlebury 2014 form: calib.txt, im0.png, im1.png, disp0GT.pfm")
      ->required();
  command->add_option("--method", arguments->methods, "Depth methods, or all: " + MethodNames())
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Seed of the sampling noise")
      ->capture_default_str();
  command->add_option("--scale", arguments->scale, "Enlarge the scenes by this whole factor first")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print a JSON list, one object a scene and method");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Evaluate(*arguments, context); };
  });
}

}  // namespace foresight
