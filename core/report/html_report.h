#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// One page with tables and pictures, readable in any browser without a network, and printable.
struct HtmlReport {
  struct Row {
    std::string name;
    std::string value;
    std::vector<std::string> more = {};  ///< values of further columns
  };
  struct Table {
    std::string title;
    std::vector<Row> rows;
    std::vector<std::string> header = {};  ///< of the columns; empty = none
  };
  struct Picture {
    std::string file;  ///< name in the report's folder, ending in .png
    std::string title;
    std::string caption;
    ColorImage image;  ///< empty = the file is in the folder already
  };

  struct Chart {
    std::string svg;  ///< text of its own, as SvgOf makes it
    std::string caption;
  };

  std::string title;
  std::string summary;  ///< one or two sentences
  std::vector<Table> tables;
  std::vector<Chart> charts;
  std::vector<Picture> pictures;

  /// A part of the page with a heading of its own, behind all others.
  struct Section {
    std::string title;
    std::string text;
    std::vector<Table> tables;
    std::vector<Picture> pictures;  ///< before the tables
  };
  std::vector<Section> sections;
};

/// Writes report.html and the pictures into an existing folder.
Status WriteHtmlReport(const HtmlReport& report, const std::filesystem::path& folder);

}  // namespace foresight
