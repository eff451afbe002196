// Writes docs/fault_matrix.md: what the operator gets for every fault in every state of the head.
#include <cstdio>
#include <future>

#include "core/base/atomic_file.h"
#include "core/base/log.h"
#include "tests/hardware/fault_cell.h"

namespace foresight {
namespace {

std::string Row(const HeadFault& fault) {
  std::vector<std::future<FaultOutcome>> outcomes;
  for (int i = 0; i < kHeadPhases; ++i)
    outcomes.push_back(std::async(std::launch::async, RunFaultCell, std::cref(fault),
                                  static_cast<HeadPhase>(i), HeadAccess::kDirect));
  std::string row = fmt::format("| {} | {} |", fault.device, fault.name);
  for (auto& future : outcomes) {
    const FaultOutcome outcome = future.get();
    row += fmt::format(" {}{} |", outcome.violations.empty() ? "" : "**FAILS** ", outcome.summary);
  }
  return row + "\n";
}

std::string Page() {
  std::string page =
      "# Faults\n\nMade by the target `fault_matrix_page`: real drivers and a real head on "
      "emulated "
      "devices. A column is what the head does\nwhen the fault begins; a cell is what the operator "
      "gets of the scan that was running or came next. In every cell the motor\nends at rest, the "
      "scan is kept and marked, and after the fault the same head homes and executes a complete "
      "scan\n"
      "(tests/hardware/fault_matrix_test.cpp). By night each cell is run once more with a station "
      "at "
      "the far end of a link\n(FaultMatrix.TheSameHoldsAtTheFarEndOfALink): the same is asked of "
      "what the operator sees there, and the station's scan is the\nhead's to the last bit.\n\n"
      "| device | fault |";
  std::string rule = "| --- | --- |";
  for (int i = 0; i < kHeadPhases; ++i) {
    page += fmt::format(" {} |", ToString(static_cast<HeadPhase>(i)));
    rule += " --- |";
  }
  page += "\n" + rule + "\n";
  for (const HeadFault& fault : HeadFaults()) {
    std::fprintf(stderr, "%s: %s\n", fault.device.c_str(), fault.name.c_str());
    page += Row(fault);
  }
  page +=
      "\n## From power-on\n\nThe same for what is wrong with a device from its beginning, a "
      "member of its emulator's fault plan each: the head homes and executes\none scan.\n\n"
      "| device | fault | |\n| --- | --- | --- |\n";
  for (const auto& [fault, outcome] : RunPlannedFaults())
    page += fmt::format("| {} | {} | {}{} |\n", fault->device, fault->name,
                        outcome.violations.empty() ? "" : "**FAILS** ", outcome.summary);
  return page;
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  foresight::SetLogLevel(foresight::LogLevel::kError);
  const auto written = foresight::WriteFileAtomically(argv[1], foresight::Page());
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written ? 0 : 3;
}
