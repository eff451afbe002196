// Reads every #include of the project and fails on a breach of the rules in docs/architecture.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
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

bool IsSocket(const std::string& target) {
  return StartsWithAny(target, {"sys/socket", "netinet/", "modbus", "arv"});
}

bool IsHeavy(const std::string& target) {
  return StartsWithAny(
      target, {"pcl/", "ceres/", "embree", "sqlite3", "opencv2/imgproc", "nlohmann/json.hpp"});
}

bool IsRos(const std::string& target) {
  return StartsWithAny(target, {"ros/", "rosbag/", "sensor_msgs/", "geometry_msgs/", "tf2_msgs/"});
}

bool IsAravis(const std::string& target) {
  return StartsWithAny(target, {"arv", "glib", "gio/"});
}

const std::vector<std::string> kCoreOrder = {"base",
                                             "geometry",
                                             "io",
                                             "options",
                                             "sensor",
                                             "objects",
                                             "simulation",
                                             "registration",
                                             "calibration",
                                             "depth",
                                             "fitting",
                                             "fitting/solids",
                                             "fitting/valve",
                                             "fitting/drill",
                                             "fitting/terrain",
                                             "fitting/cylinder",
                                             "fitting/handle",
                                             "detection",
                                             "selfcheck",
                                             "measure",
                                             "evaluation",
                                             "mission",
                                             "pictures",
                                             "report",
                                             "exchange",
                                             "mapping"};

std::ptrdiff_t CorePlace(const std::string& folder) {
  const std::string name = folder.substr(folder.find('/') + 1);
  const auto at = std::find(kCoreOrder.begin(), kCoreOrder.end(), name);
  return at == kCoreOrder.end() ? -1 : at - kCoreOrder.begin();
}

const std::vector<Include>& Includes() {
  static const std::vector<Include> kIncludes = AllIncludes();
  return kIncludes;
}

/// What a rule says of an include: nothing (the rule is not about it), "" (it is allowed), or why
/// it is a breach.
using Opinion = std::optional<std::string>;

Opinion BreachIf(bool breach, const char* why) {
  return breach ? why : "";
}

/// Fails the test for every include that breaks the rule, and for a rule that is about no include
/// at all: a folder that was renamed would never break it.
template <class Rule>
void ExpectNoBreach(const Rule& rule) {
  int judged = 0;
  for (const Include& include : Includes()) {
    const Opinion opinion = rule(include);
    if (!opinion) continue;
    ++judged;
    if (!opinion->empty())
      ADD_FAILURE() << include.file << " includes " << include.target << ": " << *opinion;
  }
  EXPECT_GT(judged, 0) << "the rule is about no include of the project";
}

TEST(IncludeRules, CoreFoldersIncludeOnlyFoldersListedAboveThem) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "core/") || !IsOurs(include.target)) return std::nullopt;
    if (!StartsWith(include.target, "core/")) return "core includes nothing outside core";
    const auto from = CorePlace(FolderOf(include.file));
    const auto to = CorePlace(FolderOf(include.target));
    if (from < 0 || to < 0) return "a core folder that has no place in the order";
    return BreachIf(to > from, "data flows the other way");
  });
}

TEST(IncludeRules, EveryFolderOfTheOrderOfCoreExists) {
  for (const std::string& folder : kCoreOrder)
    EXPECT_TRUE(std::any_of(Includes().begin(), Includes().end(), [&](const Include& include) {
      return FolderOf(include.file) == "core/" + folder;
    })) << folder;
}

TEST(IncludeRules, CoreAndHardwareKnowNeitherQtNorVtk) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWithAny(include.file, {"core/", "hardware/"})) return std::nullopt;
    // ADR 0018: what is written for other programs uses VTK's writers.
    const bool exchange = StartsWith(include.file, "core/exchange/") && !include.header;
    return BreachIf(IsQt(include.target) || (IsVtk(include.target) && !exchange),
                    "only ui and app/workstation know these");
  });
}

TEST(IncludeRules, TwoFilesKnowRosAndTheirHeadersKnowNothingOfOurs) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (include.file == "core/exchange/bag_file.h" || include.file == "core/exchange/bag_check.h")
      return BreachIf(IsOurs(include.target), "it is read as C++17 too");
    if (!IsRos(include.target)) return std::nullopt;
    return BreachIf(include.file != "core/exchange/bag_file.cpp" &&
                        include.file != "core/exchange/bag_check.cpp",
                    "only those files are C++17");
  });
}

TEST(IncludeRules, CoreOpensNoSockets) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "core/")) return std::nullopt;
    return BreachIf(IsSocket(include.target), "devices live in hardware");
  });
}

TEST(IncludeRules, HeavyLibrariesStayOutOfHeaders) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!include.header || !StartsWithAny(include.file, {"core/", "hardware/"}))
      return std::nullopt;
    return BreachIf(IsHeavy(include.target), "belongs into a .cpp");
  });
}

TEST(IncludeRules, DeviceInterfacesKnowOnlyValuesOfTheSensors) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/api/") || !IsOurs(include.target)) return std::nullopt;
    return BreachIf(!StartsWithAny(include.target, {"hardware/api/", "core/base/", "core/geometry/",
                                                    "core/objects/", "core/sensor/"}),
                    "too much for an interface");
  });
}

TEST(IncludeRules, TheHeadKnowsNoConcreteDevice) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/head/") || !IsOurs(include.target)) return std::nullopt;
    return BreachIf(!StartsWithAny(include.target, {"hardware/api/", "hardware/head/", "core/"}),
                    "drivers are composed in app");
  });
}

TEST(IncludeRules, TheLinkKnowsNoConcreteDevice) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/link/") || !IsOurs(include.target)) return std::nullopt;
    return BreachIf(!StartsWithAny(include.target, {"hardware/api/", "hardware/head/",
                                                    "hardware/link/", "hardware/net/", "core/"}),
                    "a link carries any head");
  });
}

TEST(IncludeRules, ChunksKeysAndPosesKnowNoTransport) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWithAny(include.file,
                       {"hardware/link/chunks/", "hardware/link/pki/", "hardware/link/robot/"}))
      return std::nullopt;
    if (StartsWith(include.target, "hardware/link/"))
      return BreachIf(FolderOf(include.target) != FolderOf(include.file), "stands alone");
    return BreachIf(
        StartsWith(include.target, "grpc") || include.target.find(".pb.h") != std::string::npos,
        "gRPC is for the server and the client");
  });
}

/// Files of a protocol that only turn messages into bytes and back: driver and emulator share them.
bool IsCodec(const std::string& target) {
  return StartsWithAny(target, {"hardware/scip/scip_codec", "hardware/scip/scip_encoding",
                                "hardware/scip/scip_parser", "hardware/scip/scip_request",
                                "hardware/scip/scip_status", "hardware/motor/cia402"});
}

TEST(IncludeRules, DriversKnowTheirInterfacesAndTheSensorsValuesOnly) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWithAny(include.file, {"hardware/scip/", "hardware/motor/", "hardware/gige/"}))
      return std::nullopt;
    if (!IsOurs(include.target)) return std::nullopt;
    return BreachIf(!StartsWithAny(include.target,
                                   {FolderOf(include.file) + "/", "hardware/net/", "hardware/api/",
                                    "core/base/", "core/geometry/", "core/sensor/"}),
                    "a driver works without the rest of the project");
  });
}

TEST(IncludeRules, AravisIsKnownInOnePlace) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    const std::string handle = "hardware/gige/aravis_handle.h";
    if (include.target == handle)
      return BreachIf(include.header || FolderOf(include.file) != "hardware/gige",
                      "belongs into a driver's .cpp");
    return BreachIf(IsAravis(include.target) && include.file != handle,
                    "goes through aravis_handle.h");
  });
}

TEST(IncludeRules, AvahiIsKnownInOnePlace) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    const std::string connection = "hardware/link/discovery/avahi_connection.h";
    if (include.target != connection && !StartsWith(include.target, "avahi-")) return std::nullopt;
    return BreachIf(FolderOf(include.file) != "hardware/link/discovery" ||
                        (include.header && include.file != connection),
                    "goes through HeadBrowser and HeadAnnouncement");
  });
}

TEST(IncludeRules, KeysOfTheLinkKnowNoTransport) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/link/pki/")) return std::nullopt;
    if (StartsWithAny(include.target, {"grpc", "google/"})) return "hardware/link/wire knows gRPC";
    if (!IsOurs(include.target)) return std::nullopt;
    return BreachIf(!StartsWithAny(include.target, {"hardware/link/pki/", "core/base/"}),
                    "keys are files and certificates, nothing else");
  });
}

TEST(IncludeRules, OpenSslIsKnownWhereHashesKeysAndSealsAre) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    const std::string handles = "hardware/link/pki/openssl_handles.h";
    if (include.target == handles)
      return BreachIf(include.header || (FolderOf(include.file) != "hardware/link/pki" &&
                                         include.file != "hardware/link/burst/sealed_datagram.cpp"),
                      "belongs into a .cpp of the keys, or into the one that seals datagrams");
    if (!StartsWith(include.target, "openssl/")) return std::nullopt;
    return BreachIf(include.file != handles &&
                        (include.header || (include.file != "core/base/sha256.cpp" &&
                                            FolderOf(include.file) != "hardware/link/pki")),
                    "goes through core/base/sha256.h or hardware/link/pki/");
  });
}

TEST(IncludeRules, CodecsOfTheLidarKnowNoSockets) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!IsCodec(include.file) || !StartsWith(include.file, "hardware/scip/")) return std::nullopt;
    return BreachIf(IsOurs(include.target) && !IsCodec(include.target) &&
                        !StartsWith(include.target, "core/base/"),
                    "bytes and messages, nothing else");
  });
}

TEST(IncludeRules, EmulatorsKnowNoDrivers) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/emulator/") || !IsOurs(include.target))
      return std::nullopt;
    if (StartsWithAny(include.target, {"hardware/scip/", "hardware/motor/", "hardware/gige/"}))
      return BreachIf(!IsCodec(include.target), "a driver would be tested against itself");
    return BreachIf(
        !StartsWithAny(include.target, {"hardware/emulator/", "hardware/net/", "hardware/api/",
                                        "hardware/simulated/simulated_clock.h",
                                        "hardware/simulated/simulated_shaft.h",
                                        "hardware/simulated/motion_profile.h", "core/"}),
        "an emulator is a codec before a simulated world");
  });
}

TEST(IncludeRules, SocketsKnowNoDevices) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/net/") || !IsOurs(include.target)) return std::nullopt;
    return BreachIf(!StartsWithAny(include.target, {"hardware/net/", "core/base/"}),
                    "devices use sockets");
  });
}

TEST(IncludeRules, AnAssembledHeadKnowsNoEmulators) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/assembly/")) return std::nullopt;
    return BreachIf(StartsWithAny(include.target, {"hardware/emulator/", "hardware/simulated/"}),
                    "a real head runs without a simulation");
  });
}

TEST(IncludeRules, ChunksOfTheLinkKnowNoTransport) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/link/chunks/")) return std::nullopt;
    if (StartsWith(include.target, "grpc") || IsSocket(include.target))
      return "bytes and files only";
    if (!IsOurs(include.target)) return "";
    return BreachIf(
        !StartsWithAny(include.target, {"hardware/link/chunks/", "hardware/api/", "core/"}),
        "another path may carry them");
  });
}

TEST(IncludeRules, OnlyAppsKnowAssembledHeads) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (StartsWithAny(include.file, {"app/", "hardware/assembly/"})) return std::nullopt;
    return BreachIf(StartsWith(include.target, "hardware/assembly/"),
                    "composing is the apps' affair");
  });
}

TEST(IncludeRules, HardwareKnowsNoUserInterface) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "hardware/")) return std::nullopt;
    return BreachIf(StartsWithAny(include.target, {"ui/", "app/"}), "the other way round");
  });
}

TEST(IncludeRules, ViewModelsHaveNoWidgets) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "ui/viewmodels/")) return std::nullopt;
    if (IsQtWidgets(include.target) || IsVtk(include.target))
      return "a view-model is tested without a window";
    if (!IsOurs(include.target)) return "";
    return BreachIf(!StartsWithAny(include.target,
                                   {"core/", "hardware/api/", "hardware/head/", "ui/viewmodels/"}),
                    "too concrete");
  });
}

TEST(IncludeRules, SharedWidgetsKnowNothingOfOurs) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "ui/widgets/") || !IsOurs(include.target)) return std::nullopt;
    return BreachIf(!StartsWith(include.target, "ui/widgets/"), "views and panels use it");
  });
}

TEST(IncludeRules, PanelsKnowNeitherVtkNorAlgorithms) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWith(include.file, "ui/panels/")) return std::nullopt;
    if (IsVtk(include.target)) return "VTK lives in render and views";
    if (!IsOurs(include.target)) return std::nullopt;
    return BreachIf(
        StartsWithAny(include.target,
                      {"core/depth/", "core/fitting/", "core/registration/", "core/simulation/",
                       "core/evaluation/", "hardware/", "app/", "ui/render/", "ui/views/"}) &&
            !StartsWith(include.target, "hardware/api/"),
        "goes through a view-model");
  });
}

TEST(IncludeRules, ViewsAndRenderKnowNoHardware) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWithAny(include.file, {"ui/render/", "ui/views/"})) return std::nullopt;
    return BreachIf(StartsWith(include.target, "hardware/"), "goes through a view-model");
  });
}

TEST(IncludeRules, NobodyIncludesAnApp) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (StartsWith(include.file, "app/")) return std::nullopt;
    return BreachIf(StartsWith(include.target, "app/"), "apps are the ends of the graph");
  });
}

TEST(IncludeRules, ProgramsWithoutAWindowNeedNoGui) {
  ExpectNoBreach([](const Include& include) -> Opinion {
    if (!StartsWithAny(include.file, {"app/common/", "app/ctl/", "app/head/"})) return std::nullopt;
    return BreachIf(
        IsQt(include.target) || IsVtk(include.target) || StartsWith(include.target, "ui/"),
        "runs without Qt");
  });
}

TEST(IncludeRules, EveryPathThatARuleNamesExists) {
  // A rule about "core/fitting/fit_" allowed everything once fits had folders of their own.
  static const std::regex kPath(R"re("((core|hardware|ui|app)/[a-z0-9_./]*)")re");
  const fs::path root = FORESIGHT_SOURCE_DIR;
  std::ifstream stream(root / "tests/architecture/include_rules_test.cpp");
  int named = 0;
  std::smatch match;
  for (std::string line; std::getline(stream, line);)
    for (std::string rest = line; std::regex_search(rest, match, kPath); rest = match.suffix()) {
      if (line.find("//") != std::string::npos) continue;
      ++named;
      const std::string path = match[1];
      const bool exists =
          std::any_of(Includes().begin(), Includes().end(), [&](const Include& include) {
            return StartsWith(include.file, path) || StartsWith(include.target, path);
          });
      EXPECT_TRUE(exists) << "no file begins with " << path;
    }
  EXPECT_GT(named, 40) << "the rules were not found";
}

TEST(IncludeRules, EveryKindOfLibraryThatARuleNamesIsUsed) {
  const auto used = [](const auto& is_of_kind) {
    return std::any_of(Includes().begin(), Includes().end(),
                       [&](const Include& include) { return is_of_kind(include.target); });
  };
  EXPECT_TRUE(used(IsQt));
  EXPECT_TRUE(used(IsQtWidgets));
  EXPECT_TRUE(used(IsVtk));
  EXPECT_TRUE(used(IsSocket));
  EXPECT_TRUE(used(IsHeavy));
  EXPECT_TRUE(used(IsAravis));
  EXPECT_TRUE(used(IsRos));
}

}  // namespace
}  // namespace foresight
