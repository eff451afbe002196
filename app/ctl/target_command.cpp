#include <memory>

#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/calibration/board_print.h"

namespace foresight {
namespace {

struct TargetArguments {
  std::string board = "checkerboard:7x6:30";
  std::string paper = "A4";
  std::string out;
  bool mount = false;
};

Result<ExitCode> WriteTarget(const TargetArguments& arguments) {
  FORESIGHT_TRY(const CalibrationBoard board, CalibrationBoardFromText(arguments.board));
  FORESIGHT_TRY(const Paper paper, PaperFromText(arguments.paper, board));
  FORESIGHT_TRY(const std::string pdf,
                arguments.mount ? TwoBoardMountPdf(board) : BoardPdf(board, paper));
  FORESIGHT_CHECK(WriteFileAtomically(arguments.out, pdf));
  if (arguments.mount) {
    PrintLine(fmt::format("{}: drawing of the mount for two boards", arguments.out));
    return ExitCode::kDone;
  }
  PrintLine(fmt::format(
      "{}: {} on {}, {:.1f} x {:.1f} mm of squares; print at 100 % and measure the "
      "ruler",
      arguments.out, ToText(board), paper.name, 1000.0 * board.Width(), 1000.0 * board.Height()));
  if (board.LooksSameUpsideDown())
    PrintNote(
        "this board looks the same upside down; one of its counts of inner corners should be even "
        "and the other odd");
  return ExitCode::kDone;
}

}  // namespace

void AddTargetCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<TargetArguments>();
  CLI::App* command = app.add_subcommand(
      "target", "Make a calibration board to print, or the drawing of the mount");
  command
      ->add_option("--board", arguments->board,
                   "checkerboard:COLUMNSxROWS:SQUARE_MM or "
                   "charuco:COLUMNSxROWS:SQUARE_MM[:MARKER_MM[:DICTIONARY]], inner corners")
      ->capture_default_str();
  command->add_option("--paper", arguments->paper, "A4, A3, A2, A1, A0, fit, or WIDTHxHEIGHT in mm")
      ->capture_default_str();
  command->add_flag("--mount", arguments->mount, "Draw the mount for two such boards instead");
  command->add_option("--out", arguments->out, "The file (PDF)")->required();
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return WriteTarget(*arguments); };
  });
}

}  // namespace foresight
