#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/depth/depth_method.h"
#include "core/detection/detection.h"
#include "core/detection/fit_in_scan.h"
#include "core/evaluation/simulated_trial.h"

namespace foresight {

/// Where scenes come from.
enum class FitWorld {
  kHome,    ///< whose constants the fits know: for tuning and weights, and for tests on other seeds
  kVaried,  ///< the same things under drawn conditions: for choices, varied_world.h
  kOther,   ///< which shares none of them: it judges only, other_world.h
};
/// "home", "varied", "other".
const char* ToString(FitWorld world);
/// Fails with kBadData for any other word.
Result<FitWorld> FitWorldFromString(const std::string& name);

/// A scene that a fit is tried on, drawn at random by a seed, and how it is looked at.
struct FitTrialScene {
  std::shared_ptr<const Scene> scene;
  ScanPlan plan;       ///< upwards, with one image
  WorldOptions world;  ///< with a noise of its own
  std::string what;    ///< "wheel of 4 spokes", "half a wheel"
  bool positive = true;
  /// What an operator would draw a region round: a sphere in robot.
  Eigen::Vector3d focus_m = Eigen::Vector3d::Zero();
  double focus_radius_m = 0.2;

  /// How the operator draws it.
  enum class Region {
    kCircle,     ///< a little wider than the focus, not quite centred
    kRectangle,  ///< 1.0 to 2.2 times as large as what is seen, off by up to a quarter of it
    kTightBox,   ///< in the cloud, along robot's axes
  } region = Region::kCircle;
  /// Points of its surface, in robot, for rectangles and boxes; empty = it is about the focus.
  std::vector<Eigen::Vector3d> object_points = {};
  /// Of the believed rig, where the trial's options name none.
  std::optional<CalibrationError> rig_error = {};
  /// Fraction of the lines that were measured before the scan was interrupted.
  double scanned = 1.0;
};

/// A scene as the head brings it home.
struct FitTrial {
  std::uint64_t seed = 0;
  FitTrialScene scene;
  World world;    ///< the true head in it
  SensorRig rig;  ///< the believed one
  RegisteredScan cloud;
  CameraFrame frame;  ///< its image is empty where no fit needs it
  Roi roi;            ///< as an operator draws it

  /// Truth in the believed head's base.
  Rigid<frame::Base, frame::Robot> TrueBaseFromRobot() const { return world.BaseFromRobot(); }
};

/// What became of one answer.
struct FitOutcome {
  FitWorld world = FitWorld::kHome;
  std::uint64_t seed = 0;
  std::string what;
  std::string source;    ///< "raw" or a depth method's name
  bool positive = true;  ///< there was something to find
  bool found = false;    ///< there is an answer; else `verdict` is empty and `reason` says why
  bool pose_ok = false;  ///< fitting is right where it counts (docs/evaluation.md)
  bool all_ok = false;   ///< and in every other respect: what a CONFIRMED answer promises
  Verdict verdict;
  /// What gates may look at beside Verdict::features: "rim_nats", "see_through" (EvidenceNumbers).
  std::vector<std::pair<std::string, double>> evidence = {};
  /// "center_mm", "axis_deg", ...; in deviations where the name ends with kSigmaErrorSuffix.
  std::vector<std::pair<std::string, double>> errors;
  double seconds = 0.0;  ///< of CPU, the fit alone
  std::string reason;
};

/// The scenes of one object, and what a right answer is.
class FitPopulation {
 public:
  virtual ~FitPopulation() = default;
  virtual ObjectKind Kind() const = 0;
  virtual FitWorld World() const { return FitWorld::kHome; }
  /// About one in six is a negative: other things, an empty region, a wall, half an object, a
  /// table's edge, distractors.
  virtual FitTrialScene MakeScene(std::uint64_t seed) const = 0;
  /// What the fit is asked for; the programs' defaults.
  virtual FitOptions Options(const SensorRig& rig) const {
    return FitOptionsFor(Kind(), rig.robot_from_base);
  }
  /// One outcome an answer; terrain has one for each surface that is offered as a block and one,
  /// not found, for each visible block that is missed. `found` is the failure where there is no
  /// answer.
  virtual std::vector<FitOutcome> Judge(const FitTrial& trial,
                                        const Result<Detection>& found) const = 0;
  /// What Verdict::features holds.
  virtual std::vector<std::string> FeatureNames() const = 0;
};

struct FitTrialOptions {
  std::vector<NamedSource> sources = {{}};    ///< what is fitted to; the lidar's returns
  bool plain_cloud = false;                   ///< and, as kCloudSource, a cloud without its scan
  std::optional<CalibrationError> rig_error;  ///< of the believed rig; none = perfect
  /// ProcessedScan::outline_weight; 0 = fits to returns see no image.
  double outline_weight = ImageEdges::kIndependentPerPixel;

  bool NeedsImage(ObjectKind kind) const;
  Status Check() const;
};

/// Simulates the scan of a population's scene. With dense sources about 2 s of CPU, else 0.5 s.
Result<FitTrial> MakeFitTrial(const FitPopulation& population, std::uint64_t seed,
                              const FitTrialOptions& options, const RunContext& context);

/// Every source's fit to one scene, judged.
Result<std::vector<FitOutcome>> RunFitTrial(const FitPopulation& population, std::uint64_t seed,
                                            const FitTrialOptions& options,
                                            const RunContext& context);

}  // namespace foresight
