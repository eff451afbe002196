#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "app/ctl/evaluate_hold_out.h"
#include "app/ctl/evaluate_pictures.h"
#include "app/ctl/evaluation_report.h"
#include "core/evaluation/evaluate_methods.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

struct EvaluateArguments {
  std::vector<std::string> scenes;
  std::vector<std::string> methods = {"foresight", "paper"};
  std::uint64_t seed = 1;
  int scale = 1;
  double rotation_error_deg = DegreesFromRadians(CalibrationError().rotation_rad);
  double translation_error_mm = 1000.0 * CalibrationError().translation_m;
  std::string out;   ///< empty = no pictures
  int hold_out = 0;  ///< missions are scored on their own beams: one line in so many is kept
  bool json = false;
};

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
  // Foresight first: the others are told in its mask too.
  std::stable_partition(methods.begin(), methods.end(),
                        [](DepthMethod method) { return method == DepthMethod::kForesight; });
  return methods;
}

void Announce(const std::string& scene, DepthMethod method) {
  PrintNote("{}: {}", scene, InfoOf(method).title);
}

RayOfPixel RayOfRightView(const StereoScene& scene) {
  return [&scene](const Eigen::Vector2d& pixel) -> Eigen::Vector2d {
    return (pixel - Eigen::Vector2d(scene.right_cx, scene.cy)) / scene.focal_px;
  };
}

/// Of the picture's middle: a fisheye's far sides, metres away, would leave little room for it.
RayOfPixel RayOfCamera(const CameraModel& camera) {
  constexpr double kLargestTangent = 1.2;
  return [&camera](const Eigen::Vector2d& pixel) -> Eigen::Vector2d {
    const auto ray = camera.UnprojectToPlane(pixel);
    if (ray && ray->norm() <= kLargestTangent) return *ray;
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  };
}

/// Foresight's mask of a scene, as soon as Foresight has run on it.
class SharedMask {
 public:
  /// @returns how good the method's depth is in there; nothing before Foresight has run.
  Result<std::optional<DepthAccuracy>> Score(DepthMethod method, const DepthResult& result,
                                             const DepthImage& truth_m, int stride) {
    if (method == DepthMethod::kForesight) mask_ = result.mask;
    if (!mask_) return std::nullopt;
    FORESIGHT_TRY(const DepthAccuracy accuracy,
                  ScoreDepth(result.dense.depth_m, *mask_, truth_m, stride));
    return accuracy;
  }

 private:
  std::optional<MaskImage> mask_;
};

Status EvaluateStereo(const std::string& folder, const std::vector<DepthMethod>& methods,
                      const EvaluateArguments& arguments, EvaluationPictures* pictures,
                      std::vector<EvaluationRow>& rows, const RunContext& context) {
  FORESIGHT_TRY(const StereoScene scene, LoadStereoScene(folder));
  StereoEvaluationOptions options;
  options.testbed.seed = arguments.seed;
  options.enlarge = arguments.scale;
  SharedMask mask;
  for (const DepthMethod method : methods) {
    Announce(scene.name, method);
    options.depth = TestbedOptionsOf(method);
    FORESIGHT_TRY(const StereoRun run, RunOnScene(scene, options, context).map_error(Of(folder)));
    if (pictures != nullptr)
      FORESIGHT_CHECK(pictures->Add({run.depth.score, run.depth.result, run.scene.right,
                                     run.truth_m, RayOfRightView(run.scene)}));
    FORESIGHT_TRY(auto in_mask,
                  mask.Score(method, run.depth.result, run.truth_m, ScoreStride(arguments.scale)));
    rows.push_back({run.depth.score, std::move(in_mask), std::nullopt});
  }
  return {};
}

Status EvaluateSimulated(const std::string& file, const std::vector<DepthMethod>& methods,
                         const EvaluateArguments& arguments, EvaluationPictures* pictures,
                         std::vector<EvaluationRow>& rows, const RunContext& context) {
  FORESIGHT_TRY(Scene scene, LoadScene(file));
  SimulatedTrialOptions options;
  options.world.seed = arguments.seed;
  options.calibration_error.rotation_rad = RadiansFromDegrees(arguments.rotation_error_deg);
  options.calibration_error.translation_m = arguments.translation_error_mm / 1000.0;
  PrintNote("{}: simulated scan", scene.name);
  FORESIGHT_TRY(
      const SimulatedTrial trial,
      MakeSimulatedTrial(std::make_shared<const Scene>(std::move(scene)), options, context));
  SharedMask mask;
  for (const DepthMethod method : methods) {
    Announce(trial.scene, method);
    FORESIGHT_TRY(const ScoredDepth depth, RunOnTrial(trial, DefaultsOf(method), context));
    if (pictures != nullptr)
      FORESIGHT_CHECK(pictures->Add({depth.score, depth.result, trial.frame.image, trial.truth_m,
                                     RayOfCamera(trial.rig.camera)}));
    FORESIGHT_TRY(auto in_mask, mask.Score(method, depth.result, trial.truth_m, 1));
    rows.push_back({depth.score, std::move(in_mask), options.calibration_error});
  }
  return {};
}

Result<ExitCode> Evaluate(const EvaluateArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const std::vector<DepthMethod> methods, MethodsFrom(arguments.methods));
  if (arguments.hold_out > 0)
    return EvaluateHoldOut(arguments.scenes, methods, arguments.hold_out, arguments.json, context);
  std::optional<EvaluationPictures> pictures;
  if (!arguments.out.empty()) {
    FORESIGHT_CHECK(MakeOutputFolder(arguments.out));
    pictures.emplace(arguments.out);
  }
  EvaluationPictures* const pictures_or_none = pictures ? &*pictures : nullptr;
  std::vector<EvaluationRow> rows;
  for (const std::string& scene : arguments.scenes) {
    const bool simulated = std::filesystem::path(scene).extension() == ".yaml";
    if (!simulated && std::filesystem::is_regular_file(scene))
      return Fail(ErrorCode::kInvalidInput,
                  "{}: is neither a scene file (.yaml) nor the folder of a stereo scene; a mission "
                  "is evaluated on its own beams, with --hold-out",
                  scene);
    FORESIGHT_CHECK(
        simulated ? EvaluateSimulated(scene, methods, arguments, pictures_or_none, rows, context)
                  : EvaluateStereo(scene, methods, arguments, pictures_or_none, rows, context));
  }
  if (pictures) FORESIGHT_CHECK(pictures->WritePage());
  PrintEvaluation(rows, arguments.json);
  return ExitCode::kDone;
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate",
      "Score depth maps against ground truth, on stereo scenes (Section V-A of the "
      "paper) and simulated scans");
  command
      ->add_option("scenes", arguments->scenes,
                   "Folders in Middlebury 2014 form (calib.txt, im0.png, im1.png, disp0GT.pfm or "
                   "disp0.pfm), or "
                   "scene files (*.yaml) to scan; with --hold-out missions")
      ->required();
  command->add_option("--method", arguments->methods, "Depth methods, or all: " + MethodNames())
      ->delimiter(',')
      ->capture_default_str();
  AddSeedOption(*command, "--seed", arguments->seed,
                "Seed of the noise, and of the direction of the calibration's error")
      ->capture_default_str();
  command
      ->add_option("--scale", arguments->scale,
                   "Enlarge the stereo scenes by this whole factor first")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command
      ->add_option("--rotation-error-deg", arguments->rotation_error_deg,
                   "How far the lidar's believed pose is turned from the true one (scene files)")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--translation-error-mm", arguments->translation_error_mm,
                   "How far the lidar's believed pose is shifted from the true one (scene files)")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command
      ->add_option("--hold-out", arguments->hold_out,
                   "Score missions, which have no truth: maps of one line in so many (4) against "
                   "the beams of all the others")
      ->check(CLI::Range(2, 100));
  command->add_option("-o,--out", arguments->out,
                      "Folder for pictures of depth, error, samples and a view from aside, and "
                      "index.html with all of them");
  command->add_flag("--json", arguments->json, "Print a JSON list, one object a scene and method");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Evaluate(*arguments, context); };
  });
}

}  // namespace foresight
