#include "app/ctl/scan_check_report.h"

#include <fmt/format.h>

namespace foresight {
namespace {

std::string ErrorsLine(const std::string& name, const HeldOutErrors& errors) {
  if (errors.beams == 0) return "";
  return fmt::format("  {:<18}{:>8}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.3f}\n", name, errors.beams,
                     1000.0 * errors.q50_m, 1000.0 * errors.q80_m, 1000.0 * errors.q95_m,
                     errors.right);
}

}  // namespace

std::string DepthCheckText(const DepthCheck& depth) {
  std::string text = fmt::format("  {:<18}{:>8}{:>9}{:>9}{:>9}{:>9}\n", "map against beams",
                                 "beams", "50 % mm", "80 % mm", "95 % mm", "right");
  text += ErrorsLine("all", depth.all);
  text += ErrorsLine("scattered", depth.scattered);
  text += ErrorsLine("whole lines", depth.lines);
  for (const HeldOutClass& one : depth.by_edge) text += ErrorsLine(one.name, one.errors);
  for (const HeldOutClass& one : depth.by_distance) text += ErrorsLine(one.name, one.errors);
  text += fmt::format("  {:<18}{:>8}{:>9.1f}{:>9.1f}{:>9.1f}\n", "the map's own", "",
                      1000.0 * depth.map_q50_m, 1000.0 * depth.map_q80_m, 1000.0 * depth.map_q95_m);
  for (const ConfidenceClass& one : depth.by_confidence)
    text += fmt::format("  confidence {:.2f} to {:.2f}: {} beams, {:.3f} promised, {:.3f} right\n",
                        one.from, one.to, one.beams, one.promised, one.right);
  text += fmt::format(
      "  {} beams held out, {:.2f} of them where the mask keeps the map; {} beams do "
      "not count\n",
      depth.left_out, depth.kept, depth.not_counted);
  return text;
}

std::string ScanCheckText(const ScanCheck& check) {
  std::string text;
  for (const CheckPoint& point : check.points) {
    text += fmt::format("{:<10}{}\n", ToString(point.light), point.sentence);
    if (point.name == "depth") text += DepthCheckText(*check.depth);
  }
  for (const std::string& sentence : check.cannot_see)
    text += fmt::format("{:<10}{}\n", "not seen", sentence);
  return text + fmt::format("{:<10}{}", ToString(check.light), check.advice);
}

}  // namespace foresight
