// Reads every #include of the project and fails on a breach of the rules in docs/architecture.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace foresight {
namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;    ///< including file, from the project's root
  std::string target;  ///< as written
  bool header;         ///< the including file is a header
};

std::vector<Include> AllIncludes() {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  const fs::path root = FORESIGHT_SOURCE_DIR;
  for (const char* top : {"core", "hardware", "ui", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream stream(entry.path());
      std::smatch match;
      for (std::string line; std::getline(stream, line);)
        if (std::regex_search(line, match, kInclude))
          includes.push_back(
              {fs::relative(entry.path(), root).string(), match[1], extension == ".h"});
    }
  return includes;
}

bool StartsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

bool StartsWithAny(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const auto& prefix) { return StartsWith(text, prefix); });
}

/// "core/depth/pipeline.h" -> "core/depth".
std::string FolderOf(const std::string& path) {
  return fs::path(path).parent_path().generic_string();
}

bool IsOurs(const std::string& target) {
  return StartsWithAny(target, {"core/", "hardware/", "ui/", "app/", "tests/"});
}

bool IsQt(const std::string& target) {
  static const std::regex kQt("^Q[A-Z].*|^Qt[A-Z].*|^qtadvanceddocking/.*");
  return std::regex_match(target, kQt);
}

bool IsQtWidgets(const std::string& target) {
  static const std::regex kWidgets(
      "^Q(Widget|MainWindow|Label|PushButton|ToolButton|Dialog|Dock|Menu|Action|Slider|SpinBox|"
      "DoubleSpinBox|"
      "ComboBox|CheckBox|Graphics|Layout|[A-Z]BoxLayout|FormLayout|GridLayout|StatusBar|ToolBar|"
      "ListWidget|"
      "TreeWidget|Application|MessageBox|FileDialog|Progress).*|^QtWidgets.*");
  return std::regex_match(target, kWidgets);
}

bool IsVtk(const std::string& target) {
  return StartsWithAny(target, {"vtk", "QVTK"});
}

const std::vector<std::string> kCoreOrder = {"base",
                                             "geometry",
                                             "io",
                                             "options",
                                             "sensor",
                                             "objects",
                                             "simulation",
                                             "registration",
                                             "depth",
                                             "fitting",
                                             "fitting/valve",
                                             "fitting/drill",
                                             "fitting/terrain",
                                             "fitting/cylinder",
                                             "detection",
                                             "evaluation",
                                             "mission",
                                             "pictures",
                                             "report"};

std::ptrdiff_t CorePlace(const std::string& folder) {
  const std::string name = folder.substr(folder.find('/') + 1);
  const auto at = std::find(kCoreOrder.begin(), kCoreOrder.end(), name);
  return at == kCoreOrder.end() ? -1 : at - kCoreOrder.begin();
}

/// Fails the test for every include for which `breach` says why it is one.
template <class Breach>
void ExpectNoBreach(const Breach& breach) {
  int checked = 0;
  for (const Include& include : AllIncludes()) {
    ++checked;
    const std::string why = breach(include);
    if (!why.empty())
      ADD_FAILURE() << include.file << " includes " << include.target << ": " << why;
  }
  EXPECT_GT(checked, 100) << "the sources were not found";
}

TEST(IncludeRules, CoreFoldersIncludeOnlyFoldersListedAboveThem) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "core/") || !IsOurs(include.target)) return "";
    if (!StartsWith(include.target, "core/")) return "core includes nothing outside core";
    const auto from = CorePlace(FolderOf(include.file));
    const auto to = CorePlace(FolderOf(include.target));
    if (from < 0 || to < 0) return "a core folder that has no place in the order";
    return to > from ? "data flows the other way" : "";
  });
}

TEST(IncludeRules, CoreAndHardwareKnowNeitherQtNorVtk) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWithAny(include.file, {"core/", "hardware/"})) return "";
    return IsQt(include.target) || IsVtk(include.target) ? "only ui and app/workstation know these"
                                                         : "";
  });
}

TEST(IncludeRules, CoreOpensNoSockets) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "core/")) return "";
    return StartsWithAny(include.target, {"sys/socket", "netinet/", "grpc", "modbus", "arv"})
               ? "devices live in hardware"
               : "";
  });
}

TEST(IncludeRules, HeavyLibrariesStayOutOfHeaders) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!include.header || !StartsWithAny(include.file, {"core/", "hardware/"})) return "";
    const bool heavy = StartsWithAny(include.target, {"pcl/", "ceres/", "embree", "sqlite3",
                                                      "opencv2/imgproc", "nlohmann/json.hpp"});
    return heavy ? "belongs into a .cpp" : "";
  });
}

TEST(IncludeRules, DeviceInterfacesKnowOnlyValuesOfTheSensors) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "hardware/api/") || !IsOurs(include.target)) return "";
    return StartsWithAny(include.target, {"hardware/api/", "core/base/", "core/sensor/"})
               ? ""
               : "too much for an interface";
  });
}

TEST(IncludeRules, TheHeadKnowsNoConcreteDevice) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "hardware/head/") || !IsOurs(include.target)) return "";
    return StartsWithAny(include.target, {"hardware/api/", "hardware/head/", "core/"})
               ? ""
               : "drivers are composed in app";
  });
}

/// Files of a protocol that only turn messages into bytes and back: driver and emulator share them.
bool IsCodec(const std::string& target) {
  return StartsWithAny(target, {"hardware/scip/scip_codec", "hardware/scip/scip_encoding",
                                "hardware/scip/scip_parser", "hardware/scip/scip_request",
                                "hardware/scip/scip_status", "hardware/motor/cia402"});
}

TEST(IncludeRules, DriversKnowTheirInterfacesAndTheSensorsValuesOnly) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWithAny(include.file, {"hardware/scip/", "hardware/motor/", "hardware/gige/"}))
      return "";
    if (!IsOurs(include.target)) return "";
    return StartsWithAny(include.target,
                         {FolderOf(include.file) + "/", "hardware/net/", "hardware/api/",
                          "core/base/", "core/geometry/", "core/sensor/"})
               ? ""
               : "a driver works without the rest of the project";
  });
}

TEST(IncludeRules, AravisIsKnownInOnePlace) {
  ExpectNoBreach([](const Include& include) -> std::string {
    const std::string handle = "hardware/gige/aravis_handle.h";
    if (include.target == handle)
      return include.header || FolderOf(include.file) != "hardware/gige"
                 ? "belongs into a driver's .cpp"
                 : "";
    const bool aravis = StartsWithAny(include.target, {"arv", "glib", "gio/"});
    return aravis && include.file != handle ? "goes through aravis_handle.h" : "";
  });
}

TEST(IncludeRules, CodecsOfTheLidarKnowNoSockets) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!IsCodec(include.file) || !StartsWith(include.file, "hardware/scip/")) return "";
    return !IsOurs(include.target) || IsCodec(include.target) ||
                   StartsWith(include.target, "core/base/")
               ? ""
               : "bytes and messages, nothing else";
  });
}

TEST(IncludeRules, EmulatorsKnowNoDrivers) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "hardware/emulator/") || !IsOurs(include.target)) return "";
    if (StartsWithAny(include.target, {"hardware/scip/", "hardware/motor/", "hardware/gige/"}))
      return IsCodec(include.target) ? "" : "a driver would be tested against itself";
    return StartsWithAny(include.target, {"hardware/emulator/", "hardware/net/", "hardware/api/",
                                          "hardware/simulated/simulated_clock.h",
                                          "hardware/simulated/simulated_shaft.h",
                                          "hardware/simulated/motion_profile.h", "core/"})
               ? ""
               : "an emulator is a codec before a simulated world";
  });
}

TEST(IncludeRules, SocketsKnowNoDevices) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "hardware/net/") || !IsOurs(include.target)) return "";
    return StartsWithAny(include.target, {"hardware/net/", "core/base/"}) ? ""
                                                                          : "devices use sockets";
  });
}

TEST(IncludeRules, AnAssembledHeadKnowsNoEmulators) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "hardware/assembly/")) return "";
    return StartsWithAny(include.target, {"hardware/emulator/", "hardware/simulated/"})
               ? "a real head runs without a simulation"
               : "";
  });
}

TEST(IncludeRules, OnlyAppsKnowAssembledHeads) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (StartsWithAny(include.file, {"app/", "hardware/assembly/"})) return "";
    return StartsWith(include.target, "hardware/assembly/") ? "composing is the apps' affair" : "";
  });
}

TEST(IncludeRules, HardwareKnowsNoUserInterface) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "hardware/")) return "";
    return StartsWithAny(include.target, {"ui/", "app/"}) ? "the other way round" : "";
  });
}

TEST(IncludeRules, ViewModelsHaveNoWidgets) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "ui/viewmodels/")) return "";
    if (IsQtWidgets(include.target) || IsVtk(include.target))
      return "a view-model is tested without a window";
    if (!IsOurs(include.target)) return "";
    return StartsWithAny(include.target,
                         {"core/", "hardware/api/", "hardware/head/", "ui/viewmodels/"})
               ? ""
               : "too concrete";
  });
}

TEST(IncludeRules, SharedWidgetsKnowNothingOfOurs) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "ui/widgets/") || !IsOurs(include.target)) return "";
    return StartsWith(include.target, "ui/widgets/") ? "" : "views and panels use it";
  });
}

TEST(IncludeRules, PanelsKnowNeitherVtkNorAlgorithms) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWith(include.file, "ui/panels/")) return "";
    if (IsVtk(include.target)) return "VTK lives in render and views";
    static const std::array<std::string, 4> kAlgorithms = {
        "core/depth/upsample.h", "core/depth/reject", "core/fitting/fit_", "core/registration/"};
    const bool algorithm =
        std::any_of(kAlgorithms.begin(), kAlgorithms.end(),
                    [&](const auto& prefix) { return StartsWith(include.target, prefix); });
    return algorithm || StartsWith(include.target, "hardware/simulated")
               ? "goes through a view-model"
               : "";
  });
}

TEST(IncludeRules, ViewsAndRenderKnowNoHardware) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWithAny(include.file, {"ui/render/", "ui/views/"})) return "";
    return StartsWith(include.target, "hardware/") ? "goes through a view-model" : "";
  });
}

TEST(IncludeRules, NobodyIncludesAnApp) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (StartsWith(include.file, "app/")) return "";
    return StartsWith(include.target, "app/") ? "apps are the ends of the graph" : "";
  });
}

TEST(IncludeRules, ProgramsWithoutAWindowNeedNoGui) {
  ExpectNoBreach([](const Include& include) -> std::string {
    if (!StartsWithAny(include.file, {"app/common/", "app/ctl/", "app/head/"})) return "";
    return IsQt(include.target) || IsVtk(include.target) || StartsWith(include.target, "ui/")
               ? "runs without Qt"
               : "";
  });
}

}  // namespace
}  // namespace foresight
