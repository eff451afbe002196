#include "core/report/comparison_page.h"

#include <algorithm>

#include "core/base/atomic_file.h"
#include "core/base/markup.h"

namespace foresight {
namespace {

constexpr const char* kStyle = R"(
  body { font: 15px/1.45 "DejaVu Sans", sans-serif; color: #1c1f24; background: #f6f7f8; margin: 2em; }
  h1 { font-size: 1.6em; } h2 { font-size: 1.25em; margin: 2em 0 .5em; } p { max-width: 60em; }
  .numbers { border-collapse: collapse; background: #fff; }
  .numbers th, .numbers td { border: 1px solid #d5d9de; padding: .25em .8em; }
  .numbers th { font-weight: 600; background: #eceef1; } .number { text-align: right; font-variant-numeric: tabular-nums; }
  .scene { overflow-x: auto; } .scene table { border-spacing: .6em; margin: 0 -.6em; }
  .scene th { text-align: left; font-weight: normal; vertical-align: bottom; } .scene th b { display: block; }
  .scene td { vertical-align: top; background: #fff; border: 1px solid #d5d9de; padding: .5em; min-width: 17em; }
  .scene td.empty { background: none; border: none; }
  .scene img { width: 100%; display: block; } .caption { color: #555c66; font-size: .87em; padding-top: .3em; }
)";

std::string CellHtml(const char* tag, const std::string& text, bool number) {
  return fmt::format("<{0}{1}>{2}</{0}>", tag, number ? " class=\"number\"" : "",
                     EscapeMarkup(text));
}

std::string RowHtml(const char* tag, const std::vector<std::string>& row,
                    std::size_t text_columns) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < row.size(); ++i) html += CellHtml(tag, row[i], i >= text_columns);
  return html + "</tr>\n";
}

std::string TableHtml(const ComparisonPage& page) {
  std::string html = "<table class=\"numbers\">\n" + RowHtml("th", page.header, page.text_columns);
  for (const auto& row : page.rows) html += RowHtml("td", row, page.text_columns);
  return html + "</table>\n";
}

std::string PictureHtml(const ComparisonPage::Picture& picture) {
  if (picture.file.empty()) return "<td class=\"empty\"></td>";
  return fmt::format(
      "<td><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" loading=\"lazy\"></a><div "
      "class=\"caption\">{1}</div></td>",
      EscapeMarkup(picture.file), EscapeMarkup(picture.caption));
}

std::string SectionHtml(const ComparisonPage::Section& section) {
  std::string html =
      fmt::format("<h2>{}</h2>\n<div class=\"scene\"><table>\n<tr>", EscapeMarkup(section.title));
  std::size_t rows = 0;
  for (const auto& column : section.columns) {
    html +=
        fmt::format("<th><b>{}</b>{}</th>", EscapeMarkup(column.title), EscapeMarkup(column.note));
    rows = std::max(rows, column.pictures.size());
  }
  html += "</tr>\n";
  for (std::size_t row = 0; row < rows; ++row) {
    html += "<tr>";
    for (const auto& column : section.columns)
      html += PictureHtml(row < column.pictures.size() ? column.pictures[row]
                                                       : ComparisonPage::Picture());
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace

Status WriteComparisonPage(const ComparisonPage& page, const std::filesystem::path& path) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}</style></head>\n<body><h1>{0}</h1>\n<p>{2}</p>\n",
      EscapeMarkup(page.title), kStyle, EscapeMarkup(page.summary));
  html += TableHtml(page);
  for (const auto& section : page.sections) html += SectionHtml(section);
  return WriteFileAtomically(path, html + "</body></html>\n");
}

}  // namespace foresight
