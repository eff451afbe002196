#pragma once

#include <QString>

#include "ui/viewmodels/session_model.h"

namespace foresight {

/// What a pane of the live document says while no scan is shown and none is on its way. A mission
/// that was gone on with is not empty: the hint says where its scans are.
QString NoScanHint(const SessionModel& session);

}  // namespace foresight
