#include "app/ctl/fit_gallery.h"

#include <algorithm>

#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/detection/detection_json.h"
#include "core/detection/facts.h"
#include "core/io/png.h"
#include "core/pictures/depth_picture.h"
#include "core/pictures/detection_picture.h"
#include "core/report/comparison_page.h"

namespace foresight {
namespace {

/// The camera's image, and the depth map where the source is one, both with the answer in them.
struct Pictures {
  ColorImage image;
  ColorImage depth;  ///< empty for raw
};

Pictures PicturesOf(const FitSubject& subject, const FitAnswer& answer) {
  Pictures pictures;
  pictures.image = subject.scan->frame.image;
  if (answer.depth) {
    const DepthResult& depth = *answer.depth;
    pictures.depth = PaintDepth(depth.dense, &depth.mask, DepthLayer::kDepth,
                                DepthRangeOf(depth.dense.depth_m, depth.mask));
  }
  for (ColorImage* picture : {&pictures.image, &pictures.depth}) {
    if (picture->empty()) continue;
    if (answer.detection)
      DrawDetection(*picture, *answer.detection, 0, subject.rig, subject.motor_rad);
    else
      DrawRegion(*picture, subject.roi, subject.rig, subject.motor_rad);
    *picture = AroundRegion(*picture, subject.roi);
  }
  return pictures;
}

std::vector<std::string> RowOf(const std::string& source, const FitAnswer& answer,
                               const SensorRig& rig) {
  std::vector<std::string> row = {SourceTitle(source)};
  if (!answer.detection) {
    row.insert(row.end(), {"nothing found", answer.detection.error().message, "", "", ""});
    return row;
  }
  const auto facts = FactsOf(*answer.detection, 0, rig.robot_from_base);
  const Verdict& verdict = VerdictOf(*answer.detection);
  const std::string pose = facts.size() > 1 ? facts[1].value : std::string();
  row.insert(row.end(),
             {ToString(verdict.level), facts[0].value, pose, ProbabilityText(verdict.probability),
              fmt::format("{:.2f}", OriginOf(*answer.detection).seconds)});
  return row;
}

}  // namespace

Status WriteFitGallery(const FitSubject& subject, const FitArguments& arguments,
                       const FitAnswer& chosen, const std::string& folder,
                       const RunContext& context) {
  FORESIGHT_CHECK(MakeOutputFolder(folder));
  const std::filesystem::path path(folder);
  ComparisonPage page;
  page.title = fmt::format("One region, one {}, every source", ToString(arguments.kind));
  page.summary = fmt::format(
      "Scan {} of {}. The same region and the same fit; only what it looks at differs. Green and "
      "solid is CONFIRMED, orange and dashed LIKELY, thin and grey UNSURE.",
      subject.scan->id, std::filesystem::path(arguments.scan.mission).filename().string());
  page.header = {"Source", "Verdict", "Answer", "Place", "Probability", "Seconds"};
  page.text_columns = 4;
  ComparisonPage::Section section{"Answers", {}};
  // Each map by itself: the beams behind them would make the answers alike.
  std::vector<std::string> sources = SourceNames();
  for (std::size_t i = 1; i < sources.size(); ++i) sources[i] += kAloneSuffix;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::string& source = sources[i];
    const double count = static_cast<double>(sources.size());
    std::optional<FitAnswer> fresh;
    if (source != arguments.source)
      fresh =
          FitIn(subject, arguments, source,
                context.Part(static_cast<double>(i) / count, static_cast<double>(i + 1) / count));
    const FitAnswer& answer = fresh ? *fresh : chosen;
    if (!answer.detection && answer.detection.error().code == ErrorCode::kCancelled)
      return tl::unexpected(answer.detection.error());
    const Pictures pictures = PicturesOf(subject, answer);
    page.rows.push_back(RowOf(source, answer, subject.rig));
    ComparisonPage::Column column{SourceTitle(source), page.rows.back()[1], {}};
    column.pictures.push_back({source + ".png", "in the camera's image"});
    FORESIGHT_CHECK(WritePng(path / (source + ".png"), pictures.image));
    if (!pictures.depth.empty()) {
      column.pictures.push_back({source + "_depth.png", "in the depth map"});
      FORESIGHT_CHECK(WritePng(path / (source + "_depth.png"), pictures.depth));
    }
    if (answer.detection)
      FORESIGHT_CHECK(
          WriteFileAtomically(path / (source + ".json"),
                              DetectionToJson(*answer.detection, subject.rig.robot_from_base)));
    section.columns.push_back(column);
  }
  page.sections = {section};
  return WriteComparisonPage(page, path / "index.html");
}

}  // namespace foresight
