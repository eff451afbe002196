#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// Raised inside ParseYaml's body; carries "source:line: what". Never leaves ParseYaml.
class YamlFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One mapping of a YAML file, read key by key. Every fault names the file and the line; Finish()
/// turns keys that nobody asked for into a fault, so a typo is never silently a default.
class YamlMap {
 public:
  YamlMap(YAML::Node node, std::string source);

  bool Has(const std::string& key) const;
  double Number(const std::string& key);
  double Number(const std::string& key, double fallback);
  int Integer(const std::string& key);
  int Integer(const std::string& key, int fallback);
  bool Flag(const std::string& key, bool fallback);
  std::string Text(const std::string& key);
  std::string Text(const std::string& key, const std::string& fallback);
  Eigen::Vector3d Vector(const std::string& key);
  Eigen::Vector3d Vector(const std::string& key, const Eigen::Vector3d& fallback);
  std::vector<double> Numbers(const std::string& key, std::size_t count);
  YamlMap Map(const std::string& key);
  /// The entries of a list of mappings; empty when the key is missing.
  std::vector<YamlMap> List(const std::string& key);
  /// The raw node, for shapes that the above do not cover; marks the key as known.
  YAML::Node Node(const std::string& key);

  void Finish() const;
  [[noreturn]] void Fault(const std::string& what) const;
  [[noreturn]] void Fault(const YAML::Node& at, const std::string& what) const;
  const std::string& source() const { return source_; }

 private:
  YAML::Node Required(const std::string& key);
  double AsNumber(const YAML::Node& node, const std::string& key) const;

  YAML::Node node_;
  std::string source_;
  std::set<std::string> known_;
};

/// Parses `text` and hands its top mapping to `body`; faults and yaml-cpp's exceptions become
/// kBadData, and so does text that is no UTF-8.
Status ParseYaml(const std::string& text, const std::string& source,
                 const std::function<void(YamlMap&)>& body);

}  // namespace foresight
