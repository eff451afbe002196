#include "ui/viewmodels/chain_solution.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "ui/viewmodels/sentence.h"

namespace foresight {
namespace {

using Level = CalibrationCheck::Level;

/// A board that fits the lidar worse in the mean is one that the lidar's place is wrong for.
constexpr double kBoardMean_m = 0.003;
constexpr int kGoodPoses = 6;
/// Deviations (one sigma) up to the limit are good, up to three times that usable.
constexpr double kUsable = 3.0;

/// Deviations of one kind, and what they may be: the bars of docs/calibration_chain.md.
struct Limit {
  const char* prefix;  ///< of the unknowns' names
  const char* what;
  double limit;
  double scale;
  const char* unit;
  bool over_all = false;  ///< root mean square of them, not the worst
};
const Limit kLimits[] = {
    {"axis turn", QT_TRANSLATE_NOOP("QObject", "The direction of the motor's axis"), 0.035,
     180.0 / M_PI, "deg"},
    {"axis shift", QT_TRANSLATE_NOOP("QObject", "The place of the motor's axis"), 0.8, 1000.0,
     "mm"},
    {"plate angle", QT_TRANSLATE_NOOP("QObject", "Each angle of the plate"), 0.030, 180.0 / M_PI,
     "deg", true},
    {"lidar turn", QT_TRANSLATE_NOOP("QObject", "The lidar's direction"), 0.100, 180.0 / M_PI,
     "deg"},
    {"lidar shift", QT_TRANSLATE_NOOP("QObject", "The lidar's place"), 2.0, 1000.0, "mm"},
    {"range offset", QT_TRANSLATE_NOOP("QObject", "The offset of the ranges"), 4.0, 1000.0, "mm"},
    {"stamp offset", QT_TRANSLATE_NOOP("QObject", "The offset of the lidar's time stamps"), 1.0,
     1000.0, "ms"}};

void CheckDeviations(const ChainCovariance& covariance, std::vector<CalibrationCheck>* checks) {
  for (const Limit& limit : kLimits) {
    double worst = 0.0, squares = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < covariance.unknowns.size(); ++i) {
      if (!covariance.unknowns[i].name.starts_with(limit.prefix)) continue;
      const double sigma = limit.scale * covariance.Sigma(static_cast<int>(i));
      worst = std::max(worst, sigma);
      squares += sigma * sigma;
      ++count;
    }
    if (count == 0) continue;
    const double value = limit.over_all ? std::sqrt(squares / count) : worst;
    checks->push_back({CalibrationCheck::LevelOf(value, limit.limit, kUsable * limit.limit),
                       QObject::tr("%1 is known to ± %2 %4 (limit: ± %3 %4).")
                           .arg(QObject::tr(limit.what))
                           .arg(value, 0, 'g', 2)
                           .arg(limit.limit)
                           .arg(QLatin1String(limit.unit))});
  }
}

void CheckBoards(const ChainSolution& solution, const CalibrationSession& session,
                 std::vector<CalibrationCheck>* checks) {
  const BoardFit* worst = nullptr;
  for (const BoardFit& board : solution.boards)
    if (board.returns > 0 && (worst == nullptr || std::abs(board.mean_m) > std::abs(worst->mean_m)))
      worst = &board;
  if (worst == nullptr) return;
  const double off = std::abs(worst->mean_m);
  checks->push_back(
      {CalibrationCheck::LevelOf(off, kBoardMean_m, kUsable * kBoardMean_m),
       QObject::tr("The lidar misses its worst board (%1, board %2) by %3 mm in the mean (limit: "
                   "%4 mm).")
           .arg(QString::fromStdString(session.poses[static_cast<std::size_t>(worst->pose)].name),
                worst->on_b ? QStringLiteral("B") : QStringLiteral("A"))
           .arg(1000.0 * off, 0, 'f', 1)
           .arg(1000.0 * kBoardMean_m, 0, 'f', 0)});
}

ImageErrors ErrorsOf(const ChainState& state, const CornerSet& corners) {
  ImageErrors errors;
  const std::vector<Eigen::Vector2d> residuals = CornerResiduals(state, corners);
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    errors.pixels.push_back(corners.pixels[i]);
    errors.errors_px.push_back(-residuals[i]);
  }
  return errors;
}

}  // namespace

Result<ChainSolution> SolveSession(const CalibrationSession& session, CalibrationStage stage,
                                   const RunContext& context) {
  ChainCalibrationOptions options;
  options.stage = stage;
  options.noise_from_residuals = true;
  ChainSolution solution;
  FORESIGHT_TRY(solution.found, CalibrateChain(session, options, context));
  const ChainCalibration& found = solution.found;
  solution.coverage = MeasureStand(session, found.rig);
  solution.boards = FitsOfBoards(found);
  solution.points = LidarOnImages(found, session.prior);
  std::map<std::string, int> corners;
  for (const ImageFit& image : found.images) {
    // An image of two boards has two fits.
    double& mean_square = solution.rms_px[image.source];
    int& before = corners[image.source];
    mean_square = (mean_square * before + image.rms_px * image.rms_px * image.corners) /
                  std::max(1, before + image.corners);
    before += image.corners;
  }
  for (auto& [source, value] : solution.rms_px) value = std::sqrt(value);
  for (const CornerSet& set : found.data.corners)
    solution.errors.push_back(ErrorsOf(found.state, set));
  return solution;
}

std::vector<CalibrationCheck> JudgeSolution(const ChainSolution& solution,
                                            const CalibrationSession& session) {
  const ChainCalibration& found = solution.found;
  std::vector<CalibrationCheck> checks;
  checks.push_back({CalibrationCheck::LevelOf(found.mean_error_px, kPaperError_px, kHighError_px),
                    QObject::tr("Mean error of the corners %1 px; the paper's is %2 px.")
                        .arg(found.mean_error_px, 0, 'f', 3)
                        .arg(kPaperError_px, 0, 'f', 3)});
  if (found.covariance)
    CheckDeviations(*found.covariance, &checks);
  else
    checks.push_back({Level::kCaution,
                      QObject::tr("Only \"all together\" tells how well each value is known.")});
  CheckBoards(solution, session, &checks);
  checks.push_back({solution.coverage.poses >= kGoodPoses ? Level::kGood : Level::kCaution,
                    QObject::tr("The stand was at %1 places; %2 are a good number.")
                        .arg(solution.coverage.poses)
                        .arg(kGoodPoses)});
  for (const std::string& note : found.notes) checks.push_back({Level::kCaution, Sentence(note)});
  return checks;
}

}  // namespace foresight
