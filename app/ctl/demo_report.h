#pragma once

#include "app/ctl/demo_sources.h"
#include "app/ctl/true_valve.h"
#include "core/depth/pipeline.h"
#include "core/registration/register_scan.h"
#include "core/report/html_report.h"
#include "core/sensor/scan.h"

namespace foresight {

/// Everything the demo mission found.
struct DemoOutcome {
  Scan scan;
  CameraFrame frame;
  RegisteredScan registered;
  DepthResult depth;
  ValveDetection valve;
  ValveError error;
  HtmlReport::Table sources;  ///< the same region, every source
  std::vector<HtmlReport::Picture> source_pictures;
  std::string mission_file;
};

/// The mission as a page: what was asked, what was seen, what was found, how far from the truth.
HtmlReport ReportOf(const DemoOutcome& outcome);

}  // namespace foresight
