#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// One page that sets results side by side: a table of numbers, then a section for each subject
/// with one column for each alternative. Readable in any browser without a network. The pictures
/// are files that somebody else writes next to it.
struct ComparisonPage {
  struct Picture {
    std::string file;  ///< in the page's folder; empty = this place stays empty
    std::string caption;
  };
  struct Column {
    std::string title;
    std::string note;               ///< below the title
    std::vector<Picture> pictures;  ///< one a row, the same rows in every column
  };
  struct Section {
    std::string title;
    std::vector<Column> columns;
  };

  std::string title;
  std::string summary;  ///< one or two sentences
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< the first `text_columns` values are no numbers
  std::size_t text_columns = 1;
  std::vector<Section> sections;
};

/// Writes the page, the whole file or nothing. Fails with kIo.
Status WriteComparisonPage(const ComparisonPage& page, const std::filesystem::path& path);

}  // namespace foresight
