#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/report/html_report.h"

namespace foresight {

/// A report's title, summary, tables and pictures as pages of A4, with page numbers: what
/// WriteHtmlReport shows, but for charts. Texts are wrapped, nothing is left out; pictures are
/// shrunk to what a printer shows of them.
/// @param folder where pictures are that the report does not hold itself
/// Fails with kIo, kCancelled, and as ReadPng does.
Result<std::string> PagesOf(const HtmlReport& report, const std::filesystem::path& folder,
                            const RunContext& context);

}  // namespace foresight
