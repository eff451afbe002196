#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// Rows of numbers as text: a header of column names, then a row a line, separated by commas.
/// Reads a row after the other; the first `names` columns must be those of `header`, in this order,
/// and where `open` is set the last one's values may be many. A text column holds one letter of
/// `letters`, given as its place there. Fails with kBadData, naming file, line and column.
struct NumberTable {
  std::vector<std::string> header;
  bool open = false;    ///< the last column stands for any number of values
  std::string letters;  ///< values that are letters; empty = numbers only
};
Status ReadNumberTable(const std::filesystem::path& path, const NumberTable& table,
                       const std::function<Status(int line, std::span<const double>)>& on_row);

}  // namespace foresight
