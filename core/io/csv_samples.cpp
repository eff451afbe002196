#include "core/io/csv_samples.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/base/atomic_file.h"

namespace foresight {
namespace {

constexpr std::array<std::string_view, 5> kColumns = {"line", "beam", "u", "v", "depth_mm"};
enum Column { kLine, kBeam, kU, kV, kDepth };

std::string_view Trimmed(std::string_view text) {
  const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return text;
}

void Split(std::string_view row, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = row.find(',');
    fields.push_back(Trimmed(row.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    row.remove_prefix(comma + 1);
  }
}

/// One text being read; every fault names source:line.
class Parser {
 public:
  Parser(std::string_view text, const std::string& source) : rest_(text), source_(source) {
    // Spreadsheets put a byte order mark in front.
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  Result<std::vector<CsvSample>> Parse() {
    std::vector<CsvSample> samples;
    if (!NextRow()) return Fail(ErrorCode::kBadData, "{}: is empty; a header is needed", source_);
    FORESIGHT_CHECK(FindColumns());
    while (NextRow()) {
      FORESIGHT_TRY(const CsvSample sample, ParseSample());
      samples.push_back(sample);
    }
    return samples;
  }

 private:
  /// Splits the next row that is not blank; false at the end.
  bool NextRow() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      const std::string_view row = Trimmed(rest_.substr(0, end));
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++line_number_;
      if (row.empty()) continue;
      Split(row, fields_);
      return true;
    }
    return false;
  }

  Status FindColumns() {
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
      const auto found = std::find(fields_.begin(), fields_.end(), kColumns[c]);
      if (found == fields_.end())
        return Fail(ErrorCode::kBadData, "{}:{}: the header has no column '{}'", source_,
                    line_number_, kColumns[c]);
      if (std::find(found + 1, fields_.end(), kColumns[c]) != fields_.end())
        return Fail(ErrorCode::kBadData, "{}:{}: the header names column '{}' twice", source_,
                    line_number_, kColumns[c]);
      position_[c] = static_cast<std::size_t>(found - fields_.begin());
    }
    return {};
  }

  Result<CsvSample> ParseSample() {
    CsvSample sample;
    FORESIGHT_TRY(sample.line, Number<int>(kLine));
    FORESIGHT_TRY(sample.beam, Number<int>(kBeam));
    FORESIGHT_TRY(sample.u, Number<double>(kU));
    FORESIGHT_TRY(sample.v, Number<double>(kV));
    FORESIGHT_TRY(sample.depth_mm, Number<double>(kDepth));
    return sample;
  }

  template <class T>
  Result<T> Number(Column column) const {
    const std::size_t position = position_[column];
    if (position >= fields_.size())
      return Fail(ErrorCode::kBadData, "{}:{}: the row has {} fields, '{}' is missing", source_,
                  line_number_, fields_.size(), kColumns[column]);
    const std::string_view field = fields_[position];
    T value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool may_be_negative = column == kU || column == kV;
    if (error != std::errc() || end != field.data() + field.size() ||
        !std::isfinite(static_cast<double>(value)))
      return Fail(ErrorCode::kBadData, "{}:{}: {} '{}' is not a {} number", source_, line_number_,
                  kColumns[column], field.substr(0, 40),
                  std::is_integral_v<T> ? "whole" : "finite");
    if (value < T{0} && !may_be_negative)
      return Fail(ErrorCode::kBadData, "{}:{}: {} '{}' is negative", source_, line_number_,
                  kColumns[column], field.substr(0, 40));
    return value;
  }

  std::string_view rest_;
  const std::string& source_;
  int line_number_ = 0;
  std::vector<std::string_view> fields_;
  std::array<std::size_t, kColumns.size()> position_{};
};

}  // namespace

Result<std::vector<CsvSample>> ParseCsvSamples(std::string_view text, const std::string& source) {
  return Parser(text, source).Parse();
}

Result<std::vector<CsvSample>> ReadCsvSamples(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string text, ReadFile(path));
  return ParseCsvSamples(text, path.string());
}

Status WriteCsvSamples(const std::filesystem::path& path, std::span<const CsvSample> samples) {
  std::string text = "line,beam,u,v,depth_mm\n";
  for (const CsvSample& s : samples)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", s.line, s.beam, s.u, s.v,
                   s.depth_mm);
  return WriteFileAtomically(path, text);
}

}  // namespace foresight
