#include "core/evaluation/outline_trial.h"

#include <algorithm>
#include <numeric>

#include "core/detection/image_of_region.h"
#include "core/fitting/solids/image_edges.h"

namespace foresight {
namespace {

constexpr double kApart_px = 4.0;

using Pieces = std::vector<ImageEdges::Piece>;

void AddApart(const Pieces& pieces, const Pieces& others, OutlineResponses& responses) {
  for (const ImageEdges::Piece& piece : pieces) {
    const auto near = [&](const ImageEdges::Piece& other) {
      return (piece.pixel - other.pixel).norm() < kApart_px;
    };
    if (std::none_of(others.begin(), others.end(), near))
      responses.Add(piece.response, piece.length_px);
  }
}

const DrillCandidate* TheOtherWay(const DrillDetection& drill) {
  const auto x = [](const DrillCandidate& candidate) {
    return candidate.base_from_object.Rotate(Eigen::Vector3d::UnitX());
  };
  for (const DrillCandidate& alternative : drill.alternatives)
    if (x(alternative).dot(x(drill.best)) < 0.0) return &alternative;
  return nullptr;
}

}  // namespace

void OutlineResponses::Add(double response, double length_px) {
  const auto above = std::upper_bound(std::begin(kFrom), std::end(kFrom), response);
  length_px_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, above - std::begin(kFrom)) -
                                      1)] += length_px;
}

void OutlineResponses::Add(const OutlineResponses& other) {
  for (std::size_t i = 0; i < kBins; ++i) length_px_[i] += other.length_px_[i];
}

double OutlineResponses::LengthPx() const {
  return std::accumulate(length_px_.begin(), length_px_.end(), 0.0);
}

double OutlineResponses::Fraction(std::size_t bin) const {
  return length_px_[bin] / std::max(1e-9, LengthPx());
}

Status AddOutlinesOf(const FitPopulation& population, std::uint64_t seed, const RunContext& context,
                     OutlineTrial& trial) {
  FORESIGHT_TRY(const FitTrial made, MakeFitTrial(population, seed, {}, context));
  if (!made.scene.positive) return {};
  const ProcessedScan scan{made.rig, made.cloud, {made.frame}};
  const auto found =
      FitInScan(scan, FitSource::kRaw, made.roi, population.Options(made.rig), context);
  if (context.Cancelled())
    return Fail(ErrorCode::kCancelled, "the trial of outlines was cancelled");
  if (!found || !population.Judge(made, found).front().all_ok) return {};
  const auto& drill = std::get<DrillDetection>(*found);
  const DrillCandidate* other = TheOtherWay(drill);
  FORESIGHT_TRY(const RaySet rays, RaysInScan(scan, FitSource::kRaw, made.roi));
  const auto image = ImageOfRegion(scan.frames, made.rig, made.roi, rays, scan.outline_weight);
  if (other == nullptr || image == nullptr) return {};
  const Pieces right = image->PiecesOf(drill.best.model.parts, drill.best.base_from_object);
  const Pieces wrong = image->PiecesOf(other->model.parts, other->base_from_object);
  AddApart(right, wrong, trial.right);
  AddApart(wrong, right, trial.wrong);
  ++trial.scenes;
  return {};
}

}  // namespace foresight
