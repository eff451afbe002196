#include "app/ctl/evaluate_pictures.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/depth/depth_method.h"
#include "core/io/png.h"
#include "core/pictures/depth_picture.h"
#include "core/pictures/error_picture.h"
#include "core/pictures/sample_marks.h"
#include "core/pictures/sample_picture.h"

namespace foresight {
namespace {

constexpr double kErrorScale_m = 0.050;
constexpr int kLargestWidth_px = 1000;

/// Letters, digits, '.', '-' and '_' of a name, '_' for the rest.
std::string FileName(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '-' && c != '_'; }, '_');
  return name;
}

}  // namespace

/// Whole factors that bring an image to a size that is good to look at: wide enough for a legend,
/// small enough for a page with many.
struct PictureScale {
  int shrink = 1;
  int grow = 1;

  explicit PictureScale(int width)
      : shrink((width + kLargestWidth_px - 1) / kLargestWidth_px),
        grow(std::max(1, kLargestWidth_px / std::max(1, width))) {}

  int Size(int pixels) const { return std::max(1, pixels / shrink) * grow; }
  /// The pixel of the scene that a pixel of the picture shows.
  int Source(int pixel, int size) const {
    return std::min(pixel / grow * shrink + shrink / 2, size - 1);
  }
  /// The same for rays and samples, between pixels.
  double SourcePlace(double place) const { return (place + 0.5) / grow * shrink - 0.5; }
  double Place(double source) const { return (source + 0.5) / shrink * grow - 0.5; }
};

namespace {

template <class T>
Image<T> Resampled(const Image<T>& image, const PictureScale& scale) {
  Image<T> picture(scale.Size(image.width()), scale.Size(image.height()));
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      picture(x, y) = image(scale.Source(x, image.width()), scale.Source(y, image.height()));
  return picture;
}

AlignedSamples Resampled(AlignedSamples samples, const PictureScale& scale) {
  samples.width = scale.Size(samples.width);
  samples.height = scale.Size(samples.height);
  for (AlignedSample& sample : samples.samples) {
    sample.u = static_cast<float>(scale.Place(static_cast<double>(sample.u)));
    sample.v = static_cast<float>(scale.Place(static_cast<double>(sample.v)));
  }
  return samples;
}

std::string Scores(const DepthAccuracy& accuracy) {
  return fmt::format("A80 {:.1f} mm, A95 {:.1f} mm, coverage {:.3f}", accuracy.a80_mm,
                     accuracy.a95_mm, accuracy.coverage);
}

std::string TitleOf(const MethodScore& score) {
  const auto method = DepthMethodFromName(score.method);
  return method ? InfoOf(*method).title : score.method;
}

PictureLegend DepthLegend(const std::string& line, const ValueRange& range) {
  PictureLegend legend;
  legend.lines = {line};
  legend.bar = {ColorMap::kTurbo, range, "m", false};
  return legend;
}

PictureLegend SamplesLegend(const MethodScore& score, const AlignedSamples& samples) {
  PictureLegend legend;
  legend.lines = {fmt::format("{}, {}: {} samples", score.scene, score.method, score.samples)};
  for (const RejectReason reason : kSampleKinds) {
    const auto count = std::count(samples.reasons.begin(), samples.reasons.end(), reason);
    legend.swatches.push_back({reason == RejectReason::kKept ? kKeptSample : ColorOf(reason),
                               fmt::format("{} {}", ToString(reason), count)});
  }
  return legend;
}

std::vector<std::string> ReportRow(const MethodScore& s) {
  const auto number = [](double value, int decimals) {
    return std::isnan(value) ? std::string("-") : fmt::format("{:.{}f}", value, decimals);
  };
  return {s.scene,
          s.method,
          number(s.with_mask.a80_mm, 1),
          number(s.with_mask.a95_mm, 1),
          number(s.with_mask.coverage, 3),
          number(s.with_mask.unscored_kept, 3),
          number(s.without_mask.a80_mm, 1),
          number(s.without_mask.a95_mm, 1),
          fmt::format("{}", s.samples),
          fmt::format("{}", s.rejected),
          number(s.seconds, 2)};
}

}  // namespace

/// What all pictures of a scene share, so that they can be compared.
struct EvaluationPictures::SceneFrame {
  explicit SceneFrame(const EvaluatedDepth& evaluated)
      : scale(evaluated.guide.width()),
        guide(Resampled(evaluated.guide, scale)),
        truth_m(Resampled(evaluated.truth_m, scale)),
        depth_range(DepthRangeOf(truth_m, MaskImage(truth_m.width(), truth_m.height(), 255))),
        truth_points(Points(truth_m, nullptr, evaluated.ray)),
        view(truth_points.empty() ? CloudView()
                                  : ObliqueViewOf(truth_points, guide.width(), guide.height())) {}

  std::vector<ColoredPoint> Points(const DepthImage& depth_m, const MaskImage* mask,
                                   const RayOfPixel& ray) const {
    return PointsOfDepth(depth_m, mask, guide, [&](const Eigen::Vector2d& pixel) {
      return ray({scale.SourcePlace(pixel.x()), scale.SourcePlace(pixel.y())});
    });
  }

  PictureScale scale;
  ColorImage guide;
  DepthImage truth_m;
  ValueRange depth_range;
  std::vector<ColoredPoint> truth_points;
  CloudView view;
};

Result<ComparisonPage::Picture> EvaluationPictures::Write(const ColorImage& picture,
                                                          const std::string& name,
                                                          const std::string& caption) const {
  const std::string file = FileName(name) + ".png";
  FORESIGHT_CHECK(WritePng(folder_ / file, picture));
  return ComparisonPage::Picture{file, caption};
}

Status EvaluationPictures::AddScene(const EvaluatedDepth& evaluated, const SceneFrame& frame) {
  const std::string& scene = evaluated.score.scene;
  ComparisonPage::Column column{"Truth", "", {}};
  const ColorImage truth =
      WithLegend(PaintDepth(frame.truth_m, nullptr, ColorMap::kTurbo, frame.depth_range),
                 DepthLegend(scene + ": true depth", frame.depth_range));
  column.pictures.resize(3);
  FORESIGHT_TRY(column.pictures[0], Write(truth, scene + "-truth", "true depth"));
  FORESIGHT_TRY(column.pictures[1], Write(frame.guide, scene + "-image", "picture"));
  FORESIGHT_TRY(column.pictures[2], Write(PaintCloud(frame.truth_points, frame.view),
                                          scene + "-truth-view", "true depth, seen from aside"));
  page_.sections.push_back({scene, {column}});
  return {};
}

Status EvaluationPictures::AddMethod(const EvaluatedDepth& evaluated, const SceneFrame& frame) {
  const MethodScore& score = evaluated.score;
  const std::string name = score.scene + "-" + score.method;
  const std::string title = score.scene + ", " + score.method + ": ";
  const std::string scores = Scores(score.with_mask);
  const DepthImage depth_m = Resampled(evaluated.result.dense.depth_m, frame.scale);
  const MaskImage mask = Resampled(evaluated.result.mask, frame.scale);
  const AlignedSamples samples = Resampled(evaluated.result.samples, frame.scale);

  PictureLegend error_legend = LegendOfError(kErrorScale_m);
  error_legend.lines = {title + "error", scores};
  const ColorImage depth =
      WithLegend(PaintDepth(depth_m, &mask, ColorMap::kTurbo, frame.depth_range),
                 DepthLegend(title + "depth, hatched = masked", frame.depth_range));
  const ColorImage error =
      WithLegend(PaintError(depth_m, &mask, frame.truth_m, kErrorScale_m), error_legend);
  const ColorImage view = PaintCloud(frame.Points(depth_m, &mask, evaluated.ray), frame.view);
  const ColorImage sparse = WithLegend(PaintRejections(samples), SamplesLegend(score, samples));

  ComparisonPage::Column column{TitleOf(score), scores, {}};
  column.pictures.resize(4);
  FORESIGHT_TRY(column.pictures[0], Write(depth, name + "-depth", "depth, hatched = masked"));
  FORESIGHT_TRY(column.pictures[1], Write(error, name + "-error", "|depth - truth|, 0 to 50 mm"));
  FORESIGHT_TRY(column.pictures[2], Write(view, name + "-view", "masked depth, seen from aside"));
  FORESIGHT_TRY(column.pictures[3],
                Write(sparse, name + "-samples",
                      fmt::format("{} samples, {} rejected", score.samples, score.rejected)));
  page_.sections.back().columns.push_back(column);
  page_.rows.push_back(ReportRow(score));
  return {};
}

Status EvaluationPictures::Add(const EvaluatedDepth& evaluated) {
  const MethodScore& score = evaluated.score;
  if (!names_.insert(FileName(score.scene + "-" + score.method)).second)
    return Fail(ErrorCode::kInvalidInput,
                "{}: scene '{}' with method '{}' was there before, their pictures would be "
                "overwritten",
                folder_.string(), score.scene, score.method);
  const SceneFrame frame(evaluated);
  if (page_.sections.empty() || page_.sections.back().title != score.scene)
    FORESIGHT_CHECK(AddScene(evaluated, frame));
  return AddMethod(evaluated, frame);
}

Status EvaluationPictures::WritePage() const {
  ComparisonPage page = page_;
  page.title = "Depth methods against ground truth";
  page.summary =
      "Percentiles of |depth - truth| in mm over the pixels that have a truth and that the mask "
      "keeps; coverage is the kept fraction of the pixels with a truth, holes that of the pixels "
      "without one. Each picture opens in full size.";
  page.header = {"scene",       "method",      "A80",     "A95",      "coverage", "holes",
                 "A80 no mask", "A95 no mask", "samples", "rejected", "seconds"};
  page.text_columns = 2;
  return WriteComparisonPage(page, folder_ / "index.html");
}

}  // namespace foresight
