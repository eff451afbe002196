#include "core/calibration/camera_session.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/atomic_file.h"
#include "core/io/image_file.h"
#include "core/io/yaml_reader.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr int kFormatVersion = 1;
constexpr const char* kFile = "camera_session.yaml";

std::string Quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

std::string TextOf(const std::vector<LensModel>& models) {
  std::string text;
  for (const LensModel model : models) {
    if (!text.empty()) text += ",";
    text += ToString(model);
  }
  return text;
}

template <class T>
T Require(const Result<T>& value, const YamlMap& map) {
  if (!value) map.Fault(value.error().message);
  return *value;
}

/// Images that were copied when the program ended, and not yet listed.
void AddUnlisted(const fs::path& folder, std::vector<CameraSessionImage>& images) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (HasImageExtension(at->path())) names.push_back(at->path().filename().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    const auto is_it = [&](const CameraSessionImage& image) { return image.file == name; };
    if (std::none_of(images.begin(), images.end(), is_it))
      images.push_back({.file = name, .name = name});
  }
}

}  // namespace

bool IsCameraSession(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kFile, error);
}

fs::path CameraSessionImages(const fs::path& folder) {
  return folder / "images";
}

Status SaveCameraSession(const CameraSession& session, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(CameraSessionImages(folder), error);
  if (error)
    return Fail(ErrorCode::kIo, "{}: cannot make the folder: {}", folder.string(), error.message());
  std::string yaml = "# A calibration of a camera that is under way: docs/calibration.md.\n";
  yaml += fmt::format("foresight_camera_session: {}\n", kFormatVersion);
  yaml += fmt::format("board: {}\n", Quoted(ToText(session.board)));
  yaml += fmt::format("models: {}\n", Quoted(TextOf(session.models)));
  yaml += session.images.empty() ? "images: []\n" : "images:\n";
  for (const CameraSessionImage& image : session.images)
    yaml += fmt::format("  - {{file: {}, name: {}, excluded: {}}}\n", Quoted(image.file),
                        Quoted(image.name), image.excluded);
  return WriteFileAtomically(folder / kFile, yaml);
}

Result<CameraSession> LoadCameraSession(const fs::path& folder) {
  constexpr std::size_t kLargest = 16u << 20;
  FORESIGHT_TRY(const std::string text, ReadFile(folder / kFile, kLargest));
  CameraSession session;
  FORESIGHT_CHECK(ParseYaml(text, (folder / kFile).string(), [&](YamlMap& map) {
    if (const int version = map.Integer("foresight_camera_session"); version != kFormatVersion)
      map.Fault(fmt::format("version {} is not known, only {}", version, kFormatVersion));
    session.board = Require(CalibrationBoardFromText(map.Text("board")), map);
    session.models = Require(LensModelsFromText(map.Text("models")), map);
    for (YamlMap& entry : map.List("images")) {
      CameraSessionImage image{.file = entry.Text("file"),
                               .name = entry.Text("name"),
                               .excluded = entry.Flag("excluded", false)};
      if (image.file.empty() || image.file != fs::path(image.file).filename().string())
        entry.Fault(fmt::format("{} is no file in the folder \"images\"", image.file));
      entry.Finish();
      session.images.push_back(std::move(image));
    }
    map.Finish();
  }));
  AddUnlisted(CameraSessionImages(folder), session.images);
  return session;
}

}  // namespace foresight
