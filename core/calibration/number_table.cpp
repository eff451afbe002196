#include "core/calibration/number_table.h"

#include <charconv>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/printable.h"

namespace foresight {
namespace {

std::string_view Trimmed(std::string_view text) {
  const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view TakeUntil(std::string_view* rest, char end) {
  const std::size_t at = rest->find(end);
  const std::string_view taken = Trimmed(rest->substr(0, at));
  rest->remove_prefix(at == std::string_view::npos ? rest->size() : at + 1);
  return taken;
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, const NumberTable& table)
      : source_(path.string()), table_(table) {}

  Status Read(std::string_view text,
              const std::function<Status(int line, std::span<const double>)>& on_row) {
    FORESIGHT_CHECK(ReadHeader(&text));
    std::vector<double> values;
    while (!text.empty()) {
      const std::string_view row = TakeUntil(&text, '\n');
      ++line_;
      if (row.empty()) continue;
      FORESIGHT_CHECK(ReadRow(row, &values));
      FORESIGHT_CHECK(on_row(line_, values));
    }
    return {};
  }

 private:
  Status ReadHeader(std::string_view* text) {
    std::string_view header = TakeUntil(text, '\n');
    line_ = 1;
    for (const std::string& name : table_.header) {
      const std::string_view found = TakeUntil(&header, ',');
      if (found != name)
        return Fail(ErrorCode::kBadData, "{}:1: the header says '{}' where '{}' is expected",
                    source_, Printable(found.substr(0, 40)), name);
    }
    return {};
  }

  Status ReadRow(std::string_view row, std::vector<double>* values) {
    values->clear();
    const std::size_t columns = table_.header.size();
    for (bool more = true; more;) {
      more = row.find(',') != std::string_view::npos;
      const std::string_view field = TakeUntil(&row, ',');
      double value = std::nan("");
      if (const std::size_t letter = table_.letters.find(field);
          field.size() == 1 && letter != std::string::npos) {
        value = static_cast<double>(letter);
      } else {
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
        if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
          return Fail(ErrorCode::kBadData, "{}:{}: '{}' in column {} is not a number", source_,
                      line_, Printable(field.substr(0, 40)),
                      table_.header[std::min(values->size(), columns - 1)]);
      }
      values->push_back(value);
    }
    if (values->size() < columns || (!table_.open && values->size() > columns))
      return Fail(ErrorCode::kBadData, "{}:{}: {} values where {} are expected", source_, line_,
                  values->size(), columns);
    return {};
  }

  std::string source_;
  const NumberTable& table_;
  int line_ = 0;
};

}  // namespace

Status ReadNumberTable(const std::filesystem::path& path, const NumberTable& table,
                       const std::function<Status(int line, std::span<const double>)>& on_row) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 29;
  FORESIGHT_TRY(const std::string text, ReadFile(path, kMostBytes));
  return Reader(path, table).Read(text, on_row);
}

}  // namespace foresight
