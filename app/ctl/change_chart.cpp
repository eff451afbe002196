#include "app/ctl/change_chart.h"

#include "core/base/atomic_file.h"
#include "core/pictures/line_chart.h"

namespace foresight {

std::string ChangeSvg(const DenseDepth& dense) {
  if (dense.mean_change_m.empty()) return "";
  LineChart chart;
  chart.title = "Change of the depth in each pass";
  chart.x.title = "pass";
  chart.x.whole_numbers = true;
  chart.y.title = "mean |D(t+1) - D(t)|";
  chart.y.unit = "mm";
  chart.y.from_zero = true;
  chart.series.push_back({"change", {}});
  for (const double change_m : dense.mean_change_m) {
    auto& points = chart.series.front().points;
    points.emplace_back(static_cast<double>(points.size() + 1), 1000.0 * change_m);
  }
  return SvgOf(chart);
}

Status WriteChangeChart(const DenseDepth& dense, const std::filesystem::path& folder) {
  const std::string svg = ChangeSvg(dense);
  if (svg.empty()) return {};
  return WriteFileAtomically(folder / "change.svg", svg);
}

nlohmann::ordered_json ChangeJson(const DenseDepth& dense) {
  auto list = nlohmann::ordered_json::array();
  for (const double change_m : dense.mean_change_m) list.push_back(1000.0 * change_m);
  return list;
}

}  // namespace foresight
