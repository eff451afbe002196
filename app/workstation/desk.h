#pragma once

#include "ui/viewmodels/clip_box_model.h"
#include "ui/viewmodels/compare_view_model.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/export_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/layers_view_model.h"
#include "ui/viewmodels/map_view_model.h"
#include "ui/viewmodels/measure_view_model.h"
#include "ui/viewmodels/scan_check_model.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/source_gallery_model.h"

namespace foresight {

/// A document and everything that works on it. The live one and the one for review are two desks
/// that share nothing but the threads of the task queue.
struct Desk {
  Desk(SessionMode mode, TaskQueue* tasks)
      : session(mode, tasks),
        depth(&session),
        compare(&session, &depth),
        fit(&session),
        map(&session),
        measure(&session, &map),
        gallery(&session, &fit),
        exporter(&session),
        check(&session) {}

  SessionModel session;
  DepthViewModel depth;
  LayersViewModel layers;
  CompareViewModel compare;
  FitViewModel fit;
  MapViewModel map;
  MeasureViewModel measure;
  ClipBoxModel clip;
  SourceGalleryModel gallery;
  ExportViewModel exporter;
  ScanCheckModel check;
};

}  // namespace foresight
