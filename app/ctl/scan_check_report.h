#pragma once

#include <string>

#include "core/selfcheck/check_scan.h"

namespace foresight {

/// What a scan said about itself, as lines of text: the points with their lights, the numbers of
/// the depth, what the scan cannot see, and the advice last.
std::string ScanCheckText(const ScanCheck& check);

/// The depth's part: a table of errors and one of confidences.
std::string DepthCheckText(const DepthCheck& depth);

}  // namespace foresight
