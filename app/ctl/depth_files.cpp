#include "app/ctl/depth_files.h"

#include <map>

#include "app/common/output.h"
#include "core/depth/depth_method.h"
#include "core/io/pfm.h"
#include "core/io/png.h"

namespace foresight {
namespace {

template <class T>
using Names = std::map<std::string, T>;

const Names<UpsampleOptions::Weights> kWeights = {{"product", UpsampleOptions::Weights::kProduct},
                                                  {"literal", UpsampleOptions::Weights::kLiteral}};
const Names<FlyingRule> kFlyingRules = {{"max", FlyingRule::kMax},
                                        {"min", FlyingRule::kMin},
                                        {"adaptive", FlyingRule::kAdaptive},
                                        {"off", FlyingRule::kOff}};
const Names<FlippingPointOptions::Test> kFlippingTests = {
    {"cells", FlippingPointOptions::Test::kCells},
    {"mesh", FlippingPointOptions::Test::kMesh},
    {"off", FlippingPointOptions::Test::kOff}};
const Names<FlippingPointOptions::Cells> kCells = {
    {"kept", FlippingPointOptions::Cells::kFromKeptSamples},
    {"all", FlippingPointOptions::Cells::kFromAllSamples}};
const Names<ConfidencePasses> kConfidencePasses = {{"all", ConfidencePasses::kAll},
                                                   {"every-depth", ConfidencePasses::kEveryDepth},
                                                   {"guided", ConfidencePasses::kGuided}};
const Names<ConfidenceMaskOptions::Reference> kMaskReferences = {
    {"max", ConfidenceMaskOptions::Reference::kLargest},
    {"nominal", ConfidenceMaskOptions::Reference::kNominal}};
const Names<bool> kOnOff = {{"on", true}, {"off", false}};

/// An option whose value is one of a few words.
template <class T>
void AddChoice(CLI::App& command, const char* name, std::optional<T>& value, const Names<T>& names,
               const char* help) {
  std::string words;
  for (const auto& [word, meaning] : names) words += (words.empty() ? "" : "|") + word;
  command
      .add_option_function<std::string>(
          name, [&value, &names](const std::string& word) { value = names.at(word); }, help)
      ->check(CLI::IsMember(names))
      ->type_name(words);
}

void AddRejectionArguments(CLI::App& command, DepthArguments& arguments) {
  AddChoice(command, "--flying", arguments.flying, kFlyingRules,
            "Flying points, Eq. (7): max as printed, min, adaptive (30 mm + 2 z du / f of depth)");
  command.add_option("--flying-threshold-mm", arguments.flying_threshold_mm, "T_f of Eq. (7)")
      ->check(CLI::PositiveNumber);
  AddChoice(command, "--isolated", arguments.isolated, kOnOff, "Reject isolated points");
  AddChoice(command, "--flipping", arguments.flipping, kFlippingTests,
            "Flipping points: behind the cells of Fig. 4, or behind the mesh of connected cells");
  command
      .add_option("--flip-margin-mm", arguments.flip_margin_mm,
                  "How much further behind a flipping point is")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--flip-step-mm", arguments.flip_step_mm,
                  "Mesh: a cell with a larger step of depth is not connected")
      ->check(CLI::PositiveNumber);
  AddChoice(command, "--cells-from", arguments.cells, kCells,
            "Samples that span cells: those that Eq. (7) kept, or all of them");
}

void AddConfidenceArguments(CLI::App& command, DepthArguments& arguments) {
  AddChoice(command, "--confidence", arguments.confidence_passes, kConfidencePasses,
            "Passes that Eq. (9) sums over (paper, jbu)");
  AddChoice(command, "--confidence-terms", arguments.confidence_terms, kWeights,
            "Terms of Eq. (9): G H, or exp(G + H) as printed (paper, jbu)");
  command
      .add_option("--threshold", arguments.threshold,
                  "Confidence below this fraction of the reference is masked")
      ->check(CLI::Range(0.0, 1.0));
  AddChoice(
      command, "--mask-reference", arguments.mask_reference, kMaskReferences,
      "Reference of the mask: the largest confidence in the image, or a full neighbourhood's");
}

void ChooseFlying(FlyingRule rule, FlyingPointOptions& options) {
  switch (rule) {
    case FlyingRule::kOff:
      options.rule = FlyingPointOptions::Rule::kOff;
      return;
    case FlyingRule::kMax:
      options = FlyingPointOptions();
      return;
    case FlyingRule::kMin:
      options = FlyingPointOptions();
      options.rule = FlyingPointOptions::Rule::kBothNeighboursFar;
      return;
    case FlyingRule::kAdaptive:
      options = FlyingPointOptions::RangeAdaptive();
      return;
  }
}

template <class T>
void Override(T& option, const std::optional<T>& given) {
  if (given) option = *given;
}

void OverrideMillimetres(double& option_m, const std::optional<double>& given_mm) {
  if (given_mm) option_m = 1e-3 * *given_mm;
}

void ChooseRejection(const DepthArguments& arguments, DepthOptions& options) {
  if (arguments.flying) ChooseFlying(*arguments.flying, options.flying);
  OverrideMillimetres(options.flying.threshold_m, arguments.flying_threshold_mm);
  Override(options.isolated.enabled, arguments.isolated);
  Override(options.flipping.test, arguments.flipping);
  OverrideMillimetres(options.flipping.margin_m, arguments.flip_margin_mm);
  OverrideMillimetres(options.flipping.connected_step_m, arguments.flip_step_mm);
  Override(options.flipping.cells, arguments.cells);
}

/// Gives the option to the method's own struct; a method without it refuses.
Status ChooseFilter(const DepthArguments& arguments, DepthOptions& options) {
  const bool joint_filter =
      options.method == DepthMethod::kPaper || options.method == DepthMethod::kJointBilateral;
  const auto refuse = [&](const char* name) {
    return Fail(ErrorCode::kInvalidOptions, "{}: method '{}' has no such option", name,
                InfoOf(options.method).name);
  };
  options.upsample.sigma_spatial_px = arguments.sigma_spatial_px;
  options.local_plane.sigma_spatial_px = arguments.sigma_spatial_px;
  if (joint_filter) {
    Override(options.upsample.iterations, arguments.iterations);
    Override(options.upsample.radius_in_sigmas, arguments.radius_in_sigmas);
    Override(options.upsample.weights, arguments.weights);
    Override(options.upsample.confidence_passes, arguments.confidence_passes);
    if (arguments.confidence_terms) options.upsample.confidence_terms = arguments.confidence_terms;
    return {};
  }
  if (arguments.weights) return refuse("--weights");
  if (arguments.confidence_passes) return refuse("--confidence");
  if (arguments.confidence_terms) return refuse("--confidence-terms");
  if (arguments.radius_in_sigmas && options.method != DepthMethod::kForesight)
    return refuse("--radius");
  Override(options.local_plane.radius_in_sigmas, arguments.radius_in_sigmas);
  int& iterations = options.method == DepthMethod::kForesight ? options.local_plane.iterations
                    : options.method == DepthMethod::kTgv     ? options.tgv.iterations
                                                              : options.nonlocal.iterations;
  Override(iterations, arguments.iterations);
  return {};
}

}  // namespace

void AddDepthArguments(CLI::App& command, DepthArguments& arguments) {
  command.add_option("--method", arguments.method, "Depth method: " + MethodNames())
      ->capture_default_str();
  command
      .add_option("--sigma-spatial", arguments.sigma_spatial_px,
                  "sigma_s in pixels; 0 = from the density (foresight, paper, jbu)")
      ->capture_default_str();
  command
      .add_option("--radius", arguments.radius_in_sigmas,
                  "The window's radius in sigma_s (foresight, paper, jbu)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--iterations", arguments.iterations,
                  "Passes after the first; steps of the solver (tgv, nonlocal)")
      ->check(CLI::NonNegativeNumber);
  AddChoice(command, "--weights", arguments.weights, kWeights,
            "Weights of Eq. (8): G K H, or exp(G + K + H) as printed (paper, jbu)");
  AddRejectionArguments(command, arguments);
  AddConfidenceArguments(command, arguments);
}

std::vector<std::string> DepthOptionNames() {
  CLI::App command;
  DepthArguments arguments;
  AddDepthArguments(command, arguments);
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (option != command.get_help_ptr()) names.push_back(option->get_name());
  return names;
}

std::string MethodNames() {
  std::string names;
  for (const DepthMethodInfo& info : DepthMethods())
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

Result<DepthOptions> DepthOptionsFrom(const DepthArguments& arguments) {
  FORESIGHT_TRY(const DepthMethod method, DepthMethodFromName(arguments.method));
  DepthOptions options = DefaultsOf(method);
  ChooseRejection(arguments, options);
  FORESIGHT_CHECK(ChooseFilter(arguments, options));
  Override(options.mask.threshold, arguments.threshold);
  Override(options.mask.reference, arguments.mask_reference);
  options.local_plane.keep_iterations = true;  // for the change of each pass, Fig. 6(b)
  FORESIGHT_CHECK(options.Check());
  return options;
}

Status WriteDepthFiles(const DepthResult& result, const std::filesystem::path& folder) {
  FloatImage depth_mm = result.dense.depth_m;
  for (float& value : depth_mm.values()) value *= 1000.0f;
  FORESIGHT_CHECK(WritePfm(folder / "depth.pfm", depth_mm));
  FORESIGHT_CHECK(WritePfm(folder / "confidence.pfm", result.dense.confidence));
  return WritePng(folder / "mask.png", result.mask);
}

void WarnOfLowDensity(const DepthResult& result) {
  if (!result.BelowDensityFloor()) return;
  PrintNote(
      "only {:.2f} % of the pixels are measured; below {:.0f} % the depth map is not to be trusted",
      100.0 * result.density, 100.0 * ScanPrediction::kMinDensity);
}

}  // namespace foresight
