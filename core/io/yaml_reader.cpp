#include "core/io/yaml_reader.h"

#include <algorithm>
#include <cmath>

#include "core/base/printable.h"

namespace foresight {

YamlMap::YamlMap(YAML::Node node, std::string source)
    : node_(std::move(node)), source_(std::move(source)) {
  if (!node_.IsMap()) Fault("expected a mapping (key: value)");
}

bool YamlMap::Has(const std::string& key) const {
  return node_[key].IsDefined();
}

YAML::Node YamlMap::Node(const std::string& key) {
  known_.insert(key);
  return node_[key];
}

YAML::Node YamlMap::Required(const std::string& key) {
  YAML::Node value = Node(key);
  if (!value.IsDefined() || value.IsNull()) Fault("'" + key + "' is missing");
  return value;
}

double YamlMap::AsNumber(const YAML::Node& node, const std::string& key) const {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
    Fault(node, "'" + key + "' is not a finite number");
  return value;
}

double YamlMap::Number(const std::string& key) {
  return AsNumber(Required(key), key);
}

double YamlMap::Number(const std::string& key, double fallback) {
  return Has(key) ? Number(key) : (known_.insert(key), fallback);
}

int YamlMap::Integer(const std::string& key) {
  const YAML::Node node = Required(key);
  int value = 0;
  if (!node.IsScalar() || !YAML::convert<int>::decode(node, value))
    Fault(node, "'" + key + "' is not a whole number");
  return value;
}

int YamlMap::Integer(const std::string& key, int fallback) {
  return Has(key) ? Integer(key) : (known_.insert(key), fallback);
}

bool YamlMap::Flag(const std::string& key, bool fallback) {
  if (!Has(key)) return known_.insert(key), fallback;
  const YAML::Node node = Required(key);
  bool value = false;
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value))
    Fault(node, "'" + key + "' is neither true nor false");
  return value;
}

std::string YamlMap::Text(const std::string& key) {
  const YAML::Node node = Required(key);
  if (!node.IsScalar()) Fault(node, "'" + key + "' is not a text");
  return node.Scalar();
}

std::string YamlMap::Text(const std::string& key, const std::string& fallback) {
  return Has(key) ? Text(key) : (known_.insert(key), fallback);
}

std::vector<double> YamlMap::Numbers(const std::string& key, std::size_t count) {
  const YAML::Node node = Required(key);
  if (!node.IsSequence() || node.size() != count)
    Fault(node, "'" + key + "' is not a list of " + std::to_string(count) + " numbers");
  std::vector<double> values;
  for (const YAML::Node& entry : node) values.push_back(AsNumber(entry, key));
  return values;
}

Eigen::Vector3d YamlMap::Vector(const std::string& key) {
  const std::vector<double> values = Numbers(key, 3);
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d YamlMap::Vector(const std::string& key, const Eigen::Vector3d& fallback) {
  return Has(key) ? Vector(key) : (known_.insert(key), fallback);
}

YamlMap YamlMap::Map(const std::string& key) {
  return {Required(key), source_};
}

std::vector<YamlMap> YamlMap::List(const std::string& key) {
  std::vector<YamlMap> entries;
  const YAML::Node node = Node(key);
  if (!node.IsDefined()) return entries;
  if (!node.IsSequence()) Fault(node, "'" + key + "' is not a list");
  for (const YAML::Node& entry : node) entries.emplace_back(entry, source_);
  return entries;
}

void YamlMap::Finish() const {
  for (const auto& entry : node_) {
    const std::string key = entry.first.Scalar();
    if (!known_.contains(key)) Fault(entry.first, "'" + key + "' is not known here");
  }
}

void YamlMap::Fault(const std::string& what) const {
  Fault(node_, what);
}

void YamlMap::Fault(const YAML::Node& at, const std::string& what) const {
  const int line = at.IsDefined() ? std::max(1, at.Mark().line + 1) : 1;  // an empty file has none
  throw YamlFault(source_ + ":" + std::to_string(line) + ": " + what);
}

Status ParseYaml(const std::string& text, const std::string& source,
                 const std::function<void(YamlMap&)>& body) {
  if (const std::size_t at = FirstInvalidUtf8(text); at != std::string::npos)
    return Fail(ErrorCode::kBadData, "{}:{}: byte {:#04x} is no UTF-8", source,
                1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'),
                static_cast<unsigned char>(text[at]));
  try {
    YamlMap map(YAML::Load(text), source);
    body(map);
    return {};
  } catch (const YamlFault& fault) {
    return Fail(ErrorCode::kBadData, "{}", fault.what());
  } catch (const YAML::Exception& error) {
    return Fail(ErrorCode::kBadData, "{}:{}: {}", source, error.mark.line + 1, error.msg);
  }
}

}  // namespace foresight
