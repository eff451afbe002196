#include "core/report/html_report.h"

#include "core/base/atomic_file.h"
#include "core/base/markup.h"
#include "core/io/png.h"

namespace foresight {
namespace {

constexpr const char* kReportStyle = R"(
  body { font: 15px/1.5 "DejaVu Sans", sans-serif; color: #1c1f24; background: #f6f7f8; margin: 2em auto; max-width: 84em; padding: 0 1.5em; }
  h1 { font-size: 1.6em; } h2 { font-size: 1.15em; margin-top: 2em; }
  table { border-collapse: collapse; background: #fff; } td, th { border: 1px solid #d5d9de; padding: .3em .8em; }
  td:first-child { color: #555c66; }
  .pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(34em, 1fr)); gap: 1.5em; }
  figure { margin: 0; background: #fff; border: 1px solid #d5d9de; padding: .8em; } img { width: 100%; }
  figcaption b { display: block; }
  h3 { font-size: 1em; margin-bottom: .4em; } section { border-top: 2px solid #aab1ba; margin-top: 2.5em; }
  @media print {
    @page { size: A4; margin: 14mm; }
    body { font-size: 9pt; background: #fff; margin: 0; padding: 0; max-width: none; }
    .pictures { grid-template-columns: 1fr 1fr; gap: 4mm; } figure, tr { break-inside: avoid; }
    h1, h2, h3 { break-after: avoid; } section + .pictured { break-before: page; } td { overflow-wrap: anywhere; }
  }
)";

std::string TableHtml(const HtmlReport::Table& table, const char* heading = "h2") {
  std::string html = fmt::format("<{0}>{1}</{0}>\n<table>\n", heading, EscapeMarkup(table.title));
  if (!table.header.empty()) {
    html += "<tr>";
    for (const std::string& title : table.header) html += "<th>" + EscapeMarkup(title) + "</th>";
    html += "</tr>\n";
  }
  for (const auto& row : table.rows) {
    html += "<tr><td>" + EscapeMarkup(row.name) + "</td><td>" + EscapeMarkup(row.value) + "</td>";
    for (const std::string& value : row.more) html += "<td>" + EscapeMarkup(value) + "</td>";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string PictureHtml(const HtmlReport::Picture& picture) {
  return fmt::format(
      "<figure><img src=\"{0}\" alt=\"{1}\"><figcaption><b>{1}</b>{2}</figcaption></figure>\n",
      EscapeMarkup(picture.file), EscapeMarkup(picture.title), EscapeMarkup(picture.caption));
}

Status WritePicture(const HtmlReport::Picture& picture, const std::filesystem::path& folder) {
  if (picture.image.empty()) return {};
  return WritePng(folder / picture.file, picture.image);
}

std::string SectionHtml(const HtmlReport::Section& section) {
  std::string html = section.pictures.empty() ? "<section>" : "<section class=\"pictured\">";
  html += "<h2>" + EscapeMarkup(section.title) + "</h2>\n";
  if (!section.text.empty()) html += "<p>" + EscapeMarkup(section.text) + "</p>\n";
  if (!section.pictures.empty()) html += "<div class=\"pictures\">\n";
  for (const auto& picture : section.pictures) html += PictureHtml(picture);
  if (!section.pictures.empty()) html += "</div>\n";
  for (const auto& table : section.tables) html += TableHtml(table, "h3");
  return html + "</section>\n";
}

}  // namespace

Status WriteHtmlReport(const HtmlReport& report, const std::filesystem::path& folder) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta "
      "charset=\"utf-8\"><title>{0}</title><style>{1}</style></head>\n"
      "<body><h1>{0}</h1>\n<p>{2}</p>\n",
      EscapeMarkup(report.title), kReportStyle, EscapeMarkup(report.summary));
  for (const auto& table : report.tables) html += TableHtml(table);
  const bool has_figures = !report.charts.empty() || !report.pictures.empty();
  if (has_figures) html += "<h2>Pictures</h2>\n<div class=\"pictures\">\n";
  for (const auto& chart : report.charts)
    html += "<figure>" + chart.svg + "<figcaption>" + EscapeMarkup(chart.caption) +
            "</figcaption></figure>\n";
  for (const auto& picture : report.pictures) {
    FORESIGHT_CHECK(WritePicture(picture, folder));
    html += PictureHtml(picture);
  }
  if (has_figures) html += "</div>\n";
  for (const auto& section : report.sections) {
    for (const auto& picture : section.pictures) FORESIGHT_CHECK(WritePicture(picture, folder));
    html += SectionHtml(section);
  }
  html += "</body></html>\n";
  return WriteFileAtomically(folder / "report.html", html);
}

}  // namespace foresight
