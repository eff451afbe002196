#pragma once

#include <memory>

#include "ui/viewmodels/compare_view_model.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/export_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/layers_view_model.h"
#include "ui/viewmodels/live_depth_view_model.h"
#include "ui/viewmodels/mission_view_model.h"
#include "ui/viewmodels/scan_flow.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/source_gallery_model.h"

namespace foresight {

/// All view-models of the workstation, wired to each other and to one head.
struct Workbench {
  Workbench(std::shared_ptr<SensorHead> head, SessionMode mode);

  SessionModel session;
  HeadViewModel head;
  DepthViewModel depth;
  LayersViewModel layers;
  CompareViewModel compare;
  FitViewModel fit;
  SourceGalleryModel gallery;
  MissionViewModel mission;
  ExportViewModel exporter;
  ScanFlow flow;
  LiveDepthViewModel live;

  /// Nothing runs and the last scan has its depth.
  bool Idle();
};

}  // namespace foresight
