#include "tests/nasty/readers.h"

#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/detection/detection_json.h"
#include "core/evaluation/fit_outcome_json.h"
#include "core/fitting/verdict_model.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "core/io/point_cloud_file.h"
#include "core/mission/plan_json.h"
#include "tests/nasty/png_bomb.h"
#include "tests/support/run_program.h"

namespace foresight::nasty {
namespace {

using Command = std::function<std::vector<std::string>(const std::string&, const std::string&)>;

constexpr int kWidth = 96, kHeight = 72;
const std::string kResources = FORESIGHT_SOURCE_DIR "/resources/";
const std::string kCorpus = FORESIGHT_SOURCE_DIR "/tests/fuzz/corpus/";

std::string Repeated(const std::string& piece, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += piece;
  return text;
}

void ReplaceValue(std::string& yaml, const std::string& key, const std::string& value) {
  const std::size_t begin = yaml.find("  " + key + ":");
  if (begin == std::string::npos) return;
  yaml.replace(begin, yaml.find('\n', begin) - begin, "  " + key + ": " + value);
}

/// A rig whose camera has few pixels, so that trying takes no time.
Result<std::string> SmallRig() {
  FORESIGHT_TRY(std::string yaml, ReadFile(kResources + "rigs/default.yaml"));
  ReplaceValue(yaml, "width", std::to_string(kWidth));
  ReplaceValue(yaml, "height", std::to_string(kHeight));
  for (const char* key : {"fx", "fy"}) ReplaceValue(yaml, key, "45");
  ReplaceValue(yaml, "cx", "47.5");
  ReplaceValue(yaml, "cy", "35.5");
  return yaml;
}

/// What stands on a table before a wall, seen from the origin.
std::vector<CloudPoint> TablePoints() {
  std::vector<CloudPoint> points;
  const auto add = [&points](double x, double y, double z) {
    CloudPoint point;
    point.x = static_cast<float>(x);
    point.y = static_cast<float>(y);
    point.z = static_cast<float>(z);
    points.push_back(point);
  };
  for (int i = 0; i < 100; ++i) add(1.0 + 0.02 * (i % 10), 0.04 * (i / 10) - 0.2, -0.4);
  for (int i = 0; i < 100; ++i) add(1.5, 0.04 * (i % 10) - 0.2, 0.04 * (i / 10) - 0.4);
  for (int i = 0; i < 90; ++i) add(1.07, 0.006 * (i % 9) - 0.024, -0.38 + 0.02 * (i / 9));
  return points;
}

std::string AsciiPly(const std::vector<CloudPoint>& points) {
  std::string ply = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n",
      points.size());
  for (const CloudPoint& p : points) ply += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  return ply;
}

std::string FloatRecords(const std::vector<CloudPoint>& points) {
  std::string bytes;
  for (const CloudPoint& p : points) {
    const float record[4] = {p.x, p.y, p.z, 0.5f};
    bytes.append(reinterpret_cast<const char*>(record), sizeof(record));
  }
  return bytes;
}

std::string TextPoints(const std::vector<CloudPoint>& points) {
  std::string text = "# x y z\n";
  for (const CloudPoint& p : points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  return text;
}

std::string SamplesCsv() {
  std::string csv = "line,beam,u,v,depth_mm\n";
  for (int i = 0; i < 96; ++i)
    csv += fmt::format("{},{},{},{},{}\n", i / 12, i % 12, 8 * (i % 12), 9 * (i / 12), 1500 + i);
  return csv;
}

std::string TerrainJson() {
  TerrainDetection terrain;
  terrain.surfaces.resize(2);
  terrain.surfaces[0].size_m = {0.397, 0.390};
  terrain.origin.roi = ImageRoi::Rectangle(0.0, {0.0, 0.0}, {50.0, 40.0});
  return DetectionToJson(terrain, {});
}

std::string OutcomeTable() {
  std::string table;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    FitOutcome outcome;
    outcome.seed = seed;
    outcome.what = "wheel";
    outcome.source = "raw";
    outcome.positive = outcome.found = true;
    outcome.pose_ok = seed % 2 == 0;
    const std::size_t features = ShippedVerdictModel("valve", VerdictSource::kRaw).features.size();
    outcome.verdict.features.assign(features, 0.1 * static_cast<double>(seed));
    table += FitOutcomeToJson(outcome) + "\n";
  }
  return table;
}

/// Text that is wrong in any format.
std::vector<std::string> WrongText() {
  return {"",
          "\n",
          std::string("\0\0\0\0", 4),
          "\xff\xfe\x00\x01",
          "\xef\xbb\xbf",
          Repeated("a", 1'000'000),
          Repeated("\n", 1'000'000),
          "\x1b[2J\x1b]0;title\x07",
          "-----BEGIN CERTIFICATE-----"};
}

/// YAML's own traps; `head` are lines that make a reader go on.
std::vector<std::string> WrongYaml(const std::string& head) {
  std::string laughs = head + "x0: &x0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 40; ++i)
    laughs += fmt::format("x{0}: &x{0} [*x{1}, *x{1}, *x{1}, *x{1}, *x{1}, *x{1}]\n", i, i - 1);
  return {laughs,
          head + "a: &a [*a]\n",
          head + "? {a: b}\n: c\n",
          head + "? [a, b]\n: c\n",
          "- 1\n- 2\n",
          "5\n",
          "~\n",
          "--- \n--- \n",
          head + head,
          head + "a: " + Repeated("[", 100'000),
          head + "a: " + Repeated("{a: ", 100'000),
          head + Repeated("- ", 100'000),
          head + Repeated("? ", 100'000),
          head + "a: \"" + Repeated("x", 900'000) + "\"\n",
          head + "a: !!python/object:os.system x\n",
          head + "a: *nothing\n",
          head + "\tkey: value\n",
          head + "a: 'not closed\n",
          head + "a: |\n" + Repeated(" x\n", 100'000)};
}

std::vector<std::string> WrongJson() {
  return {"{}",
          "[]",
          "null",
          "7",
          "{\"kind\": 5}",
          "{\"kind\": \"valve\"}",
          "{\"kind\": \"terrain\", \"surfaces\": 9}",
          Repeated("[", 1'000'000),
          Repeated("{\"a\":", 200'000),
          "{\"a\": 1e999}",
          "{\"a\": \"\xff\"}",
          "{\"from_rad\": 1e308, \"to_rad\": -1e308}"};
}

std::vector<std::string> WrongPly() {
  const std::string begin = "ply\nformat binary_little_endian 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  return {begin + "element vertex 1000000000000\n" + xyz,
          begin + "element vertex 100000000\n" + xyz + "abc",
          begin + "element vertex -1\n" + xyz,
          begin + "element vertex 1\nproperty list uchar int x\n" + xyz,
          begin + "element face 99999999\nelement vertex 1\n" + xyz + Repeated("x", 12),
          "ply\nformat ascii 1.0\nelement vertex 100000000\n" + xyz + "1 2 3\n",
          "ply\nformat ascii 1.0\nelement face 100000000\nelement vertex 1\n" + xyz + "1 2 3\n",
          "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "1e308 0 0\nnan 0 0\ninf 0 0\n",
          "ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "99999 0 0\n-99999 0 0\n",
          "ply\n" + Repeated("comment x\n", 200'000),
          "ply\nformat ascii 1.0\n" + Repeated("element vertex 1\nproperty float x\n", 50'000) +
              "end_header\n"};
}

/// Points that say little or nothing.
std::vector<std::string> DegenerateClouds() {
  std::vector<std::string> clouds;
  const auto add = [&clouds](int count, const auto& place) {
    std::vector<CloudPoint> points(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) place(i, points[static_cast<std::size_t>(i)]);
    clouds.push_back(AsciiPly(points));
  };
  add(400, [](int i, CloudPoint& p) { p.z = 0.3f + 0.001f * static_cast<float>(i); });
  add(400, [](int i, CloudPoint& p) { p.x = 0.3f + 0.001f * static_cast<float>(i); });
  add(400, [](int, CloudPoint& p) { p.x = 1.0f; });
  add(400, [](int, CloudPoint&) {});
  add(400, [](int i, CloudPoint& p) {
    p.x = 1.0f;
    p.y = 1e-30f * static_cast<float>(i);
  });
  add(400, [](int i, CloudPoint& p) {
    p.x = 50'000.0f;
    p.z = 200.0f * static_cast<float>(i % 20);
    p.y = 200.0f * static_cast<float>(i / 20);
  });
  add(400, [](int i, CloudPoint& p) {
    p.x = 1.0f + 1e-6f * static_cast<float>(i);
    p.z = -0.2f + 0.001f * static_cast<float>(i);
  });
  return clouds;
}

std::vector<std::string> WrongPcd() {
  const auto header = [](const std::string& sizes, const std::string& points,
                         const std::string& data) {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n" + sizes + "\nWIDTH " + points +
           "\nHEIGHT 1\nPOINTS " + points + "\nDATA " + data + "\n";
  };
  const std::string sizes = "SIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1";
  return {header(sizes, "1000000000000", "binary"),
          header(sizes, "100000000", "binary"),
          header(sizes, "100000000", "ascii") + "1 2 3\n",
          header(sizes, "100000000", "binary_compressed") + std::string(8, '\xff'),
          header(sizes, "0", "binary"),
          header(sizes, "3", "nonsense"),
          header("SIZE 4096 4096 4096\nTYPE F F F\nCOUNT 4096 4096 4096", "1", "binary"),
          "FIELDS" + Repeated(" x", 500'000) + "\nPOINTS 1\nDATA ascii\n1\n"};
}

std::vector<std::string> WrongPfm() {
  return {"Pf\n20000 20000\n-1\n",
          "Pf\n0 0\n-1\n",
          "Pf\n-1 5\n-1\n",
          "PF\n2 2\n-1\n",
          "Pf\n96 72\nnan\n",
          "Pf\n96 72\n0\n",
          "Pf\n96 72\n-1\n" + Repeated(std::string("\x00\x00\xc0\x7f", 4), kWidth * kHeight),
          "Pf\n96 72\n-1\n" + Repeated(std::string("\xff\xff\x7f\x7f", 4), kWidth * kHeight),
          "Pf\n96 72\n-1\n" + Repeated(std::string("\x01\x00\x00\x00", 4), kWidth * kHeight)};
}

std::vector<std::string> WrongPng() {
  return {PngBomb(20000, 20000, 16, PngColor::kGray),
          PngBomb(20000, 20000, 1, PngColor::kGray),
          PngBomb(20000, 20000, 8, PngColor::kRgbAlpha, 1000),
          PngBomb(2'000'000'000, 1, 8, PngColor::kGray, 10),
          PngBomb(kWidth, kHeight, 16, PngColor::kGray),
          PngBomb(kWidth, kHeight, 8, PngColor::kPalette)};
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The good files that stand beside a nasty one.
class GoodFiles {
 public:
  explicit GoodFiles(std::string folder) : folder_(std::move(folder)) {}

  std::string operator/(const std::string& name) const { return folder_ + "/" + name; }
  Result<std::string> Bytes(const std::string& name) const { return ReadFile(*this / name); }

  Status Write(const std::string& ctl) {
    const auto text = [this](const std::string& name, const std::string& bytes) {
      return WriteFileAtomically(*this / name, bytes);
    };
    FORESIGHT_TRY(const std::string rig, SmallRig());
    FORESIGHT_CHECK(text("rig.yaml", rig));
    FORESIGHT_CHECK(text("samples.csv", SamplesCsv()));
    FORESIGHT_CHECK(text("plan.json", PlanToJson(ScanPlan())));
    FORESIGHT_CHECK(text("table.jsonl", OutcomeTable()));
    FORESIGHT_CHECK(text("last.json", TerrainJson()));
    FORESIGHT_CHECK(WritePng(*this / "image.png", ColorImage(kWidth, kHeight, {120, 90, 60})));
    FORESIGHT_CHECK(WritePng16(*this / "depth.png", Image<std::uint16_t>(kWidth, kHeight, 1500)));
    FORESIGHT_CHECK(WritePfm(*this / "depth.pfm", FloatImage(kWidth, kHeight, 1500.0f)));
    FORESIGHT_CHECK(WritePly(*this / "cloud.ply", TablePoints(), CloudFields::kWithImage));
    FORESIGHT_CHECK(WritePcd(*this / "cloud.pcd", TablePoints(), CloudFields::kWithImage));
    FORESIGHT_CHECK(text("ascii.ply", AsciiPly(TablePoints())));
    FORESIGHT_CHECK(text("cloud.bin", FloatRecords(TablePoints())));
    FORESIGHT_CHECK(text("points.xyz", TextPoints(TablePoints())));
    FORESIGHT_CHECK(WriteStereo());
    const ProgramResult scanned = RunProgram(
        ctl, {"scan", "--scene", kResources + "scenes/room.yaml", "--rig", *this / "rig.yaml",
              "--from", "-1", "--to", "1", "--speed", "40", "--out", *this / "mission.foresight"});
    if (scanned.exit_code != 0) return Fail(ErrorCode::kIo, "{}", scanned.errors);
    FORESIGHT_CHECK(Make(ctl, {"mission", "export", *this / "mission.foresight", "-o",
                               *this / "export", "--what", "ply,images,bag"}));
    FORESIGHT_CHECK(text("calib.txt",
                         "P2: 45 0 47.5 4 0 45 35.5 0 0 0 1 0\n"
                         "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\n"));
    FORESIGHT_CHECK(text("image.pgm", "P5\n96 72\n255\n" + std::string(kWidth * kHeight, 'x')));
    for (const std::string format : {"opencv", "ros", "kalibr", "colmap"})
      FORESIGHT_CHECK(Make(ctl, {"rig", "export", *this / "rig.yaml", "--format", format, "--out",
                                 *this / ("camera." + format)}));
    return Make(ctl, {"simulate", "calibration", *this / "session", "--views", "5", "--poses", "3",
                      "--scans", "1", "--sweeps", "1"});
  }

 private:
  static Status Make(const std::string& ctl, const std::vector<std::string>& arguments) {
    const ProgramResult made = RunProgram(ctl, arguments);
    if (made.exit_code == 0) return {};
    return Fail(ErrorCode::kIo, "{} {}: {}", arguments[0], arguments[1], made.errors);
  }
  Status WriteStereo() const {
    std::filesystem::create_directories(*this / "stereo");
    FORESIGHT_CHECK(WriteFileAtomically(*this / "stereo/calib.txt",
                                        "cam0=[80 0 48; 0 80 36; 0 0 1]\n"
                                        "cam1=[80 0 48; 0 80 36; 0 0 1]\ndoffs=0\nbaseline=100\n"
                                        "width=96\nheight=72\n"));
    const ColorImage image(kWidth, kHeight, {120, 90, 60});
    FORESIGHT_CHECK(WritePng(*this / "stereo/im0.png", image));
    FORESIGHT_CHECK(WritePng(*this / "stereo/im1.png", image));
    return WritePfm(*this / "stereo/disp0GT.pfm", FloatImage(kWidth, kHeight, 8.0f));
  }

  std::string folder_;
};

Command FitOf(const char* object, const std::string& cloud_option = "--cloud") {
  return [object, cloud_option](const std::string& path, const std::string&) {
    return std::vector<std::string>{"fit",         object,  cloud_option, path,
                                    "--viewpoint", "0,0,0", "--json"};
  };
}

Command FitInTable(const GoodFiles& good, const char* object, const char* option) {
  return [cloud = good / "ascii.ply", object, option](const std::string& path, const std::string&) {
    return std::vector<std::string>{"fit",   object, "--cloud", cloud,   "--viewpoint",
                                    "0,0,0", option, path,      "--json"};
  };
}

Command FitInMap(const GoodFiles& good) {
  return [rig = good / "rig.yaml"](const std::string& path, const std::string&) {
    return std::vector<std::string>{"fit", "valve", "--depth",     path,    "--rig",
                                    rig,   "--roi", "30,20,70,50", "--json"};
  };
}

/// The stereo scene with one of its files replaced: by a link, so that what it leads to is met.
Command EvaluateWith(const GoodFiles& good, const std::string& file) {
  return [stereo = good / "stereo", file](const std::string& path, const std::string& out) {
    const std::filesystem::path scene = std::filesystem::path(out) / "scene";
    std::filesystem::create_directories(scene);
    for (const auto& entry : std::filesystem::directory_iterator(stereo)) {
      const std::string name = entry.path().filename().string();
      std::error_code too_long;  // then it is not there, which is nasty as well
      std::filesystem::create_symlink(name == file ? path : entry.path().string(), scene / name,
                                      too_long);
    }
    return std::vector<std::string>{"evaluate", scene.string(), "--json"};
  };
}

/// The session with one of its files replaced.
Command CalibrateWith(const GoodFiles& good, const std::string& file, const char* stage) {
  return
      [session = good / "session", file, stage](const std::string& path, const std::string& out) {
        const std::filesystem::path copy = std::filesystem::path(out) / "session";
        std::filesystem::copy(session, copy, std::filesystem::copy_options::recursive);
        std::error_code not_there;  // a path that is nasty itself
        std::filesystem::copy_file(path, copy / file,
                                   std::filesystem::copy_options::overwrite_existing, not_there);
        return std::vector<std::string>{"calibrate", stage, copy.string(), "--json"};
      };
}

/// `foresightctl mission import` of the file, with good ones beside it.
Command MissionOf(std::vector<std::string> beside) {
  return [beside = std::move(beside)](const std::string& path, const std::string& out) {
    std::vector<std::string> arguments = {"mission", "import", path};
    arguments.insert(arguments.end(), beside.begin(), beside.end());
    arguments.insert(arguments.end(), {"--out", out + "/o.foresight", "--json"});
    return arguments;
  };
}

/// The exported scan with one of its files replaced.
Command MissionOfExport(const GoodFiles& good, const std::string& file) {
  return [scan = good / "export/scan-0001", file](const std::string& path, const std::string& out) {
    const std::filesystem::path copy = std::filesystem::path(out) / "scan-0001";
    std::filesystem::copy(scan, copy, std::filesystem::copy_options::recursive);
    std::error_code not_there;  // a path that is nasty itself
    std::filesystem::copy_file(path, copy / file, std::filesystem::copy_options::overwrite_existing,
                               not_there);
    return std::vector<std::string>{
        "mission", "import", copy.string(), "--out", out + "/o.foresight", "--json"};
  };
}

Command ImportAs(const char* format) {
  return [format](const std::string& path, const std::string& out) {
    return std::vector<std::string>{"rig",   "import",        path,    "--format", format,
                                    "--out", out + "/o.yaml", "--json"};
  };
}

Command CalibrateFrom() {
  return [](const std::string& path, const std::string&) {
    return std::vector<std::string>{"calibrate", "intrinsics",          path,
                                    "--board",   "checkerboard:7x6:25", "--json"};
  };
}

}  // namespace

Result<std::vector<Reader>> AllReaders(const std::string& folder, const std::string& ctl) {
  GoodFiles good(folder);
  FORESIGHT_CHECK(good.Write(ctl));
  std::vector<Reader> readers;
  Status read;
  const auto add = [&](const char* name, const char* file, bool text, const std::string& bytes_of,
                       std::vector<std::string> handmade, Command command, bool head = false) {
    const Result<std::string> bytes = ReadFile(bytes_of);
    if (!bytes) read = tl::unexpected(bytes.error());
    readers.push_back({name, file, text, bytes.value_or(""), WrongText() + std::move(handmade),
                       head, std::move(command)});
  };
  const std::string room = kResources + "scenes/room.yaml";
  add("scene", "nasty.yaml", true, kResources + "scenes/valve.yaml",
      WrongYaml("foresight_scene: 1\nname: x\n"),
      [rig = good / "rig.yaml"](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"render", path,       "--rig", rig,
                                        "--out",  out + "/o", "--json"};
      });
  add("rig", "nasty.yaml", true, good / "rig.yaml", WrongYaml("foresight_rig: 1\nname: x\n"),
      [](const std::string& path, const std::string&) {
        return std::vector<std::string>{"scan", "--predict", "--rig", path, "--json"};
      });
  add("rig of an image", "nasty.yaml", true, good / "rig.yaml", {},
      [room](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"render", room,       "--rig", path,
                                        "--out",  out + "/o", "--json"};
      });
  add("image", "nasty.png", false, good / "image.png", WrongPng(),
      [csv = good / "samples.csv"](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"upsample", path, csv, "--out", out + "/o", "--json"};
      });
  add("samples", "nasty.csv", true, good / "samples.csv",
      {"line,beam,u,v,depth_mm\n2000000000,2000000000,1,1,1\n", "line,line,beam,u,v,depth_mm\n",
       "line,beam,u,v,depth_mm\n0,0,1e308,-1e308,1e308\n", "line,beam,u,v,depth_mm\n",
       "line,beam,u,v,depth_mm\n" + Repeated("1,1,1,1,1\n", 50'000)},
      [image = good / "image.png"](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"upsample", image, path, "--out", out + "/o", "--json"};
      });
  const std::vector<std::string> clouds = DegenerateClouds();
  add("PLY for a valve", "nasty.ply", false, good / "cloud.ply", WrongPly() + clouds,
      FitOf("valve"));
  add("PLY for a drill", "nasty.ply", true, good / "ascii.ply", clouds, FitOf("drill"));
  add("PLY for a terrain", "nasty.ply", true, good / "ascii.ply", clouds, FitOf("terrain"));
  add("PLY for a cylinder", "nasty.ply", true, good / "ascii.ply", clouds, FitOf("cylinder"));
  add("PCD", "nasty.pcd", false, good / "cloud.pcd", WrongPcd(), FitOf("cylinder"));
  add("floats", "nasty.bin", false, good / "cloud.bin", {Repeated(std::string(16, '\0'), 1000)},
      FitOf("terrain"));
  add("depth map", "nasty.pfm", false, good / "depth.pfm", WrongPfm(), FitInMap(good));
  add("depth image", "nasty.png", false, good / "depth.png", WrongPng(), FitInMap(good));
  add("drill template", "nasty.yaml", true, kResources + "templates/drill_plain.yaml",
      WrongYaml("foresight_template: 1\nobject: drill\nname: x\n"),
      FitInTable(good, "drill", "--template"));
  add("last terrain", "nasty.json", true, good / "last.json", WrongJson(),
      FitInTable(good, "terrain", "--last"));
  add("mission", "nasty.foresight", false, good / "mission.foresight", {"SQLite format 3\0"},
      [](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"cloud", path, "--out", out + "/o.ply", "--json"};
      });
  add("PLY to import", "nasty.ply", false, good / "cloud.ply", WrongPly() + clouds, MissionOf({}));
  add("PCD to import", "nasty.pcd", false, good / "cloud.pcd", WrongPcd(), MissionOf({}));
  add("floats to import", "nasty.bin", false, good / "cloud.bin",
      {Repeated(std::string(16, '\0'), 1000)}, MissionOf({good / "image.png", good / "calib.txt"}));
  add("text of points to import", "nasty.xyz", true, good / "points.xyz",
      {"1 2 3\n", "1 2\n", Repeated("1 2 3\n", 100'000), Repeated("9 ", 500'000)}, MissionOf({}));
  add("calibration of KITTI", "nasty.txt", true, good / "calib.txt",
      {"P2: nan\n", "P2:\n", "P2: " + Repeated("1 ", 100'000)},
      MissionOf({good / "cloud.bin", good / "image.png"}));
  add("image to import", "nasty.png", false, good / "image.png", WrongPng(),
      MissionOf({good / "cloud.bin", good / "calib.txt"}));
  add("bag", "nasty.bag", false, good / "export/mission.bag",
      {"#ROSBAG V2.0\n", "#ROSBAG V1.2\n", "#ROSBAG V2.0\n" + Repeated("x", 10'000),
       "#ROSBAG V2.0\n" + Repeated(std::string(4, '\xff'), 10'000)},
      MissionOf({}));
  add("record of an exported scan", "scan.json", true, good / "export/scan-0001/scan.json",
      WrongJson(), MissionOfExport(good, "scan.json"));
  add("mission of a report", "nasty.foresight", false, good / "mission.foresight",
      {"SQLite format 3\0"}, [](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"mission", "report", path, "-o", out + "/report"};
      });
  add("mission that is compared", "nasty.foresight", false, good / "mission.foresight",
      {"SQLite format 3\0"}, [](const std::string& path, const std::string&) {
        return std::vector<std::string>{"mission", "compare", path, "--json"};
      });
  add("calibration of a stereo pair", "nasty.txt", true, good / "stereo/calib.txt", {},
      EvaluateWith(good, "calib.txt"));
  add("image of a stereo pair", "nasty.png", false, good / "stereo/im0.png", WrongPng(),
      EvaluateWith(good, "im0.png"));
  add("disparities", "nasty.pfm", false, good / "stereo/disp0GT.pfm", WrongPfm(),
      EvaluateWith(good, "disp0GT.pfm"));
  add("outcomes of fits", "nasty.jsonl", true, good / "table.jsonl", WrongJson(),
      [](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"verdict",      "fit", "valve", path,
                                        "--population", "x",   "-o",    out + "/o"};
      });
  add("faults", "nasty.yaml", true, kCorpus + "device_faults/all.yaml",
      WrongYaml("foresight_faults: 1\n"), [room](const std::string& path, const std::string&) {
        return std::vector<std::string>{"emulate",   room,   "--faults", path,
                                        "--seconds", "0.05", "--json"};
      });
  add("image of a board", "nasty.png", false, good / "image.png", WrongPng(), CalibrateFrom());
  add("grey image of a board", "nasty.pgm", false, good / "image.pgm",
      {"P5\n2000000000 2000000000\n255\n", "P5\n20000 20000\n255\n", "P5\n-1 5\n255\n",
       "P5\n96 72\n65535\n", "P5\n# x\n", "P2\n1 1\n255\n7\n"},
      CalibrateFrom());
  add("JPEG of a board", "nasty.jpg", false, good / "image.pgm",
      {"\xff\xd8\xff\xe0", "\xff\xd8\xff\xdb\xff\xff" + Repeated("x", 100'000),
       "\xff\xd8\xff\xc0" + std::string("\0\x11\x08\xff\xff\xff\xff\x03", 8)},
      CalibrateFrom());
  add("session", "session.yaml", true, good / "session/session.yaml",
      WrongYaml("foresight_calibration_session: 1\n"),
      CalibrateWith(good, "session.yaml", "motor"));
  add("corners of a view", "001.csv", true, good / "session/intrinsic/001.csv", {},
      CalibrateWith(good, "intrinsic/001.csv", "motor"));
  add("lines of a stop", "stop_01_lines.csv", true, good / "session/pose_01/stop_01_lines.csv", {},
      CalibrateWith(good, "pose_01/stop_01_lines.csv", "lidar"));
  add("samples of the robot's frame", "nasty.yaml", true, kCorpus + "robot_frame/surveyed.yaml",
      WrongYaml("foresight_robot_frame: 1\nboards: surveyed\n"),
      [rig = good / "rig.yaml"](const std::string& path, const std::string&) {
        return std::vector<std::string>{"calibrate", "robot", path, "--rig", rig, "--json"};
      });
  add("camera of OpenCV", "nasty.yml", true, good / "camera.opencv", WrongYaml("%YAML:1.0\n---\n"),
      ImportAs("opencv"));
  add("camera of ROS", "nasty.yaml", true, good / "camera.ros", WrongYaml("image_width: 1\n"),
      ImportAs("ros"));
  add("camera of Kalibr", "nasty.yaml", true, good / "camera.kalibr", WrongYaml("cam0:\n"),
      ImportAs("kalibr"));
  add("camera of COLMAP", "nasty.txt", true, good / "camera.colmap",
      {"1 FOV 1288 964 nan 1 1 1 1\n", "1 FOV 999999999 999999999 1 1 1 1 1\n", "1 FOV 1288\n"},
      ImportAs("colmap"));
  // The mission's name is taken by a folder, so that no device is looked for.
  add(
      "plan", "nasty.json", true, good / "plan.json", WrongJson(),
      [head = kResources + "heads/drc.yaml"](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"--head-config", head, "--scan", path, "--out", out};
      },
      true);
  add(
      "head", "nasty.yaml", true, kResources + "heads/drc.yaml",
      WrongYaml("foresight_head: 1\nname: x\n"),
      [plan = good / "plan.json"](const std::string& path, const std::string& out) {
        return std::vector<std::string>{"--head-config", path, "--scan", plan, "--out", out};
      },
      true);
  FORESIGHT_CHECK(read);
  return readers;
}

}  // namespace foresight::nasty
