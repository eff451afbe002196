#include "core/fitting/verdict_model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/contract.h"
#include "core/base/embedded_files.h"
#include "core/fitting/gate.h"
#include "core/fitting/ray_set.h"
#include "core/io/yaml_reader.h"

namespace foresight {

std::span<const EmbeddedFile> VerdictFiles();  // resources/verdicts, made by CMake

namespace {

constexpr int kFormatVersion = 1;
constexpr double kFarthest = 4.0;  // deviations

using Models = std::map<std::pair<std::string, VerdictSource>, VerdictModel>;

Models LoadModels() {
  Models models;
  for (const EmbeddedFile& file : VerdictFiles()) {
    auto model = VerdictModelFromYaml(std::string(file.text), std::string(file.name));
    FORESIGHT_EXPECTS(model.has_value(), "a shipped verdict model can be read");
    const std::pair key(model->object, model->source);
    models.emplace(key, std::move(*model));
  }
  return models;
}

VerdictModel ModelFrom(YamlMap& map) {
  if (map.Integer("foresight_verdict") != kFormatVersion)
    map.Fault(map.Node("foresight_verdict"), "this version cannot be read");
  VerdictModel model;
  model.object = map.Text("object");
  const std::string source = map.Text("source");
  const auto known = VerdictSourceFromString(source);
  if (!known)
    map.Fault(map.Node("source"), "source '" + source + "' is none of raw, cloud, dense and alone");
  model.source = known.value_or(VerdictSource::kRaw);
  model.population = map.Text("population");
  model.fits = map.Integer("fits");
  model.right = map.Integer("right");
  model.auc = map.Number("auc");
  model.ece = map.Number("ece");
  model.bias = map.Number("bias");
  for (YamlMap& entry : map.List("features")) {
    VerdictModel::Feature feature;
    feature.name = entry.Text("name");
    feature.mean = entry.Number("mean");
    feature.deviation = entry.Number("deviation");
    feature.weight = entry.Number("weight");
    if (!(feature.deviation > 0.0)) entry.Fault("'deviation' is not positive");
    entry.Finish();
    model.features.push_back(feature);
  }
  if (model.features.empty()) map.Fault("there are no features");
  if (map.Has("pairs"))
    model.pairs = map.Numbers("pairs", VerdictModel::PairsOf(model.features.size()));
  return model;
}

}  // namespace

const char* ToString(VerdictSource source) {
  switch (source) {
    case VerdictSource::kRaw:
      return "raw";
    case VerdictSource::kDense:
      return "dense";
    case VerdictSource::kCloud:
      return "cloud";
    case VerdictSource::kAlone:
      return "alone";
  }
  return "raw";
}

std::optional<VerdictSource> VerdictSourceFromString(std::string_view name) {
  for (const VerdictSource source :
       {VerdictSource::kRaw, VerdictSource::kCloud, VerdictSource::kDense, VerdictSource::kAlone})
    if (name == ToString(source)) return source;
  return std::nullopt;
}

VerdictSource VerdictSourceOf(const RaySet& rays) {
  if (!rays.dense) return rays.image ? VerdictSource::kRaw : VerdictSource::kCloud;
  return rays.beams ? VerdictSource::kDense : VerdictSource::kAlone;
}

std::vector<double> VerdictModel::Standardised(std::span<const double> values) const {
  FORESIGHT_EXPECTS(values.size() == features.size(), "as many values as the model has features");
  std::vector<double> z;
  for (std::size_t i = 0; i < values.size(); ++i)
    z.push_back(std::isfinite(values[i])
                    ? std::clamp((values[i] - features[i].mean) / features[i].deviation, -kFarthest,
                                 kFarthest)
                    : std::nan(""));
  return z;
}

std::vector<double> VerdictModel::Contributions(std::span<const double> values) const {
  const std::vector<double> z = Standardised(values);
  std::vector<double> contributions;
  for (std::size_t i = 0; i < z.size(); ++i) contributions.push_back(features[i].weight * z[i]);
  std::size_t pair = 0;
  for (std::size_t i = 0; i < z.size() && !pairs.empty(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double both = pairs[pair++] * z[i] * z[j];
      contributions[i] += both;
      if (j < i) contributions[j] += both;
    }
  return contributions;
}

double VerdictModel::Probability(std::span<const double> values) const {
  const std::vector<double> z = Standardised(values);
  double sum = bias;
  std::size_t pair = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) return 0.0;
    sum += features[i].weight * z[i];
    for (std::size_t j = 0; j <= i && !pairs.empty(); ++j) sum += pairs[pair++] * z[i] * z[j];
  }
  return 1.0 / (1.0 + std::exp(-sum));
}

std::string VerdictModel::Reservation() const {
  const Gate gate{.what = "{} such answers were tried",
                  .number = static_cast<double>(fits),
                  .limit = static_cast<double>(kLeastFits),
                  .advice = "nobody knows yet how often one is right"};
  return gate.Failed() ? gate.Sentence() : std::string();
}

void VerdictModel::AddReservation(std::vector<std::string>& failed_gates) const {
  if (std::string reservation = Reservation(); !reservation.empty())
    failed_gates.push_back(std::move(reservation));
}

std::string VerdictModel::ToYaml() const {
  std::string yaml = fmt::format(
      "# Made by `foresightctl verdict fit`, docs/verdicts.md; not by hand.\n"
      "foresight_verdict: {}\nobject: {}\nsource: {}\npopulation: \"{}\"\n"
      "fits: {}\nright: {}\nauc: {:.4f}\nece: {:.4f}\nbias: {:.6g}\nfeatures:\n",
      kFormatVersion, object, ToString(source), population, fits, right, auc, ece, bias);
  for (const Feature& feature : features)
    yaml += fmt::format("  - {{name: {}, mean: {:.6g}, deviation: {:.6g}, weight: {:.6g}}}\n",
                        feature.name, feature.mean, feature.deviation, feature.weight);
  if (pairs.empty()) return yaml;
  yaml += "pairs: [\n";
  std::size_t pair = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    yaml += "  ";
    for (std::size_t j = 0; j <= i; ++j) yaml += fmt::format("{:.6g}, ", pairs[pair++]);
    yaml += fmt::format(" # {}\n", features[i].name);
  }
  return yaml + "]\n";
}

Result<VerdictModel> VerdictModelFromYaml(const std::string& yaml, const std::string& source) {
  VerdictModel model;
  FORESIGHT_CHECK(ParseYaml(yaml, source, [&model](YamlMap& map) {
    model = ModelFrom(map);
    map.Finish();
  }));
  return model;
}

const VerdictModel* FindVerdictModel(std::string_view object, VerdictSource source) {
  static const Models models = LoadModels();
  auto found = models.find({std::string(object), source});
  if (found == models.end() && source == VerdictSource::kCloud)
    found = models.find({std::string(object), VerdictSource::kRaw});
  return found == models.end() ? nullptr : &found->second;
}

const VerdictModel& ShippedVerdictModel(std::string_view object, VerdictSource source) {
  const VerdictModel* model = FindVerdictModel(object, source);
  FORESIGHT_EXPECTS(model != nullptr, "there is a verdict model for each object and source");
  return *model;
}

}  // namespace foresight
