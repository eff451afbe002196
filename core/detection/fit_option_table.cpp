#include "core/detection/fit_option_table.h"

#include <numbers>

#include "core/detection/detection_json.h"
#include "core/options/option_json.h"

namespace foresight {
namespace {

using Row = Option<FitOptions>;
using Rows = std::vector<Row>;

constexpr double kMillimetres = 1000.0;
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kMinRays = 60;  ///< of any fit
constexpr double kMostRays = 1e6;
constexpr const char* kObject = "Object";
constexpr const char* kSearch = "Search";

/// The member of the kind's options, const or not.
#define FORESIGHT_AT(OPTIONS, MEMBER)         \
  [](auto& options) -> auto& {                \
    return std::get<OPTIONS>(options).MEMBER; \
  }

Row Number(OptionInfo info, auto at) {
  return NumberOption<FitOptions>(std::move(info), at);
}
Row Integer(OptionInfo info, auto at) {
  return IntegerOption<FitOptions>(std::move(info), at);
}
Row Switch(OptionInfo info, auto at) {
  return SwitchOption<FitOptions>(std::move(info), at);
}

Row MaxRays(auto at) {
  return Integer({.key = "max_rays",
                  .flag = "--max-rays",
                  .group = kSearch,
                  .title = "Rays at most",
                  .help = "A denser region is thinned to this many rays",
                  .low = kMinRays,
                  .high = kMostRays},
                 at);
}

Row Tilt(const char* key, const char* flag, const char* title, const char* help, double most_deg,
         auto at) {
  return Number({.key = key,
                 .flag = flag,
                 .group = kObject,
                 .title = title,
                 .help = help,
                 .unit = "deg",
                 .units_per_si = kDegrees,
                 .low = 0.1,
                 .high = most_deg},
                at);
}

template <class Vector>
OptionValue NumbersOf(const Vector& vector) {
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}

/// A vector of the options as a list of numbers.
Row Numbers(OptionInfo info, auto at) {
  info.type = OptionType::kNumbers;
  return {std::move(info), [at](const FitOptions& options) { return NumbersOf(at(options)); },
          [at](FitOptions& options, const OptionValue& value) -> Status {
            const auto& numbers = std::get<std::vector<double>>(value);
            std::copy(numbers.begin(), numbers.end(), at(options).data());
            return {};
          }};
}

/// Which way is up comes from the rig: a record has it, nobody types it here.
Row Up(auto at) {
  return Numbers({.key = "up",
                  .group = kObject,
                  .title = "Up",
                  .help = "Against gravity, in base",
                  .low = -1.0,
                  .high = 1.0,
                  .count = 3},
                 at);
}

Rows ValveRows() {
  Rows rows;
  rows.push_back(Number({.key = "min_rim_radius_m",
                         .flag = "--min-rim-radius-mm",
                         .group = kObject,
                         .title = "Rim's radius from",
                         .help = "Smallest radius of a wheel's rim",
                         .unit = "mm",
                         .units_per_si = kMillimetres,
                         .low = 1.0,
                         .high = 2000.0},
                        FORESIGHT_AT(FitValveOptions, min_rim_radius_m)));
  rows.push_back(Number({.key = "max_rim_radius_m",
                         .flag = "--max-rim-radius-mm",
                         .group = kObject,
                         .title = "Rim's radius to",
                         .help = "Largest radius of a wheel's rim",
                         .unit = "mm",
                         .units_per_si = kMillimetres,
                         .low = 1.0,
                         .high = 2000.0},
                        FORESIGHT_AT(FitValveOptions, max_rim_radius_m)));
  rows.push_back(Integer({.key = "min_spokes",
                          .flag = "--min-spokes",
                          .group = kObject,
                          .title = "Spokes from",
                          .help = "Fewest spokes that are tried",
                          .low = 2,
                          .high = 6},
                         FORESIGHT_AT(FitValveOptions, min_spokes)));
  rows.push_back(Integer({.key = "max_spokes",
                          .flag = "--max-spokes",
                          .group = kObject,
                          .title = "Spokes to",
                          .help = "Most spokes that are tried",
                          .low = 2,
                          .high = 6},
                         FORESIGHT_AT(FitValveOptions, max_spokes)));
  rows.push_back(Integer({.key = "circle_trials",
                          .flag = "--circle-trials",
                          .group = kSearch,
                          .title = "Circles tried",
                          .help = "How many circles through three points are tried for the rim",
                          .low = 1,
                          .high = 1e6},
                         FORESIGHT_AT(FitValveOptions, circle_trials)));
  rows.push_back(MaxRays(FORESIGHT_AT(FitValveOptions, max_rays)));
  rows.push_back(SeedOption<FitOptions>(FORESIGHT_AT(FitValveOptions, seed)));
  return rows;
}

/// Empty = the built-in templates.
Row Template() {
  OptionInfo info{.key = "template",
                  .flag = "--template",
                  .group = kObject,
                  .title = "Template",
                  .help = "Template of the drill (YAML); default: the built-in ones",
                  .type = OptionType::kDocument,
                  .automatic = "the built-in ones"};
  const auto get = [](const FitOptions& options) -> OptionValue {
    const auto& templates = std::get<FitDrillOptions>(options).templates;
    return templates.size() == 1 ? templates.front().yaml : std::string();
  };
  const auto set = [](FitOptions& options, const OptionValue& value) -> Status {
    auto& templates = std::get<FitDrillOptions>(options).templates;
    const auto& yaml = std::get<std::string>(value);
    if (yaml.empty()) {
      templates = ShippedDrillTemplates();
      return {};
    }
    FORESIGHT_TRY(DrillTemplate wanted, DrillTemplateFromYaml(yaml, "drill template"));
    templates = {std::move(wanted)};
    return {};
  };
  return {std::move(info), get, set};
}

Rows DrillRows() {
  Rows rows;
  rows.push_back(Template());
  rows.push_back(Tilt("max_table_tilt_rad", "--max-table-tilt-deg", "Table's tilt to",
                      "How far from level a table may be", 57.0,
                      FORESIGHT_AT(FitDrillOptions, max_table_tilt_rad)));
  rows.push_back(Tilt("max_body_tilt_rad", "--max-body-tilt-deg", "Body's tilt to",
                      "How far the drill's body may lean", 57.0,
                      FORESIGHT_AT(FitDrillOptions, max_body_tilt_rad)));
  rows.push_back(Up(FORESIGHT_AT(FitDrillOptions, up)));
  rows.push_back(MaxRays(FORESIGHT_AT(FitDrillOptions, max_rays)));
  rows.push_back(SeedOption<FitOptions>(FORESIGHT_AT(FitDrillOptions, seed)));
  return rows;
}

/// Empty = no earlier answer.
Row LastTerrain() {
  OptionInfo info{.key = "last",
                  .flag = "--last",
                  .group = kObject,
                  .title = "Compared with",
                  .help =
                      "The last accepted answer, as --json wrote it: blocks that moved since "
                      "are marked",
                  .type = OptionType::kDocument,
                  .automatic = "the last accepted terrain"};
  const auto get = [](const FitOptions& options) -> OptionValue {
    const auto& last = std::get<FitTerrainOptions>(options).last;
    return last ? DetectionToJson(*last, Rigid<frame::Robot, frame::Base>()) : std::string();
  };
  const auto set = [](FitOptions& options, const OptionValue& value) -> Status {
    auto& last = std::get<FitTerrainOptions>(options).last;
    const auto& json = std::get<std::string>(value);
    last.reset();
    if (json.empty()) return {};
    FORESIGHT_TRY(const Detection detection, DetectionFromJson(json));
    const auto* terrain = std::get_if<TerrainDetection>(&detection);
    if (terrain == nullptr)
      return Fail(ErrorCode::kBadData, "holds a {}, not a terrain",
                  ToString(ObjectKindOf(detection)));
    last = std::make_shared<const TerrainDetection>(*terrain);
    return {};
  };
  return {std::move(info), get, set};
}

Rows TerrainRows() {
  Rows rows;
  rows.push_back(
      Numbers({.key = "block_size_m",
               .flag = "--block-size",
               .group = kObject,
               .title = "Block's length, width",
               .help = "Length and width of a block's top in millimetres; default: 397,390",
               .unit = "mm",
               .units_per_si = kMillimetres,
               .low = 50.0,
               .high = 2000.0,
               .count = 2},
              FORESIGHT_AT(FitTerrainOptions, block_size_m)));
  rows.push_back(Tilt("max_tilt_rad", "--max-tilt-deg", "Tilt to", "How far a surface may tilt",
                      68.7, FORESIGHT_AT(FitTerrainOptions, max_tilt_rad)));
  rows.push_back(Number({.key = "toehold_margin_m",
                         .flag = "--toehold-margin-mm",
                         .group = kObject,
                         .title = "Margin at edges",
                         .help = "Kept free from each side of a block",
                         .unit = "mm",
                         .units_per_si = kMillimetres,
                         .low = 0.0,
                         .high = 1000.0},
                        FORESIGHT_AT(FitTerrainOptions, toehold_margin_m)));
  rows.push_back(Switch({.key = "graph_cut",
                         .flag = "--graph-cut",
                         .group = kSearch,
                         .title = "Graph cut",
                         .help = "Borders between surfaces by a graph cut"},
                        FORESIGHT_AT(FitTerrainOptions, graph_cut)));
  rows.push_back(Switch({.key = "place_together",
                         .flag = "--place-together",
                         .group = kSearch,
                         .title = "Place together",
                         .help = "Blocks that stand in rows are placed together"},
                        FORESIGHT_AT(FitTerrainOptions, place_together)));
  rows.push_back(Up(FORESIGHT_AT(FitTerrainOptions, up)));
  rows.push_back(LastTerrain());
  rows.push_back(MaxRays(FORESIGHT_AT(FitTerrainOptions, max_rays)));
  rows.push_back(SeedOption<FitOptions>(FORESIGHT_AT(FitTerrainOptions, seed)));
  return rows;
}

Rows HandleRows() {
  const auto length = [](const char* key, const char* flag, const char* title, const char* help,
                         auto at) {
    return Number({.key = key,
                   .flag = flag,
                   .group = kObject,
                   .title = title,
                   .help = help,
                   .unit = "mm",
                   .units_per_si = kMillimetres,
                   .low = 20.0,
                   .high = 999.0},
                  at);
  };
  Rows rows;
  rows.push_back(length("min_length_m", "--min-length-mm", "Length from",
                        "Shortest lever, from the pivot's axis to its end",
                        FORESIGHT_AT(FitHandleOptions, min_length_m)));
  rows.push_back(length("max_length_m", "--max-length-mm", "Length to",
                        "Longest lever, from the pivot's axis to its end",
                        FORESIGHT_AT(FitHandleOptions, max_length_m)));
  rows.push_back(Integer({.key = "pair_trials",
                          .flag = "--pair-trials",
                          .group = kSearch,
                          .title = "Bars tried",
                          .help = "Bars through two points that are tried",
                          .low = 1,
                          .high = 1e5},
                         FORESIGHT_AT(FitHandleOptions, pair_trials)));
  rows.push_back(MaxRays(FORESIGHT_AT(FitHandleOptions, max_rays)));
  rows.push_back(SeedOption<FitOptions>(FORESIGHT_AT(FitHandleOptions, seed)));
  return rows;
}

/// Least and largest, as one option.
Row CylinderRadii() {
  OptionInfo info{.key = "radius_m",
                  .flag = "--radius-mm",
                  .group = kObject,
                  .title = "Radius from, to",
                  .help = "Least and largest radius in millimetres; default: 10,600",
                  .type = OptionType::kNumbers,
                  .unit = "mm",
                  .units_per_si = kMillimetres,
                  .low = 2.0,
                  .high = 10000.0,
                  .count = 2};
  const auto get = [](const FitOptions& options) -> OptionValue {
    const auto& held = std::get<FitCylinderOptions>(options);
    return std::vector<double>{held.min_radius_m, held.max_radius_m};
  };
  const auto set = [](FitOptions& options, const OptionValue& value) -> Status {
    const auto& numbers = std::get<std::vector<double>>(value);
    auto& held = std::get<FitCylinderOptions>(options);
    held.min_radius_m = numbers[0];
    held.max_radius_m = numbers[1];
    return {};
  };
  return {std::move(info), get, set};
}

Rows CylinderRows() {
  Rows rows;
  rows.push_back(CylinderRadii());
  rows.push_back(Up(FORESIGHT_AT(FitCylinderOptions, up)));
  rows.push_back(MaxRays(FORESIGHT_AT(FitCylinderOptions, max_rays)));
  rows.push_back(SeedOption<FitOptions>(FORESIGHT_AT(FitCylinderOptions, seed)));
  return rows;
}

#undef FORESIGHT_AT

FitOptions DefaultsOf(ObjectKind kind) {
  return FitOptionsFor(kind, Rigid<frame::Robot, frame::Base>());
}

}  // namespace

OptionTable<FitOptions> FitOptionTable(ObjectKind kind) {
  static const Rows kValve = ValveRows(), kDrill = DrillRows(), kTerrain = TerrainRows(),
                    kHandle = HandleRows(), kCylinder = CylinderRows();
  switch (kind) {
    case ObjectKind::kValve:
      return kValve;
    case ObjectKind::kDrill:
      return kDrill;
    case ObjectKind::kHandle:
      return kHandle;
    case ObjectKind::kCylinder:
      return kCylinder;
    case ObjectKind::kTerrain:
      break;
  }
  return kTerrain;
}

ObjectKind ObjectKindOf(const FitOptions& options) {
  return kObjectKinds[options.index()];
}

std::string FitOptionsToJson(const FitOptions& options) {
  return OptionsToJson(FitOptionTable(ObjectKindOf(options)), options);
}

Result<FitOptions> FitOptionsFromJson(ObjectKind kind, const std::string& json) {
  FitOptions options = DefaultsOf(kind);
  const Status set =
      OptionsFromJson(FitOptionTable(kind), json, options).and_then([&options]() -> Status {
        return std::visit([](const auto& held) { return held.Check(); }, options);
      });
  if (!set) return Fail(ErrorCode::kBadData, "options of the fit: {}", set.error().message);
  return options;
}

}  // namespace foresight
