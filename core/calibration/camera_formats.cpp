#include "core/calibration/camera_formats.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "core/io/yaml_reader.h"

namespace foresight {
namespace {

struct FormatRow {
  CameraFormat format;
  std::string_view text;
};
constexpr std::array<FormatRow, 4> kFormats = {{{CameraFormat::kOpenCv, "opencv"},
                                                {CameraFormat::kRos, "ros"},
                                                {CameraFormat::kKalibr, "kalibr"},
                                                {CameraFormat::kColmap, "colmap"}}};

/// The paper's lens as the FOV model: its w and the focal lengths' factor.
struct Fov {
  double w = 0.0;
  double focal_factor = 1.0;
};
Fov FovOf(double k) {
  const double w = 2.0 * std::atan(0.5 * k);
  return {w, w / k};
}
double KOf(double w) {
  return 2.0 * std::tan(0.5 * w);
}

std::string Joined(const std::vector<double>& values, const char* separator) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{}", text.empty() ? "" : separator, value);
  return text;
}

bool IsPinhole(const CameraModel& camera) {
  const auto* fisheye = std::get_if<FisheyeLens>(&camera.lens);
  return fisheye != nullptr && fisheye->k == 0.0;
}

/// What the format can name: the camera itself, or its refit.
bool HasName(const CameraModel& camera, CameraFormat format) {
  switch (LensModelOf(camera.lens)) {
    case LensModel::kFisheyeK:
      return IsPinhole(camera) || format == CameraFormat::kKalibr ||
             format == CameraFormat::kColmap;
    case LensModel::kExtendedUnified:
      return format == CameraFormat::kKalibr;
    case LensModel::kKannalaBrandt:
      return true;
    case LensModel::kRadialTangential:
      return format != CameraFormat::kKalibr ||
             std::get<RadialTangentialLens>(camera.lens).Parameters()[4] == 0.0;
  }
  return false;
}

/// Coefficients of the lens in OpenCV's and ROS's order, and the model's name there.
struct Distortion {
  std::string model;
  std::vector<double> coefficients;
};

Distortion PolynomialDistortion(const CameraModel& camera, const char* fisheye_name) {
  if (const auto* kb4 = std::get_if<KannalaBrandtLens>(&camera.lens)) {
    const auto& k = kb4->Parameters();
    return {fisheye_name, {k.begin(), k.end()}};
  }
  if (const auto* radtan = std::get_if<RadialTangentialLens>(&camera.lens)) {
    const auto k = radtan->Parameters();
    return {"plumb_bob", {k.begin(), k.end()}};
  }
  return {"plumb_bob", {0.0, 0.0, 0.0, 0.0, 0.0}};
}

std::string OpenCvMatrix(const std::string& name, int rows, int columns,
                         const std::vector<double>& values) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n",
                     name, rows, columns, Joined(values, ", "));
}

CameraExport ToOpenCv(const CameraModel& c) {
  const Distortion distortion = PolynomialDistortion(c, "fisheye");
  std::string text = "%YAML:1.0\n---\n";
  text += fmt::format("image_width: {}\nimage_height: {}\n", c.width, c.height);
  text += OpenCvMatrix("camera_matrix", 3, 3, {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1});
  text += fmt::format("distortion_model: {}\n", distortion.model);
  text += OpenCvMatrix("distortion_coefficients", 1,
                       static_cast<int>(distortion.coefficients.size()), distortion.coefficients);
  return {text, distortion.model, {}};
}

std::string RosMatrix(const std::string& name, int rows, int columns,
                      const std::vector<double>& values) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: [{}]\n", name, rows, columns,
                     Joined(values, ", "));
}

CameraExport ToRos(const CameraModel& c) {
  const Distortion distortion = PolynomialDistortion(c, "equidistant");
  std::string text =
      fmt::format("image_width: {}\nimage_height: {}\ncamera_name: foresight\n", c.width, c.height);
  text += RosMatrix("camera_matrix", 3, 3, {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1});
  text += fmt::format("distortion_model: {}\n", distortion.model);
  text += RosMatrix("distortion_coefficients", 1, static_cast<int>(distortion.coefficients.size()),
                    distortion.coefficients);
  text += RosMatrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  text += RosMatrix("projection_matrix", 3, 4, {c.fx, 0, c.cx, 0, 0, c.fy, c.cy, 0, 0, 0, 1, 0});
  return {text, distortion.model, {}};
}

CameraExport ToKalibr(const CameraModel& c) {
  std::string model = "pinhole", distortion = "none";
  std::vector<double> coefficients, intrinsics = {c.fx, c.fy, c.cx, c.cy};
  if (const auto* fisheye = std::get_if<FisheyeLens>(&c.lens); fisheye && fisheye->k != 0.0) {
    const Fov fov = FovOf(fisheye->k);
    distortion = "fov";
    coefficients = {fov.w};
    intrinsics = {c.fx * fov.focal_factor, c.fy * fov.focal_factor, c.cx, c.cy};
  } else if (const auto* kb4 = std::get_if<KannalaBrandtLens>(&c.lens)) {
    distortion = "equidistant";
    coefficients.assign(kb4->Parameters().begin(), kb4->Parameters().end());
  } else if (const auto* radtan = std::get_if<RadialTangentialLens>(&c.lens)) {
    const auto k = radtan->Parameters();
    distortion = "radtan";
    coefficients = {k[0], k[1], k[2], k[3]};
  } else if (const auto* eucm = std::get_if<ExtendedUnifiedLens>(&c.lens)) {
    model = "eucm";
    intrinsics.insert(intrinsics.begin(), {eucm->alpha, eucm->beta});
  }
  std::string text = fmt::format(
      "cam0:\n  camera_model: {}\n  intrinsics: [{}]\n  distortion_model: {}\n"
      "  distortion_coeffs: [{}]\n  resolution: [{}, {}]\n  rostopic: /camera/image_raw\n",
      model, Joined(intrinsics, ", "), distortion, Joined(coefficients, ", "), c.width, c.height);
  return {text, model + "-" + distortion, {}};
}

CameraExport ToColmap(const CameraModel& c) {
  std::string model = "PINHOLE";
  std::vector<double> values = {c.fx, c.fy, c.cx + 0.5, c.cy + 0.5};
  if (const auto* fisheye = std::get_if<FisheyeLens>(&c.lens); fisheye && fisheye->k != 0.0) {
    const Fov fov = FovOf(fisheye->k);
    model = "FOV";
    values = {c.fx * fov.focal_factor, c.fy * fov.focal_factor, c.cx + 0.5, c.cy + 0.5, fov.w};
  } else if (const auto* kb4 = std::get_if<KannalaBrandtLens>(&c.lens)) {
    model = "OPENCV_FISHEYE";
    values.insert(values.end(), kb4->Parameters().begin(), kb4->Parameters().end());
  } else if (const auto* radtan = std::get_if<RadialTangentialLens>(&c.lens)) {
    const auto k = radtan->Parameters();
    model = k[4] == 0.0 ? "OPENCV" : "FULL_OPENCV";
    values.insert(values.end(), {k[0], k[1], k[2], k[3]});
    if (k[4] != 0.0) values.insert(values.end(), {k[4], 0.0, 0.0, 0.0});
  }
  return {fmt::format("# Camera list with one line of data per camera:\n"
                      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n1 {} {} {} {}\n",
                      model, c.width, c.height, Joined(values, " ")),
          model,
          {}};
}

CameraExport Written(const CameraModel& camera, CameraFormat format) {
  switch (format) {
    case CameraFormat::kOpenCv:
      return ToOpenCv(camera);
    case CameraFormat::kRos:
      return ToRos(camera);
    case CameraFormat::kKalibr:
      return ToKalibr(camera);
    case CameraFormat::kColmap:
      break;
  }
  return ToColmap(camera);
}

std::vector<double> NumbersOf(const YAML::Node& node) {
  std::vector<double> values;
  for (const auto& value : node) values.push_back(value.as<double>());
  return values;
}

Lens PolynomialLens(YamlMap& map, const std::string& model, std::vector<double> k) {
  if (model == "fisheye" || model == "equidistant") {
    if (k.size() != 4) map.Fault("a fisheye has 4 coefficients, not " + std::to_string(k.size()));
    return KannalaBrandtLens(k[0], k[1], k[2], k[3]);
  }
  if (model != "plumb_bob" && model != "radtan" && model != "none")
    map.Fault("distortion model '" + model + "' is none of ours");
  if (k.size() > 5) {
    for (std::size_t i = 5; i < k.size(); ++i)
      if (k[i] != 0.0) map.Fault("a rational or thin-prism distortion is none of our models");
  } else if (!k.empty() && k.size() != 4 && k.size() != 5) {
    map.Fault("plumb_bob has 4 or 5 coefficients, not " + std::to_string(k.size()));
  }
  k.resize(5, 0.0);
  if (k == std::vector<double>(5, 0.0)) return FisheyeLens{0.0};
  return RadialTangentialLens(k[0], k[1], k[2], k[3], k[4]);
}

void SetMatrix(YamlMap& map, CameraModel& camera, const std::vector<double>& matrix) {
  if (matrix.size() != 9) map.Fault("camera_matrix has not 9 numbers");
  if (matrix[1] != 0.0) map.Fault("camera_matrix has a skew, which no camera of ours has");
  camera.fx = matrix[0];
  camera.cx = matrix[2];
  camera.fy = matrix[4];
  camera.cy = matrix[5];
}

/// OpenCV's and ROS's files differ in names and tags only.
CameraModel FromOpenCvOrRos(YamlMap& map) {
  CameraModel camera;
  camera.width = map.Integer("image_width");
  camera.height = map.Integer("image_height");
  const auto data = [&map](const std::string& key) { return NumbersOf(map.Map(key).Node("data")); };
  SetMatrix(map, camera, data("camera_matrix"));
  const std::vector<double> k = data("distortion_coefficients");
  const std::string fallback = k.size() == 4 ? "" : "plumb_bob";
  const std::string model = map.Text("distortion_model", fallback);
  if (model.empty()) map.Fault("4 coefficients without distortion_model: plumb_bob or fisheye?");
  camera.lens = PolynomialLens(map, model, k);
  return camera;
}

CameraModel FromKalibr(YamlMap& top) {
  YamlMap map = top.Map("cam0");
  CameraModel camera;
  const std::vector<double> size = NumbersOf(map.Node("resolution"));
  if (size.size() != 2) map.Fault("resolution has not 2 numbers");
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  const std::string model = map.Text("camera_model");
  std::vector<double> f = NumbersOf(map.Node("intrinsics"));
  const std::string distortion = map.Text("distortion_model", "none");
  const std::vector<double> k = map.Has("distortion_coeffs")
                                    ? NumbersOf(map.Node("distortion_coeffs"))
                                    : std::vector<double>();
  if (model == "eucm") {
    if (f.size() != 6) map.Fault("eucm has 6 intrinsics");
    camera.lens = ExtendedUnifiedLens{f[0], f[1]};
    f.erase(f.begin(), f.begin() + 2);
  } else if (model != "pinhole") {
    map.Fault("camera model '" + model + "' is none of ours");
  }
  if (f.size() != 4) map.Fault("intrinsics are not fx, fy, cx, cy");
  double factor = 1.0;
  if (model == "pinhole" && distortion == "fov") {
    if (k.size() != 1) map.Fault("fov has 1 coefficient");
    camera.lens = FisheyeLens{KOf(k[0])};
    factor = KOf(k[0]) / k[0];
  } else if (model == "pinhole") {
    camera.lens = PolynomialLens(map, distortion, k);
  }
  camera.fx = f[0] * factor;
  camera.fy = f[1] * factor;
  camera.cx = f[2];
  camera.cy = f[3];
  return camera;
}

std::vector<std::string> WordsOfLine(const std::string& line) {
  std::vector<std::string> words;
  std::size_t begin = line.find_first_not_of(" \t\r");
  while (begin != std::string::npos) {
    const std::size_t end = line.find_first_of(" \t\r", begin);
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(" \t\r", end);
  }
  return words;
}

Result<CameraModel> ColmapCamera(const std::vector<std::string>& words, const std::string& source) {
  if (words.size() < 5)
    return Fail(ErrorCode::kBadData, "{}: a camera's line has {} words", source, words.size());
  std::vector<double> numbers;
  for (std::size_t i = 2; i < words.size(); ++i) {
    double value = 0.0;
    const auto [end, fault] =
        std::from_chars(words[i].data(), words[i].data() + words[i].size(), value);
    if (fault != std::errc() || end != words[i].data() + words[i].size())
      return Fail(ErrorCode::kBadData, "{}: '{}' is not a number", source, words[i]);
    numbers.push_back(value);
  }
  const std::string& model = words[1];
  const std::vector<double> p(numbers.begin() + 2, numbers.end());
  struct Known {
    std::string_view model;
    std::size_t count;
  };
  constexpr std::array<Known, 6> kKnown = {{{"SIMPLE_PINHOLE", 3},
                                            {"PINHOLE", 4},
                                            {"FOV", 5},
                                            {"OPENCV_FISHEYE", 8},
                                            {"OPENCV", 8},
                                            {"FULL_OPENCV", 12}}};
  std::size_t count = 0;
  for (const Known& known : kKnown)
    if (known.model == model) count = known.count;
  if (count == 0)
    return Fail(ErrorCode::kBadData, "{}: camera model '{}' is none of ours", source, model);
  if (p.size() != count)
    return Fail(ErrorCode::kBadData, "{}: {} has {} parameters, not {}", source, model, count,
                p.size());
  const bool simple = model == "SIMPLE_PINHOLE";
  CameraModel camera;
  if (!(numbers[0] >= 1.0 && numbers[0] <= 20000.0 && numbers[1] >= 1.0 && numbers[1] <= 20000.0))
    return Fail(ErrorCode::kBadData, "{}: {} x {} is no size of an image", source, numbers[0],
                numbers[1]);
  camera.width = static_cast<int>(numbers[0]);
  camera.height = static_cast<int>(numbers[1]);
  camera.fx = p[0];
  camera.fy = simple ? p[0] : p[1];
  camera.cx = (simple ? p[1] : p[2]) - 0.5;
  camera.cy = (simple ? p[2] : p[3]) - 0.5;
  camera.lens = FisheyeLens{0.0};
  if (model == "FOV") {
    camera.lens = FisheyeLens{KOf(p[4])};
    camera.fx *= KOf(p[4]) / p[4];
    camera.fy *= KOf(p[4]) / p[4];
  } else if (model == "OPENCV_FISHEYE") {
    camera.lens = KannalaBrandtLens(p[4], p[5], p[6], p[7]);
  } else if (model == "OPENCV" || model == "FULL_OPENCV") {
    if (model == "FULL_OPENCV" && (p[9] != 0.0 || p[10] != 0.0 || p[11] != 0.0))
      return Fail(ErrorCode::kBadData, "{}: a rational distortion is none of our models", source);
    camera.lens = RadialTangentialLens(p[4], p[5], p[6], p[7], model == "FULL_OPENCV" ? p[8] : 0.0);
  }
  return camera;
}

Result<CameraModel> FromColmap(const std::string& text, const std::string& source) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::vector<std::string> words = WordsOfLine(text.substr(begin, end - begin));
    begin = end + 1;
    if (!words.empty() && words[0][0] != '#') return ColmapCamera(words, source);
  }
  return Fail(ErrorCode::kBadData, "{}: no camera in the file", source);
}

}  // namespace

std::string_view ToString(CameraFormat format) {
  for (const FormatRow& row : kFormats)
    if (row.format == format) return row.text;
  return {};
}

Result<CameraFormat> CameraFormatFromText(std::string_view text) {
  for (const FormatRow& row : kFormats)
    if (row.text == text) return row.format;
  return Fail(ErrorCode::kInvalidOptions, "format '{}' is not one of opencv, ros, kalibr, colmap",
              text);
}

Result<CameraExport> ExportCamera(const CameraModel& camera, CameraFormat format) {
  FORESIGHT_CHECK(camera.Check());
  if (HasName(camera, format)) return Written(camera, format);
  FORESIGHT_TRY(const CameraRefit refit,
                RefitCamera(camera, LensModel::kKannalaBrandt, PixelGrid(camera)));
  CameraExport result = Written(refit.camera, format);
  result.refit = refit;
  return result;
}

Result<CameraModel> ImportCamera(const std::string& text, CameraFormat format,
                                 const std::string& source) {
  Result<CameraModel> camera = CameraModel();
  if (format == CameraFormat::kColmap) {
    camera = FromColmap(text, source);
  } else {
    // OpenCV's first line is no directive that YAML knows.
    const std::string yaml =
        text.starts_with("%YAML") ? text.substr(std::min(text.find('\n'), text.size())) : text;
    FORESIGHT_CHECK(ParseYaml(yaml, source, [&](YamlMap& map) {
      camera = format == CameraFormat::kKalibr ? FromKalibr(map) : FromOpenCvOrRos(map);
    }));
  }
  if (camera)
    if (const auto fault = camera->FindFault())
      return Fail(ErrorCode::kBadData, "{}: {}", source, fault->message);
  return camera;
}

}  // namespace foresight
