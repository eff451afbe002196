#include "core/mission/scan_part.h"

namespace foresight {

ScanPart PartOf(const Scan& scan, int of_lines) {
  ScanPart part;
  part.lines = static_cast<int>(scan.lines.size());
  part.of_lines = of_lines;
  for (const LidarLine& line : scan.lines) {
    if (!part.seqs.empty() && part.seqs.back().second + 1 == line.seq)
      part.seqs.back().second = line.seq;
    else
      part.seqs.emplace_back(line.seq, line.seq);
  }
  return part;
}

Result<Scan> TakePart(const Scan& scan, const ScanPart& part) {
  Scan taken = scan;
  taken.lines.clear();
  auto run = part.seqs.begin();
  for (std::size_t i = 0; i < scan.lines.size(); ++i) {
    while (run != part.seqs.end() && run->second < scan.lines[i].seq) ++run;
    if (run != part.seqs.end() && run->first <= scan.lines[i].seq)
      taken.lines.push_back(scan.lines.Share(i));
  }
  if (static_cast<int>(taken.lines.size()) != part.lines)
    return Fail(ErrorCode::kInvalidInput,
                "made from {} lines of the scan, of which the file has {}: the rest is missing",
                part.lines, taken.lines.size());
  return taken;
}

}  // namespace foresight
