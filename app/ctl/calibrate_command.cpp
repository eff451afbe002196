#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/base/utc_text.h"
#include "core/calibration/board_images.h"
#include "core/calibration/intrinsics.h"
#include "core/sensor/rig_id.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

struct IntrinsicsArguments {
  std::vector<std::string> places;
  std::string board;
  std::string models = "k,eucm,kb4";
  std::string warp = "auto";
  std::string rig;
  std::string out;
  std::string corners;
  bool json = false;
};

using Json = nlohmann::ordered_json;

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Result<IntrinsicsOptions> OptionsFrom(const IntrinsicsArguments& arguments) {
  IntrinsicsOptions options;
  FORESIGHT_TRY(options.models, LensModelsFromText(arguments.models));
  if (arguments.warp == "on") options.warp = IntrinsicsOptions::Warp::kOn;
  if (arguments.warp == "off") options.warp = IntrinsicsOptions::Warp::kOff;
  return options;
}

Json ValuesJson(const CameraModel& camera, const CameraModel::Parameters& values) {
  Json json = Json::object();
  const std::vector<std::string_view> names = camera.ParameterNames();
  for (std::size_t i = 0; i < names.size(); ++i)
    json[std::string(names[i])] = FiniteOrNull(values[static_cast<Eigen::Index>(i)]);
  return json;
}

Json RejectedJson(const std::vector<RejectedImage>& rejected) {
  Json json = Json::array();
  for (const RejectedImage& image : rejected)
    json.push_back({{"file", image.name}, {"reason", image.reason}});
  return json;
}

/// What all models have in common.
struct CommonResults {
  const BoardImages& images;
  std::vector<RejectedImage> rejected;
  double detection_seconds = 0.0;
};

Json ModelJson(const ModelCalibration& m, const IntrinsicsCalibration& calibration, bool chosen,
               const CommonResults& common) {
  const bool found = m.corners > 0;
  Json json = {
      {"model", ToString(m.model)},
      {"images_used", calibration.images_used.size()},
      {"images_rejected", RejectedJson(common.rejected)},
      {"mean_error_px", found ? FiniteOrNull(m.mean_error_px) : Json(nullptr)},
      {"rms_px", found ? FiniteOrNull(m.rms_px) : Json(nullptr)},
      {"parameters", found ? ValuesJson(m.camera, m.camera.Values()) : Json(nullptr)},
      {"sigma", m.covariance ? ValuesJson(m.camera, m.covariance->ValueSigmas()) : Json(nullptr)},
      {"cross_validation_px", FiniteOrNull(m.cross_validation_px)},
      {"board_warp_mm", {1000.0 * m.warp.x_m, 1000.0 * m.warp.y_m}},
      {"seconds", m.seconds}};
  json["chosen"] = chosen;
  json["failure"] = m.failure.empty() ? Json(nullptr) : Json(m.failure);
  json["warnings"] = m.warnings;
  json["image_size"] = {common.images.width, common.images.height};
  json["corners_used"] = m.corners;
  json["corners_rejected"] = calibration.corners_rejected;
  json["detection_seconds"] = common.detection_seconds;
  Json images = Json::array();
  for (const ImageErrors& image : m.images)
    images.push_back({{"file", common.images.images[image.image].name},
                      {"corners", image.pixels.size()},
                      {"mean_error_px", FiniteOrNull(image.mean_px)},
                      {"rms_px", FiniteOrNull(image.rms_px)}});
  json["images"] = images;
  return json;
}

/// A list like that of a calibration, where there is none: the reason stands in each model.
Json FailureJson(const IntrinsicsOptions& options, const CommonResults& common,
                 const std::string& failure) {
  IntrinsicsCalibration nothing;
  Json json = Json::array();
  for (const LensModel model : options.models) {
    ModelCalibration failed;
    failed.model = model;
    failed.failure = failure;
    json.push_back(ModelJson(failed, nothing, false, common));
  }
  return json;
}

/// The reason that most files were rejected for, with an example.
std::string MostCommonReason(const std::vector<RejectedImage>& rejected) {
  std::map<std::string, int> counts;
  for (const RejectedImage& image : rejected) ++counts[image.reason];
  std::string text;
  int most = 0;
  for (const RejectedImage& image : rejected)
    if (counts[image.reason] > most) {
      most = counts[image.reason];
      text = fmt::format("{}: {}", image.name, image.reason);
    }
  return text;
}

void PrintRejected(const std::vector<RejectedImage>& rejected) {
  for (const RejectedImage& image : rejected)
    PrintLine(fmt::format("left out  {}: {}", image.name, image.reason));
}

std::string Describe(const ModelCalibration& m) {
  if (m.corners == 0) return fmt::format("{:<7} {}", ToString(m.model), m.failure);
  std::string text =
      fmt::format("{:<7} mean error {:.3f} px, rms {:.3f} px, cross-validation {:.3f} px",
                  ToString(m.model), m.mean_error_px, m.rms_px, m.cross_validation_px);
  const std::vector<std::string_view> names = m.camera.ParameterNames();
  const CameraModel::Parameters values = m.camera.Values();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    text += fmt::format("\n        {:<6} {:.6g}", names[i], values[at]);
    if (m.covariance) text += fmt::format(" +- {:.2g}", m.covariance->ValueSigmas()[at]);
  }
  if (m.warp_estimated)
    text += fmt::format("\n        board bent by {:.2f} and {:.2f} mm", 1000.0 * m.warp.x_m,
                        1000.0 * m.warp.y_m);
  for (const std::string& warning : m.warnings) text += "\n        note: " + warning;
  if (!m.failure.empty()) text += "\n        not usable: " + m.failure;
  return text;
}

/// The corners as a table that mrcal reads too (vnlog): a line a corner, row by row, "-" where a
/// corner was not found.
Status WriteCorners(const CalibrationBoard& board, const BoardImages& images,
                    const std::string& file) {
  std::string text = "# filename x y level\n";
  for (const IntrinsicsImage& image : images.images) {
    std::map<int, Eigen::Vector2d> found;
    for (std::size_t i = 0; i < image.view.pixels.size(); ++i)
      found[image.view.corner_ids[i]] = image.view.pixels[i];
    for (int id = 0; id < board.CornerCount(); ++id) {
      const auto at = found.find(id);
      text += at == found.end()
                  ? fmt::format("{} - - -\n", image.name)
                  : fmt::format("{} {:.4f} {:.4f} 0\n", image.name, at->second.x(), at->second.y());
    }
  }
  return WriteFileAtomically(file, text);
}

Status WriteRig(const IntrinsicsArguments& arguments, const CameraModel& camera) {
  SensorRig rig = DefaultSensorRig();
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(rig, LoadSensorRig(arguments.rig));
  }
  rig.parent_id = RigId(rig);
  rig.date_utc = UtcDateNow();
  rig.camera = camera;
  return SaveSensorRig(rig, arguments.out);
}

Result<ExitCode> Give(const IntrinsicsArguments& arguments,
                      const IntrinsicsCalibration& calibration, const CommonResults& common) {
  if (calibration.best >= 0 && !arguments.out.empty())
    FORESIGHT_CHECK(
        WriteRig(arguments, calibration.models[static_cast<std::size_t>(calibration.best)].camera));
  Json json = Json::array();
  for (std::size_t i = 0; i < calibration.models.size(); ++i)
    json.push_back(ModelJson(calibration.models[i], calibration,
                             static_cast<int>(i) == calibration.best, common));
  if (arguments.json) {
    PrintJson(json);
  } else {
    PrintRejected(common.rejected);
    PrintLine(fmt::format("{} images of {}x{} px, {} corners left out",
                          calibration.images_used.size(), common.images.width, common.images.height,
                          calibration.corners_rejected));
    for (const ModelCalibration& model : calibration.models) PrintLine(Describe(model));
  }
  if (calibration.best < 0) {
    PrintNote("foresightctl: no model is usable; {}", calibration.models.front().failure);
    return ExitCode::kNegative;
  }
  if (!arguments.json)
    PrintLine(
        fmt::format("chosen    {}{}",
                    ToString(calibration.models[static_cast<std::size_t>(calibration.best)].model),
                    arguments.out.empty() ? "" : ", written to " + arguments.out));
  return ExitCode::kDone;
}

Result<ExitCode> CalibrateCamera(const IntrinsicsArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const IntrinsicsOptions options, OptionsFrom(arguments));
  FORESIGHT_TRY(const CalibrationBoard board, CalibrationBoardFromText(arguments.board));
  FORESIGHT_TRY(const auto files, ListImageFiles(arguments.places));
  const auto start = std::chrono::steady_clock::now();
  FORESIGHT_TRY(const BoardImages images, DetectBoards(files, board, context.Part(0.0, 0.8)));
  CommonResults common{.images = images, .rejected = images.rejected};
  common.detection_seconds = SecondsSince(start);
  if (images.width == 0)
    return Fail(ErrorCode::kBadData, "none of {} files is an image that can be read; {}: {}",
                files.size(), images.rejected.front().name, images.rejected.front().reason);

  if (!arguments.corners.empty()) FORESIGHT_CHECK(WriteCorners(board, images, arguments.corners));

  auto calibration = CalibrateIntrinsics(board, images.images, images.width, images.height, options,
                                         context.Part(0.8, 1.0));
  if (calibration) {
    common.rejected.insert(common.rejected.end(), calibration->images_rejected.begin(),
                           calibration->images_rejected.end());
    return Give(arguments, *calibration, common);
  }
  Error error = calibration.error();
  if (ExitCodeFor(error.code) != ExitCode::kNegative) return tl::unexpected(error);
  if (2 * images.images.size() < files.size() && !images.rejected.empty())
    error.message += fmt::format("; {} of {} images were left out, e.g. {}", images.rejected.size(),
                                 files.size(), MostCommonReason(images.rejected));
  if (!arguments.json) {
    PrintRejected(images.rejected);
    return tl::unexpected(error);
  }
  PrintJson(FailureJson(options, common, error.message));
  PrintNote("foresightctl: {}", error.message);
  return ExitCode::kNegative;
}

void AddIntrinsicsCommand(CLI::App& calibrate, Invocation& invocation) {
  const auto arguments = std::make_shared<IntrinsicsArguments>();
  CLI::App* command = calibrate.add_subcommand(
      "intrinsics", "A camera from images of one board, without a guess: Eq. (1)-(3) and more");
  command
      ->add_option("images", arguments->places,
                   "Image files (PNG, JPEG, PGM) and folders of them, all of one camera")
      ->required();
  command
      ->add_option("--board", arguments->board,
                   "checkerboard:COLUMNSxROWS:SQUARE_MM or "
                   "charuco:COLUMNSxROWS:SQUARE_MM[:MARKER_MM[:DICTIONARY]], inner corners")
      ->required();
  command
      ->add_option("--model", arguments->models,
                   "Models to fit, of k, eucm, kb4, radtan; the best by cross-validation is chosen")
      ->capture_default_str();
  command
      ->add_option("--warp", arguments->warp,
                   "Estimate how the board is bent: on, off, or auto where that predicts better")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->capture_default_str();
  command->add_option("--rig", arguments->rig,
                      "The rig that gets the camera; else the default one");
  command->add_option("--out", arguments->out, "Write the rig with the chosen camera (YAML)");
  command->add_option("--corners", arguments->corners,
                      "Also write the corners found: filename x y level, as mrcal reads them");
  command->add_flag("--json", arguments->json, "Print one object a model, in a list");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return CalibrateCamera(*arguments, context);
    };
  });
}

}  // namespace

void AddCalibrateCommand(CLI::App& app, Invocation& invocation) {
  CLI::App* calibrate = app.add_subcommand("calibrate", "Calibrate a head from images of boards");
  calibrate->require_subcommand(1);
  AddIntrinsicsCommand(*calibrate, invocation);
  AddCalibrateChainCommands(*calibrate, invocation);
  AddCalibrateRobotCommand(*calibrate, invocation);
  AddCalibrateCheckCommand(*calibrate, invocation);
  AddCalibrateRecordCommand(*calibrate, invocation);
}

}  // namespace foresight
