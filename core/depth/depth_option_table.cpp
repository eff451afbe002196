#include "core/depth/depth_option_table.h"

#include <nlohmann/json.hpp>

#include "core/depth/depth_method.h"
#include "core/io/json_reader.h"
#include "core/options/option_json.h"

namespace foresight {
namespace {

using Row = Option<DepthOptions>;
using Rows = std::vector<Row>;

/// The member of DepthOptions that MEMBER names, const or not.
#define FORESIGHT_AT(MEMBER)   \
  [](auto& options) -> auto& { \
    return options.MEMBER;     \
  }

bool IsForesight(const DepthOptions& options) {
  return options.method == DepthMethod::kForesight;
}
bool IsTgv(const DepthOptions& options) {
  return options.method == DepthMethod::kTgv;
}
bool IsNonlocal(const DepthOptions& options) {
  return options.method == DepthMethod::kNonlocal;
}
bool IsJointFilter(const DepthOptions& options) {
  return options.method == DepthMethod::kPaper || options.method == DepthMethod::kJointBilateral;
}

using Applies = bool (*)(const DepthOptions&);

void Number(Rows& rows, OptionInfo info, Applies applies, auto at) {
  rows.push_back(NumberOption<DepthOptions>(std::move(info), at));
  rows.back().applies = applies;
}

void Integer(Rows& rows, OptionInfo info, Applies applies, auto at) {
  rows.push_back(IntegerOption<DepthOptions>(std::move(info), at));
  rows.back().applies = applies;
}

template <class E>
void Choice(Rows& rows, OptionInfo info, Applies applies,
            std::vector<std::pair<std::string, E>> words, auto at) {
  rows.push_back(ChoiceOption<DepthOptions, E>(std::move(info), std::move(words), at));
  rows.back().applies = applies;
}

constexpr double kMillimetres = 1000.0;
constexpr double kTiny = 1e-6;
constexpr const char* kFilter = "Filter";
constexpr const char* kFlying = "Flying points";
constexpr const char* kIsolated = "Isolated points";
constexpr const char* kFlipping = "Flipping points";
constexpr const char* kConfidence = "Confidence and mask";

OptionInfo SigmaSpatial(const char* key) {
  return {.key = key,
          .flag = "--sigma-spatial",
          .group = kFilter,
          .title = "Sigma",
          .help = "sigma_s in pixels; 0 = from the density (foresight, paper, jbu)",
          .unit = "px",
          .low = 0.0,
          .high = 200.0,
          .automatic = "from the density"};
}

OptionInfo Radius(const char* key) {
  return {.key = key,
          .flag = "--radius",
          .group = kFilter,
          .title = "Window's radius",
          .help = "The window's radius in sigma_s (foresight, paper, jbu)",
          .unit = "sigma",
          .low = 0.5,
          .high = 4.0};
}

OptionInfo SigmaDepth(const char* key) {
  return {.key = key,
          .flag = "--sigma-depth-mm",
          .group = kFilter,
          .title = "Sigma of depth",
          .help = "How far a depth may be off before it hardly counts (foresight, paper, jbu)",
          .unit = "mm",
          .units_per_si = kMillimetres,
          .low = kTiny};
}

OptionInfo SigmaColor(const char* key) {
  return {.key = key,
          .flag = "--sigma-color",
          .group = kFilter,
          .title = "Sigma of colour",
          .help = "How far a colour may be off: CIELAB units (foresight), grey levels (nonlocal)",
          .low = kTiny};
}

OptionInfo Smoothness(const char* key) {
  return {.key = key,
          .flag = "--smoothness",
          .group = kFilter,
          .title = "Smoothness",
          .help = "alpha_1 (tgv), lambda (nonlocal)",
          .low = kTiny};
}

OptionInfo Iterations(const char* key, double low, double high) {
  return {.key = key,
          .flag = "--iterations",
          .group = kFilter,
          .title = "Passes",
          .help = "Passes after the first; steps of the solver (tgv, nonlocal)",
          .low = low,
          .high = high};
}

OptionInfo SpacingAlong(const char* key, const char* group) {
  return {.key = key,
          .flag = "--spacing-along-px",
          .group = group,
          .title = "Spacing along a line",
          .help = "Spacing of the samples along a lidar line; 0 = measured",
          .unit = "px",
          .low = 0.0,
          .high = 999.0,
          .automatic = "measured"};
}

OptionInfo SpacingBetween(const char* key, const char* group) {
  return {.key = key,
          .flag = "--spacing-between-px",
          .group = group,
          .title = "Spacing between lines",
          .help = "Spacing of the samples from line to line; 0 = measured",
          .unit = "px",
          .low = 0.0,
          .high = 999.0,
          .automatic = "measured"};
}

std::vector<std::pair<std::string, UpsampleOptions::Weights>> WeightWords() {
  return {{"product", UpsampleOptions::Weights::kProduct},
          {"literal", UpsampleOptions::Weights::kLiteral}};
}

/// The rules by one word each, with what belongs to a rule; the rows after this one refine it.
Row FlyingRule() {
  OptionInfo info{.key = "flying.rule",
                  .flag = "--flying",
                  .group = kFlying,
                  .title = "Rule",
                  .help =
                      "Flying points, Eq. (7): max as printed, min, adaptive (30 mm + 2 z du / "
                      "f of depth)",
                  .type = OptionType::kChoice,
                  .words = {"off", "max", "min", "adaptive"}};
  using Flying = FlyingPointOptions;
  const auto get = [](const DepthOptions& options) -> OptionValue {
    if (options.flying.rule == Flying::Rule::kOff) return std::string("off");
    if (options.flying.rule == Flying::Rule::kBothNeighboursFar) return std::string("min");
    const bool adaptive = options.flying.distance == Flying::Distance::kDepth;
    return std::string(adaptive ? "adaptive" : "max");
  };
  const auto set = [](DepthOptions& options, const OptionValue& value) -> Status {
    const auto& word = std::get<std::string>(value);
    if (word != "off") options.flying = word == "adaptive" ? Flying::RangeAdaptive() : Flying();
    if (word == "off") options.flying.rule = Flying::Rule::kOff;
    if (word == "min") options.flying.rule = Flying::Rule::kBothNeighboursFar;
    return {};
  };
  return {std::move(info), get, set};
}

void AddRejection(Rows& rows) {
  rows.push_back(FlyingRule());
  Choice<FlyingPointOptions::Distance>(
      rows,
      {.key = "flying.distance",
       .flag = "--flying-distance",
       .group = kFlying,
       .title = "Distance",
       .help = "What Eq. (7) compares: distances in space, or depths"},
      nullptr,
      {{"euclidean", FlyingPointOptions::Distance::kEuclidean},
       {"depth", FlyingPointOptions::Distance::kDepth}},
      FORESIGHT_AT(flying.distance));
  Number(rows,
         {.key = "flying.threshold_m",
          .flag = "--flying-threshold-mm",
          .group = kFlying,
          .title = "Threshold",
          .help = "T_f of Eq. (7)",
          .unit = "mm",
          .units_per_si = kMillimetres,
          .low = kTiny},
         nullptr, FORESIGHT_AT(flying.threshold_m));
  Number(rows,
         {.key = "flying.threshold_per_metre",
          .flag = "--flying-per-metre",
          .group = kFlying,
          .title = "Threshold per depth",
          .help = "Added to T_f: this fraction of the depth",
          .low = 0.0},
         nullptr, FORESIGHT_AT(flying.threshold_per_metre));
  Number(rows,
         {.key = "flying.threshold_per_step",
          .flag = "--flying-per-step",
          .group = kFlying,
          .title = "Slope allowed",
          .help = "Added to T_f: this slope between neighbouring beams",
          .low = 0.0},
         nullptr, FORESIGHT_AT(flying.threshold_per_step));
  rows.push_back(SwitchOption<DepthOptions>({.key = "isolated.enabled",
                                             .flag = "--isolated",
                                             .group = kIsolated,
                                             .title = "Reject",
                                             .help = "Reject isolated points"},
                                            FORESIGHT_AT(isolated.enabled)));
  Integer(rows,
          {.key = "isolated.grow_px",
           .flag = "--isolated-grow-px",
           .group = kIsolated,
           .title = "Growth",
           .help = "A sample grows by this beyond the spacing of its neighbours",
           .unit = "px",
           .low = 1,
           .high = 100},
          nullptr, FORESIGHT_AT(isolated.grow_px));
  Number(rows, SpacingAlong("isolated.along_line_px", kIsolated), nullptr,
         FORESIGHT_AT(isolated.along_line_px));
  Number(rows, SpacingBetween("isolated.between_lines_px", kIsolated), nullptr,
         FORESIGHT_AT(isolated.between_lines_px));
  using Flipping = FlippingPointOptions;
  Choice<Flipping::Test>(
      rows,
      {.key = "flipping.test",
       .flag = "--flipping",
       .group = kFlipping,
       .title = "Test",
       .help =
           "Flipping points: behind the cells of Fig. 4, or behind the mesh of connected cells"},
      nullptr,
      {{"off", Flipping::Test::kOff},
       {"cells", Flipping::Test::kCells},
       {"mesh", Flipping::Test::kMesh}},
      FORESIGHT_AT(flipping.test));
  Number(rows,
         {.key = "flipping.margin_m",
          .flag = "--flip-margin-mm",
          .group = kFlipping,
          .title = "Margin",
          .help = "How much further behind a flipping point is",
          .unit = "mm",
          .units_per_si = kMillimetres,
          .low = 0.0},
         nullptr, FORESIGHT_AT(flipping.margin_m));
  Number(rows,
         {.key = "flipping.connected_step_m",
          .flag = "--flip-step-mm",
          .group = kFlipping,
          .title = "Step within a surface",
          .help = "Mesh: a cell with a larger step of depth is not connected",
          .unit = "mm",
          .units_per_si = kMillimetres,
          .low = kTiny},
         nullptr, FORESIGHT_AT(flipping.connected_step_m));
  Choice<Flipping::Cells>(
      rows,
      {.key = "flipping.cells",
       .flag = "--cells-from",
       .group = kFlipping,
       .title = "Cells from",
       .help = "Samples that span cells: those that Eq. (7) kept, or all of them"},
      nullptr,
      {{"kept", Flipping::Cells::kFromKeptSamples}, {"all", Flipping::Cells::kFromAllSamples}},
      FORESIGHT_AT(flipping.cells));
}

/// The terms of the confidence, which may be left to those of the weights.
Row ConfidenceTerms() {
  OptionInfo info{.key = "upsample.confidence_terms",
                  .flag = "--confidence-terms",
                  .group = kConfidence,
                  .title = "Terms",
                  .help =
                      "Terms of Eq. (9): G H, or exp(G + H) as printed; the default is the form "
                      "of the weights (paper, jbu)",
                  .type = OptionType::kChoice,
                  .words = {"as-weights", "product", "literal"}};
  const auto get = [](const DepthOptions& options) -> OptionValue {
    const auto& terms = options.upsample.confidence_terms;
    if (!terms) return std::string("as-weights");
    return std::string(*terms == UpsampleOptions::Weights::kProduct ? "product" : "literal");
  };
  const auto set = [](DepthOptions& options, const OptionValue& value) -> Status {
    auto& terms = options.upsample.confidence_terms;
    terms.reset();
    for (const auto& [word, weights] : WeightWords())
      if (word == std::get<std::string>(value)) terms = weights;
    return {};
  };
  return {std::move(info), get, set, IsJointFilter};
}

void AddJointFilter(Rows& rows) {
  Number(rows, SigmaSpatial("upsample.sigma_spatial_px"), IsJointFilter,
         FORESIGHT_AT(upsample.sigma_spatial_px));
  Number(rows, Radius("upsample.radius_in_sigmas"), IsJointFilter,
         FORESIGHT_AT(upsample.radius_in_sigmas));
  Number(rows,
         {.key = "upsample.sigma_intensity",
          .flag = "--sigma-intensity",
          .group = kFilter,
          .title = "Sigma of intensity",
          .help = "sigma_i in grey levels (paper, jbu)",
          .low = kTiny},
         IsJointFilter, FORESIGHT_AT(upsample.sigma_intensity));
  Number(rows, SigmaDepth("upsample.sigma_depth_m"), IsJointFilter,
         FORESIGHT_AT(upsample.sigma_depth_m));
  Integer(rows, Iterations("upsample.iterations", 0, 50), IsJointFilter,
          FORESIGHT_AT(upsample.iterations));
  Choice<UpsampleOptions::Weights>(
      rows,
      {.key = "upsample.weights",
       .flag = "--weights",
       .group = kFilter,
       .title = "Weights",
       .help = "Weights of Eq. (8): G K H, or exp(G + K + H) as printed (paper, jbu)"},
      IsJointFilter, WeightWords(), FORESIGHT_AT(upsample.weights));
  Choice<ConfidencePasses>(rows,
                           {.key = "upsample.confidence_passes",
                            .flag = "--confidence",
                            .group = kConfidence,
                            .title = "Passes summed",
                            .help = "Passes that Eq. (9) sums over (paper, jbu)"},
                           IsJointFilter,
                           {{"all", ConfidencePasses::kAll},
                            {"every-depth", ConfidencePasses::kEveryDepth},
                            {"guided", ConfidencePasses::kGuided}},
                           FORESIGHT_AT(upsample.confidence_passes));
  rows.push_back(ConfidenceTerms());
}

void AddLocalPlanes(Rows& rows) {
  Number(rows, SigmaSpatial("local_plane.sigma_spatial_px"), IsForesight,
         FORESIGHT_AT(local_plane.sigma_spatial_px));
  Number(rows, Radius("local_plane.radius_in_sigmas"), IsForesight,
         FORESIGHT_AT(local_plane.radius_in_sigmas));
  Number(rows, SigmaColor("local_plane.sigma_color"), IsForesight,
         FORESIGHT_AT(local_plane.sigma_color));
  Number(rows, SigmaDepth("local_plane.sigma_depth_m"), IsForesight,
         FORESIGHT_AT(local_plane.sigma_depth_m));
  Number(rows,
         {.key = "local_plane.ridge",
          .flag = "--ridge",
          .group = kFilter,
          .title = "Ridge on slopes",
          .help = "Pull of slopes to zero, of sigma_s squared (foresight)",
          .low = kTiny},
         IsForesight, FORESIGHT_AT(local_plane.ridge));
  Integer(rows, Iterations("local_plane.iterations", 1, 50), IsForesight,
          FORESIGHT_AT(local_plane.iterations));
  Number(rows, SpacingAlong("local_plane.along_line_px", kFilter), IsForesight,
         FORESIGHT_AT(local_plane.along_line_px));
  Number(rows, SpacingBetween("local_plane.between_lines_px", kFilter), IsForesight,
         FORESIGHT_AT(local_plane.between_lines_px));
}

void AddTgv(Rows& rows) {
  Number(rows, Smoothness("tgv.smoothness"), IsTgv, FORESIGHT_AT(tgv.smoothness));
  Number(rows,
         {.key = "tgv.straightness",
          .flag = "--straightness",
          .group = kFilter,
          .title = "Straightness",
          .help = "alpha_0: how much the slope may change (tgv)",
          .low = kTiny},
         IsTgv, FORESIGHT_AT(tgv.straightness));
  Number(rows,
         {.key = "tgv.edge_steepness",
          .flag = "--edge-steepness",
          .group = kFilter,
          .title = "Edge steepness",
          .help = "beta: how soon an edge of the image frees the depth (tgv)",
          .low = kTiny},
         IsTgv, FORESIGHT_AT(tgv.edge_steepness));
  Number(rows,
         {.key = "tgv.edge_power",
          .flag = "--edge-power",
          .group = kFilter,
          .title = "Edge power",
          .help = "gamma, of the image's gradient (tgv)",
          .low = kTiny},
         IsTgv, FORESIGHT_AT(tgv.edge_power));
  Number(rows,
         {.key = "tgv.data_weight",
          .flag = "--data-weight",
          .group = kFilter,
          .title = "Weight of samples",
          .help = "lambda, of the squared distance to the samples (tgv)",
          .low = kTiny},
         IsTgv, FORESIGHT_AT(tgv.data_weight));
  Integer(rows, Iterations("tgv.iterations", 1, 100000), IsTgv, FORESIGHT_AT(tgv.iterations));
}

void AddNonlocal(Rows& rows) {
  Number(rows, Smoothness("nonlocal.smoothness"), IsNonlocal, FORESIGHT_AT(nonlocal.smoothness));
  Number(rows,
         {.key = "nonlocal.nonlocal_fraction",
          .flag = "--nonlocal-fraction",
          .group = kFilter,
          .title = "Weight of similar pixels",
          .help = "What a similar pixel counts beside a neighbour (nonlocal)",
          .low = kTiny},
         IsNonlocal, FORESIGHT_AT(nonlocal.nonlocal_fraction));
  Number(rows, SigmaColor("nonlocal.sigma_color"), IsNonlocal, FORESIGHT_AT(nonlocal.sigma_color));
  Integer(rows,
          {.key = "nonlocal.window_radius_px",
           .flag = "--window-radius-px",
           .group = kFilter,
           .title = "Window's radius",
           .help = "Similar pixels are looked for this far away (nonlocal)",
           .unit = "px",
           .low = 2,
           .high = 20},
          IsNonlocal, FORESIGHT_AT(nonlocal.window_radius_px));
  Integer(rows,
          {.key = "nonlocal.patch_radius_px",
           .flag = "--patch-radius-px",
           .group = kFilter,
           .title = "Patch's radius",
           .help = "Similar pixels are compared by patches of this radius (nonlocal)",
           .unit = "px",
           .low = 0,
           .high = 10},
          IsNonlocal, FORESIGHT_AT(nonlocal.patch_radius_px));
  Integer(rows,
          {.key = "nonlocal.similar_pixels",
           .flag = "--similar-pixels",
           .group = kFilter,
           .title = "Similar pixels",
           .help = "So many of them are connected to each pixel (nonlocal)",
           .low = 1,
           .high = 16},
          IsNonlocal, FORESIGHT_AT(nonlocal.similar_pixels));
  Integer(rows, Iterations("nonlocal.iterations", 1, 100000), IsNonlocal,
          FORESIGHT_AT(nonlocal.iterations));
}

void AddMask(Rows& rows) {
  Number(rows,
         {.key = "mask.threshold",
          .flag = "--threshold",
          .group = kConfidence,
          .title = "Threshold",
          .help = "Confidence below this fraction of the reference is masked",
          .low = 0.0,
          .high = 1.0},
         nullptr, FORESIGHT_AT(mask.threshold));
  using Mask = ConfidenceMaskOptions;
  Choice<Mask::Reference>(
      rows,
      {.key = "mask.reference",
       .flag = "--mask-reference",
       .group = kConfidence,
       .title = "Reference",
       .help = "Reference of the mask: the largest confidence in the image, or a full "
               "neighbourhood's"},
      nullptr, {{"max", Mask::Reference::kLargest}, {"nominal", Mask::Reference::kNominal}},
      FORESIGHT_AT(mask.reference));
}

#undef FORESIGHT_AT

constexpr const char* kMethodKey = "method";

}  // namespace

OptionTable<DepthOptions> DepthOptionTable() {
  static const Rows kRows = [] {
    Rows rows;
    AddJointFilter(rows);
    AddLocalPlanes(rows);
    AddTgv(rows);
    AddNonlocal(rows);
    AddRejection(rows);
    AddMask(rows);
    return rows;
  }();
  return kRows;
}

std::string DepthOptionsToJson(const DepthOptions& options) {
  nlohmann::ordered_json object = {{kMethodKey, InfoOf(options.method).name}};
  object.update(nlohmann::ordered_json::parse(OptionsToJson(DepthOptionTable(), options)));
  return object.dump();
}

Result<DepthOptions> DepthOptionsFromJson(const std::string& json) {
  try {
    nlohmann::json object = ParseJson(json);
    const auto method = DepthMethodFromName(object.at(kMethodKey).get<std::string>());
    if (!method) return Fail(ErrorCode::kBadData, "depth options: {}", method.error().message);
    object.erase(kMethodKey);
    DepthOptions options = DefaultsOf(*method);
    const Status set = OptionsFromJson(DepthOptionTable(), object.dump(), options).and_then([&] {
      return options.Check();
    });
    if (!set) return Fail(ErrorCode::kBadData, "depth options: {}", set.error().message);
    return options;
  } catch (const nlohmann::json::exception& error) {
    return Fail(ErrorCode::kBadData, "depth options: {}", error.what());
  } catch (const std::invalid_argument& error) {
    return Fail(ErrorCode::kBadData, "depth options: {}", error.what());
  }
}

}  // namespace foresight
