#pragma once

#include <QString>

#include "ui/viewmodels/session_model.h"

namespace foresight {

/// What a pane says while no scan is shown and none is on its way. A live mission that was gone on
/// with is not empty: the hint says where its scans are.
QString NoScanHint(const SessionModel& session);

/// "2 scans, 1 object and 3 notes": what a mission held before; empty where it held nothing.
QString EarlierText(const EarlierContents& earlier);
/// "The scan of 14:03:21 was interrupted."; empty where the last one was not.
QString InterruptedText(const EarlierContents& earlier);
/// That the mission holds objects, or notes, from before the restart, and where they are; empty
/// where it does not.
QString EarlierObjectsHint(const SessionModel& session);
QString EarlierNotesHint(const SessionModel& session);

}  // namespace foresight
