#pragma once

#include <string>

#include "app/ctl/fit_subject.h"

namespace foresight {

/// Fits to every source of a scan and writes pictures of each answer, index.html with a table that
/// sets them side by side, and each answer as JSON into `folder`: Fig. 8 and 9 for any scan.
/// `chosen` is the answer that the command line asked for: it is not made twice.
Status WriteFitGallery(const FitSubject& subject, const FitArguments& arguments,
                       const FitAnswer& chosen, const std::string& folder,
                       const RunContext& context);

}  // namespace foresight
