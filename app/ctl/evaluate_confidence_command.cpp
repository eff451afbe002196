#include <algorithm>
#include <cmath>
#include <memory>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "core/base/version.h"
#include "core/evaluation/confidence_fit.h"

namespace foresight {
namespace {

constexpr const char* kTermNames[] = {
    "nearest supporter, cells", "weight, squared", "one-sided in the row",
    "one-sided in the column",  "agreement",       "inside a cell"};
static_assert(std::size(kTermNames) == kSupportTerms);

struct EvaluateConfidenceArguments {
  std::vector<std::string> scenes;
  std::vector<int> scales = {1, 4};
  std::uint64_t seed = 1;
  bool json = false;
};

/// About 40,000 pixels of a scene.
int StrideOf(const StereoScene& scene, int enlarge) {
  constexpr double kPixels = 40000.0;
  const double pixels = static_cast<double>(scene.right.size()) * enlarge * enlarge;
  return std::max(1, static_cast<int>(std::lround(std::sqrt(pixels / kPixels))));
}

/// By weights that have not seen the scene, at whatever size.
double LeftOutLoss(const std::vector<ConfidenceExamples>& examples,
                   const std::vector<std::string>& scenes) {
  double loss = 0.0;
  for (const std::string& scene : scenes) {
    std::vector<ConfidenceExamples> others, its_own;
    for (const ConfidenceExamples& of_scene : examples)
      (of_scene.scene == scene ? its_own : others).push_back(of_scene);
    loss += PromiseOf(FitConfidence(others), its_own).log_loss / static_cast<double>(scenes.size());
  }
  return loss;
}

nlohmann::ordered_json WeightsJson(const ConfidenceWeights& weights) {
  nlohmann::ordered_json json = {{"bias", weights.bias}};
  for (std::size_t i = 0; i < kSupportTerms; ++i) json[kTermNames[i]] = weights.of[i];
  return json;
}

void PrintText(const EvaluateConfidenceArguments& arguments, std::size_t pixels,
               const ConfidenceWeights& fitted, double left_out,
               const std::vector<ConfidenceExamples>& examples) {
  const ConfidenceWeights& shipped = ShippedConfidenceWeights();
  PrintLine(fmt::format("foresightctl {}, {} scenes, scales {}, seed {}, {} pixels",
                        ProgramVersion(), arguments.scenes.size(),
                        fmt::join(arguments.scales, ", "), arguments.seed, pixels));
  PrintLine(fmt::format("{:<28}{:>10}{:>16}", "weight of", "fitted", "in the program"));
  PrintLine(fmt::format("{:<28}{:>10.2f}{:>16.2f}", "constant", fitted.bias, shipped.bias));
  for (std::size_t i = 0; i < kSupportTerms; ++i)
    PrintLine(fmt::format("{:<28}{:>10.2f}{:>16.2f}", kTermNames[i], fitted.of[i], shipped.of[i]));
  const ConfidencePromise now = PromiseOf(shipped, examples), then = PromiseOf(fitted, examples);
  PrintLine(fmt::format("{:<28}{:>10.4f}{:>16.4f}   {:.4f} of scenes that weights have not seen",
                        "log loss", then.log_loss, now.log_loss, left_out));
  PrintLine(fmt::format("{:<14}{:>30}{:>30}", "", "fitted", "in the program"));
  PrintLine(fmt::format("{:<14}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}", "confidence", "pixels",
                        "promised", "right", "pixels", "promised", "right"));
  for (std::size_t i = 0; i < now.classes.size(); ++i) {
    const auto& a = then.classes[i];
    const auto& b = now.classes[i];
    PrintLine(fmt::format("{:<14}{:>10}{:>10.3f}{:>10.3f}{:>10}{:>10.3f}{:>10.3f}",
                          fmt::format("{:.1f} to {:.1f}", 0.1 * static_cast<double>(i),
                                      0.1 * static_cast<double>(i + 1)),
                          a.pixels, a.promised, a.right, b.pixels, b.promised, b.right));
  }
}

Result<ExitCode> EvaluateConfidence(const EvaluateConfidenceArguments& arguments,
                                    const RunContext& context) {
  std::vector<ConfidenceExamples> examples;
  std::vector<std::string> names;
  std::size_t pixels = 0;
  const double all = static_cast<double>(arguments.scenes.size() * arguments.scales.size());
  for (const std::string& folder : arguments.scenes) {
    FORESIGHT_TRY(const StereoScene scene, LoadStereoScene(folder));
    if (std::find(names.begin(), names.end(), scene.name) != names.end())
      return Fail(ErrorCode::kInvalidOptions, "there are two scenes '{}': give each once",
                  scene.name);
    names.push_back(scene.name);
    for (const int scale : arguments.scales) {
      StereoEvaluationOptions options;
      options.testbed.seed = arguments.seed;
      options.depth = TestbedOptionsOf(DepthMethod::kForesight);
      options.enlarge = scale;
      const double at = static_cast<double>(examples.size());
      FORESIGHT_TRY(ConfidenceExamples of_scene,
                    ConfidenceExamplesOf(scene, options, StrideOf(scene, scale),
                                         context.Part(at / all, (at + 1.0) / all)));
      pixels += of_scene.terms.size();
      examples.push_back(std::move(of_scene));
    }
  }
  const ConfidenceWeights fitted = FitConfidence(examples);
  const double left_out = names.size() > 1 ? LeftOutLoss(examples, names) : std::nan("");
  if (arguments.json)
    PrintJson(
        {{"version", ProgramVersion()},
         {"scenes", names},
         {"scales", arguments.scales},
         {"seed", arguments.seed},
         {"pixels", pixels},
         {"fitted", WeightsJson(fitted)},
         {"in_the_program", WeightsJson(ShippedConfidenceWeights())},
         {"log_loss", PromiseOf(fitted, examples).log_loss},
         {"log_loss_in_the_program", PromiseOf(ShippedConfidenceWeights(), examples).log_loss},
         {"log_loss_left_out", FiniteOrNull(left_out)}});
  else
    PrintText(arguments, pixels, fitted, left_out, examples);
  return ExitCode::kDone;
}

}  // namespace

void AddEvaluateConfidenceCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateConfidenceArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate-confidence",
      "Fit the weights of the depth's confidence again, on stereo scenes, beside the program's");
  command->add_option("scenes", arguments->scenes, "Folders of the Middlebury data set")
      ->required();
  command->add_option("--scale", arguments->scales, "Sizes of each scene: 1, and 4 for full size")
      ->delimiter(',')
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  AddSeedOption(*command, "--seed", arguments->seed, "Of the samples' noise")
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return EvaluateConfidence(*arguments, context);
    };
  });
}

}  // namespace foresight
