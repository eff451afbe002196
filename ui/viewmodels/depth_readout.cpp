#include "ui/viewmodels/depth_readout.h"

#include <QCoreApplication>
#include <cmath>
#include <limits>

namespace foresight {
namespace {

/// Texts that lupdate finds under this name.
struct DepthReadoutTexts {
  Q_DECLARE_TR_FUNCTIONS(DepthReadoutTexts)
};

struct Nearest {
  double distance_px = std::numeric_limits<double>::infinity();
  RejectReason reason = RejectReason::kKept;
};

/// The nearest sample; with `only_kept` the nearest one that took part.
Nearest NearestSample(const AlignedSamples& samples, int x, int y, bool only_kept) {
  Nearest nearest;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (only_kept && samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& s = samples.samples[i];
    // At whole pixels, as the filters place them: else the edge of a window is told wrong.
    const double distance = std::hypot(std::round(static_cast<double>(s.u)) - x,
                                       std::round(static_cast<double>(s.v)) - y);
    if (distance < nearest.distance_px) nearest = {distance, samples.reasons[i]};
  }
  return nearest;
}

QString RejectedText(const Nearest& nearest) {
  return DepthReadoutTexts::tr("the nearest, %1 px away, was rejected as %2")
      .arg(nearest.distance_px, 0, 'f', 0)
      .arg(QString::fromUtf8(ToString(nearest.reason)));
}

QString WhyEmpty(const ReadoutSource& source, int x, int y) {
  const Nearest any = NearestSample(source.result.samples, x, y, false);
  const bool rejected = any.reason != RejectReason::kKept;
  if (!(source.radius_px > 0.0))
    return rejected ? DepthReadoutTexts::tr("of the lidar samples %1").arg(RejectedText(any))
                    : DepthReadoutTexts::tr("the nearest lidar sample is %1 px away")
                          .arg(any.distance_px, 0, 'f', 0);
  const QString reach = QString::number(source.radius_px, 'f', 0);
  if (rejected && any.distance_px <= source.radius_px)
    return DepthReadoutTexts::tr("no kept lidar sample within %1 px; %2")
        .arg(reach, RejectedText(any));
  if (any.distance_px <= source.radius_px)
    return DepthReadoutTexts::tr("the lidar samples within %1 px agree on no depth").arg(reach);
  return DepthReadoutTexts::tr("no lidar sample within %1 px").arg(reach);
}

QString WhyMasked(const ReadoutSource& source, const DepthReadout& readout) {
  QString why =
      !source.result.dense.has_confidence
          ? DepthReadoutTexts::tr("no lidar line passed here; the method made the depth up")
          : DepthReadoutTexts::tr("below the threshold %1").arg(source.threshold, 0, 'f', 2);
  const Nearest any = NearestSample(source.result.samples, readout.x, readout.y, false);
  const Nearest kept = NearestSample(source.result.samples, readout.x, readout.y, true);
  if (any.reason != RejectReason::kKept && any.distance_px < kept.distance_px)
    why += DepthReadoutTexts::tr("; of the samples %1").arg(RejectedText(any));
  else if (std::isfinite(kept.distance_px))
    why += DepthReadoutTexts::tr("; the nearest sample is %1 px away")
               .arg(kept.distance_px, 0, 'f', 0);
  return why;
}

}  // namespace

double SearchRadius(const DepthResult& result, const DepthOptions& made_with) {
  switch (made_with.method) {
    case DepthMethod::kForesight:
      return made_with.local_plane.radius_in_sigmas * result.dense.sigma_spatial_px;
    case DepthMethod::kPaper:
    case DepthMethod::kJointBilateral:
      return made_with.upsample.radius_in_sigmas * result.dense.sigma_spatial_px;
    case DepthMethod::kTgv:
    case DepthMethod::kNonlocal:
      break;  // every pixel depends on every sample
  }
  return 0.0;
}

DepthReadout ReadDepth(const ReadoutSource& source, int x, int y) {
  const DenseDepth& dense = source.result.dense;
  DepthReadout readout;
  readout.x = x;
  readout.y = y;
  readout.depth_mm = 1e3 * static_cast<double>(source.depth_m(x, y));
  if (std::isnan(readout.depth_mm)) {
    readout.reason = WhyEmpty(source, x, y);
    return readout;
  }
  // In the mask's own arithmetic, so that the words never contradict the hatch.
  const float confidence = dense.confidence(x, y);
  const auto limit = static_cast<float>(source.threshold * dense.max_confidence);
  if (dense.max_confidence > 0.0f)
    readout.confidence = static_cast<double>(confidence / dense.max_confidence);
  readout.relative = dense.max_confidence != 1.0f;
  readout.has_confidence = dense.has_confidence;
  readout.masked = !(confidence >= limit);
  readout.sparse = source.result.BelowDensityFloor();
  if (readout.masked) readout.reason = WhyMasked(source, readout);
  return readout;
}

QString DensityWarning(const DepthResult& result) {
  if (!result.BelowDensityFloor()) return {};
  return DepthReadoutTexts::tr(
             "Only %1\u00a0% of the pixels were measured, under the floor of %2\u00a0%: "
             "do not trust this depth. Scan more slowly.")
      .arg(100.0 * result.density, 0, 'f', 2)
      .arg(100.0 * ScanPrediction::kMinDensity, 0, 'f', 0);
}

QString TextOf(const DepthReadout& readout) {
  const QString at = QStringLiteral("(%1, %2)").arg(readout.x).arg(readout.y);
  if (std::isnan(readout.depth_mm))
    return DepthReadoutTexts::tr("%1  empty: %2").arg(at, readout.reason);
  const QString value =
      !readout.has_confidence
          ? DepthReadoutTexts::tr("%1  %2 mm, this method knows no confidence")
                .arg(at)
                .arg(readout.depth_mm, 0, 'f', 0)
          : (readout.relative ? DepthReadoutTexts::tr("%1  %2 mm, confidence %3 of the largest")
                              : DepthReadoutTexts::tr("%1  %2 mm, confidence %3"))
                .arg(at)
                .arg(readout.depth_mm, 0, 'f', 0)
                .arg(readout.confidence, 0, 'f', 2);
  if (readout.masked) return DepthReadoutTexts::tr("%1  masked: %2").arg(value, readout.reason);
  return readout.sparse
             ? DepthReadoutTexts::tr("%1  not to be trusted: too few samples in this map")
                   .arg(value)
             : value;
}

}  // namespace foresight
