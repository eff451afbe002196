#include <memory>

#include "app/ctl/choose_scan.h"
#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/io/png.h"
#include "core/mission/compare_results.h"
#include "core/pictures/depth_picture.h"
#include "core/pictures/difference_picture.h"

namespace foresight {
namespace {

struct CompareArguments {
  std::string first;
  std::string second;
  std::int64_t first_scan = 0;
  std::int64_t second_scan = 0;
  std::string a = kOriginalResult;
  std::string b = kOriginalResult;
  std::optional<std::int64_t> image;
  std::string out;
  bool json = false;
};

Result<ComparedResult> Make(const std::string& file, std::int64_t scan, const std::string& result,
                            std::optional<std::int64_t> image, const RunContext& context) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(file));
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(file));
  FORESIGHT_TRY(const std::int64_t id, ChooseScan(*mission, scan));
  return MakeResultAgain(*mission, review.get(), id, result, image, context);
}

Status WritePictures(const ComparedResult& a, const ComparedResult& b,
                     const ResultComparison& comparison, const std::string& out) {
  FORESIGHT_CHECK(MakeOutputFolder(out));
  const std::filesystem::path folder(out);
  FORESIGHT_CHECK(WriteFileAtomically(folder / "comparison.json", ComparisonToJson(comparison)));
  if (!comparison.depth) return {};
  const DenseDepth &first = a.depth->dense, &second = b.depth->dense;
  const ValueRange range = DepthRangeOf(first.depth_m, a.depth->mask);
  FORESIGHT_CHECK(
      WritePng(folder / "a.png", PaintDepth(first, &a.depth->mask, DepthLayer::kDepth, range)));
  FORESIGHT_CHECK(
      WritePng(folder / "b.png", PaintDepth(second, &b.depth->mask, DepthLayer::kDepth, range)));
  FORESIGHT_CHECK(WritePng(folder / "difference.png",
                           WithLegend(PaintDifference(*comparison.depth, first.depth_m,
                                                      a.depth->mask, second.depth_m, b.depth->mask),
                                      LegendOfDifference(comparison.first, comparison.second))));
  return WriteFileAtomically(folder / "histogram.svg", SvgOf(ChartOfDifference(*comparison.depth)));
}

Result<ExitCode> Compare(const CompareArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const ComparedResult a, Make(arguments.first, arguments.first_scan, arguments.a,
                                             arguments.image, context.Part(0.0, 0.35)));
  const std::string& file = arguments.second.empty() ? arguments.first : arguments.second;
  const std::int64_t scan = arguments.second.empty() && arguments.second_scan == 0
                                ? arguments.first_scan
                                : arguments.second_scan;
  // An image of one scan means nothing in another one.
  const bool one_scan = arguments.second.empty() && scan == arguments.first_scan;
  FORESIGHT_TRY(const ComparedResult b,
                Make(file, scan, arguments.b, one_scan ? arguments.image : std::nullopt,
                     context.Part(0.35, 0.7)));
  FORESIGHT_TRY(const ResultComparison comparison, CompareResults(a, b, context.Part(0.7, 1.0)));
  if (!arguments.out.empty()) FORESIGHT_CHECK(WritePictures(a, b, comparison, arguments.out));
  if (arguments.json) {
    PrintJson(nlohmann::ordered_json::parse(ComparisonToJson(comparison)));
    return ExitCode::kDone;
  }
  std::string text = fmt::format("A: {}\nB: {}", comparison.first, comparison.second);
  for (const std::string& line : ComparisonInWords(comparison)) text += "\n" + line;
  PrintLine(text);
  return ExitCode::kDone;
}

}  // namespace

void AddMissionCompareCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = mission.add_subcommand("compare",
                                             "Two results of a scan, or of two scans: depth maps, "
                                             "clouds and poses set against each other");
  command->add_option("first", arguments->first, "Mission file")->required();
  command->add_option("second", arguments->second, "Mission of B; default: the first");
  command->add_option("--scan", arguments->first_scan, "Scan of A, from 1; default: the last one");
  command->add_option("--second-scan", arguments->second_scan,
                      "Scan of B; default: that of A, the last one in another mission");
  AddOption(*command, "-a,--a", arguments->a,
            "Result A: original, or the name or uuid of a side result");
  AddOption(*command, "-b,--b", arguments->b, "Result B, likewise");
  command->add_option("--image", arguments->image,
                      "Position of the image, from 0; default: nearest to the scope's middle");
  command->add_option("-o,--out", arguments->out,
                      "Folder for the difference map, both depth maps, the histogram and the JSON");
  command->add_flag("--json", arguments->json, "Print as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Compare(*arguments, context); };
  });
}

}  // namespace foresight
