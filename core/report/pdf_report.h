#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/pictures/line_chart.h"

namespace foresight {

/// What a result is, on one sheet of A4 that can be printed and signed.
struct PdfReport {
  struct Row {
    std::string name;
    std::string value;
  };
  struct Table {
    std::string title;
    std::vector<Row> rows;
  };

  std::string title;
  std::string verdict;       ///< one or two sentences
  bool good = false;         ///< a green bar beside the verdict, else an orange one and "!"
  std::vector<Row> subject;  ///< what was measured: session, rig, date
  std::vector<Table> tables;
  std::vector<LineChart> charts;  ///< linear axes; at most three are drawn
};

/// The sheet as PDF. Rows that do not fit on it are counted on its last line; texts that are too
/// long for their column end with "...". Fails with kIo.
Result<std::string> PdfOf(const PdfReport& report);

}  // namespace foresight
