#include "core/exchange/support_bundle.h"

#include <sys/utsname.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <system_error>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/version.h"
#include "core/exchange/mission_tables.h"
#include "core/exchange/zip_file.h"
#include "core/mission/merge_missions.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTextBytes = 8 << 20;

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The first line of a file of the system that begins so. (Not ReadFile: what lies below /proc has
/// no size.)
std::string SystemFact(const char* file, const std::string& begin) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(begin)) return line;
  return {};
}

std::string VersionsText(const std::vector<std::string>& more) {
  std::string text = fmt::format("Foresight {}\n", ProgramVersion());
  for (const std::string& line : more) text += line + "\n";
  text += SystemFact("/etc/os-release", "PRETTY_NAME=") + "\n";
  utsname name{};
  if (::uname(&name) == 0)
    text += fmt::format("{} {} {}\n", name.sysname, name.release, name.machine);
  text += SystemFact("/proc/cpuinfo", "model name") + "\n";
  text += fmt::format("{} cores\n", std::thread::hardware_concurrency());
  return text;
}

/// Names of texts in the archive: two folders may hold files of one name.
std::string UniqueName(const fs::path& file, std::set<std::string>& taken) {
  std::string name = "texts/" + file.filename().string();
  for (int i = 2; !taken.insert(name).second; ++i)
    name = fmt::format("texts/{}-{}{}", file.stem().string(), i, file.extension().string());
  return name;
}

class Bundle {
 public:
  Bundle(ZipFile& zip, const SupportBundleSources& sources) : zip_(zip), sources_(sources) {}

  Result<SupportBundleReport> Write(const fs::path& scratch, const RunContext& context) {
    FORESIGHT_CHECK(Add("versions.txt", VersionsText(sources_.versions)));
    for (const fs::path& file : sources_.texts) FORESIGHT_CHECK(AddText(file));
    for (const auto& [name, bytes] : sources_.attachments) FORESIGHT_CHECK(Add(name, bytes));
    if (sources_.mission) FORESIGHT_CHECK(AddMission(*sources_.mission, scratch, context));
    std::string contents = "What is here:\n";
    for (const std::string& file : report_.files) contents += "  " + file + "\n";
    if (!report_.left_out.empty()) contents += "What is not:\n";
    for (const std::string& sentence : report_.left_out) contents += "  " + sentence + "\n";
    FORESIGHT_CHECK(Add("contents.txt", contents));
    return std::move(report_);
  }

 private:
  Status Add(const std::string& name, std::string_view bytes) {
    FORESIGHT_CHECK(zip_.Add(name, bytes));
    report_.files.push_back(name);
    return {};
  }

  Status AddText(const fs::path& file) {
    static const std::set<std::string> kSecret = {".key", ".crt", ".pem", ".p12", ".crl"};
    if (kSecret.contains(Lower(file.extension().string()))) {
      report_.left_out.push_back(file.filename().string() + ": keys and certificates stay here");
      return {};
    }
    const auto text = ReadFile(file, kMostTextBytes);
    if (!text) {
      report_.left_out.push_back(text.error().message);
      return {};
    }
    if (text->find('\0') != std::string::npos) {
      report_.left_out.push_back(file.filename().string() + ": is no text");
      return {};
    }
    return Add(UniqueName(file, taken_), WithoutSecrets(*text));
  }

  Status AddMission(const fs::path& path, const fs::path& scratch, const RunContext& context) {
    FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
    FORESIGHT_TRY(const std::string scans_csv, ScansCsv(*mission));
    FORESIGHT_TRY(const std::string detections, DetectionsCsv(*mission));
    FORESIGHT_TRY(const std::string notes, NotesCsv(*mission));
    FORESIGHT_TRY(const std::string events, EventsCsv(*mission));
    FORESIGHT_CHECK(Add("scans.csv", scans_csv));
    FORESIGHT_CHECK(Add("detections.csv", detections));
    FORESIGHT_CHECK(Add("notes.csv", notes));
    FORESIGHT_CHECK(Add("events.csv", events));
    FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
    if (scans.empty()) {
      report_.left_out.push_back("last_scan.foresight: the mission has no scan");
      return {};
    }
    const std::int64_t last = scans.back().id;
    FORESIGHT_TRY(const Scan header, mission->LoadHeader(last));
    FORESIGHT_CHECK(Add("rig.yaml", SensorRigToYaml(header.rig)));
    MergeOptions keep;
    keep.keep = [last](const ScanSummary& scan) { return scan.id == last; };
    const std::vector<fs::path> source = {path};
    FORESIGHT_CHECK(MergeMissions(source, scratch, keep, context));
    const auto bytes = ReadFile(scratch);
    std::error_code ignored;
    fs::remove(scratch, ignored);
    FORESIGHT_CHECK(bytes);
    return Add("last_scan.foresight", *bytes);
  }

  ZipFile& zip_;
  const SupportBundleSources& sources_;
  std::set<std::string> taken_;
  SupportBundleReport report_;
};

}  // namespace

std::string WithoutSecrets(const std::string& text) {
  static const char* kWords[] = {"password", "passphrase", "passwd", "secret", "token"};
  std::string out;
  bool in_key = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
    const std::string line = text.substr(at, end - at + 1);
    at = end + 1;
    const std::string lower = Lower(line);
    const bool key_begins = lower.find("-----begin") != std::string::npos;
    const bool has_word = std::any_of(std::begin(kWords), std::end(kWords), [&](const char* word) {
      return lower.find(word) != std::string::npos;
    });
    if (key_begins) in_key = true;
    out += key_begins || in_key || has_word ? std::string("(removed)\n") : line;
    if (lower.find("-----end") != std::string::npos) in_key = false;
  }
  return out;
}

Result<SupportBundleReport> WriteSupportBundle(const fs::path& path,
                                               const SupportBundleSources& sources,
                                               const RunContext& context) {
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the bundle was cancelled");
  FORESIGHT_TRY(ZipFile zip, ZipFile::Create(path));
  FORESIGHT_TRY(const SupportBundleReport report,
                Bundle(zip, sources).Write(path.string() + ".scan", context));
  FORESIGHT_CHECK(zip.Finish());
  return report;
}

}  // namespace foresight
