#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/ctl/true_valve.h"
#include "core/base/run_context.h"
#include "core/depth/pipeline.h"
#include "core/fitting/valve/fit_valve.h"
#include "core/registration/register_scan.h"
#include "core/report/html_report.h"

namespace foresight {

/// What is looked at by every source in turn.
struct DemoSubject {
  const SensorRig& rig;
  const RegisteredScan& cloud;
  const DepthResult& depth;  ///< of the default method
  const CameraFrame& frame;
  const ImageRoi& roi;
  const ValveTruth& truth;
  const World& world;
};

/// One source's answer to the same question.
struct DemoAnswer {
  std::string source;  ///< "raw", or a depth method's name
  Result<ValveDetection> valve;
  std::optional<ValveError> error;  ///< where there is a valve
};

/// The same region fitted to the lidar's returns and to the depth map of every method, Fig. 8 and
/// 9. Fails with kCancelled only: a source that finds nothing is an answer.
Result<std::vector<DemoAnswer>> FitToEverySource(const DemoSubject& subject,
                                                 const RunContext& context);

/// "CONFIRMED (98 %), 2.1 mm and 1.28 deg from the truth, spokes right".
std::string AgainstTruth(const Verdict& verdict, const ValveError& error);

/// Side by side: a row for each, and a picture of the region with its template.
HtmlReport::Table TableOf(const std::vector<DemoAnswer>& answers);
std::vector<HtmlReport::Picture> PicturesOf(const std::vector<DemoAnswer>& answers,
                                            const DemoSubject& subject);

}  // namespace foresight
