#include "app/workstation/commands.h"

#include <QCoreApplication>

#include "app/workstation/measure_commands.h"
#include "app/workstation/workbench.h"

namespace foresight {
namespace {

/// Texts that lupdate finds under this name.
struct Commands {
  Q_DECLARE_TR_FUNCTIONS(Commands)
};

using Why = std::function<QString()>;

/// The reason only while the condition holds.
Why Because(std::function<bool()> allowed, QString reason) {
  return [allowed = std::move(allowed), reason = std::move(reason)] {
    return allowed() ? QString() : reason;
  };
}

void AddHeadCommands(Workbench* bench) {
  HeadViewModel* head = &bench->head;
  const auto in_review = [bench]() -> QString {
    return bench->ShowsReview()
               ? Commands::tr(
                     "You are looking at a mission under review. Go back to live first (Ctrl+L).")
               : QString();
  };
  bench->commands.Add({.id = "head.scan",
                       .menu = "head",
                       .icon = "scan",
                       .text = Commands::tr("Scan"),
                       .tip = Commands::tr("Start the planned scan"),
                       .keys = QStringLiteral("Space"),
                       .run = [head] { head->scan(); },
                       .why_not =
                           [head, in_review] {
                             const QString review = in_review();
                             return review.isEmpty() ? head->WhyNoScan() : review;
                           }});
  bench->commands.Add({.id = "head.abort",
                       .menu = "head",
                       .icon = "abort",
                       .text = Commands::tr("Abort scan"),
                       .tip = Commands::tr("End the scan and keep what it has"),
                       .keys = QStringLiteral("Shift+Esc"),
                       .run = [head] { head->abort(); },
                       .why_not = Because([head] { return head->CanAbort(); },
                                          Commands::tr("No scan is running."))});
  bench->commands.Add({.id = "head.home",
                       .menu = "head",
                       .icon = "home",
                       .text = Commands::tr("Home"),
                       .tip = Commands::tr("Connect and search the zero reference"),
                       .keys = QStringLiteral("Ctrl+H"),
                       .run = [head] { head->home(); },
                       .why_not = [head] { return head->WhyNoHome(); }});
  bench->commands.Add(
      {.id = "head.stop",
       .menu = "head",
       .icon = "stop",
       .text = Commands::tr("STOP HEAD"),
       .tip = Commands::tr("Stop the scanner's motor at once and keep it stopped. The robot's "
                           "emergency stop is separate."),
       .keys = QStringLiteral("F12"),
       .scope = Command::Scope::kEverywhere,
       .run = [head] { head->stop(); }});
  bench->commands.Add(
      {.id = "head.release",
       .menu = "head",
       .text = Commands::tr("Release stop"),
       .tip = Commands::tr("Let the head move again when it is told to; moves nothing by itself"),
       .keys = QStringLiteral("Ctrl+F12"),
       .run = [head] { head->releaseStop(); },
       .why_not = Because([head] { return head->StopLatched(); },
                          Commands::tr("The head is not stopped."))});
}

void AddToolCommands(Workbench* bench) {
  const auto fit = [bench]() -> FitViewModel& { return bench->Shown().fit; };
  bench->commands.Add({.id = "tool.region",
                       .menu = "object",
                       .icon = "region",
                       .text = Commands::tr("Region"),
                       .tip = Commands::tr("Draw to choose a region"),
                       .keys = QStringLiteral("R"),
                       .in_tool_bar = true,
                       .run = [fit] { fit().setRegionTool(!(fit().Drawing() && !fit().Tool())); },
                       .checked = [fit] { return fit().Drawing() && !fit().Tool(); }});
  struct Tool {
    const char* id;
    const char* icon;
    const char* text;
    const char* tip;
    const char* key;
    ObjectKind kind;
  };
  static constexpr Tool kTools[] = {
      {"tool.valve", "valve", QT_TRANSLATE_NOOP("Commands", "Valve"),
       QT_TRANSLATE_NOOP("Commands", "Draw a region over a valve to fit it"), "V",
       ObjectKind::kValve},
      {"tool.drill", "drill", QT_TRANSLATE_NOOP("Commands", "Drill"),
       QT_TRANSLATE_NOOP("Commands", "Draw a region over a drill to fit it"), "D",
       ObjectKind::kDrill},
      {"tool.terrain", "terrain", QT_TRANSLATE_NOOP("Commands", "Terrain"),
       QT_TRANSLATE_NOOP("Commands", "Draw a region over blocks to fit them"), "T",
       ObjectKind::kTerrain},
      {"tool.handle", "handle", QT_TRANSLATE_NOOP("Commands", "Handle"),
       QT_TRANSLATE_NOOP("Commands", "Draw a region over a door handle to fit it"), "G",
       ObjectKind::kHandle},
      {"tool.cylinder", "cylinder", QT_TRANSLATE_NOOP("Commands", "Cylinder"),
       QT_TRANSLATE_NOOP("Commands", "Draw a region over a pole, a pipe or a bottle to fit it"),
       "Y", ObjectKind::kCylinder}};
  for (const Tool& tool : kTools)
    bench->commands.Add(
        {.id = tool.id,
         .menu = "object",
         .icon = tool.icon,
         .text = Commands::tr(tool.text),
         .tip = Commands::tr(tool.tip),
         .keys = QString::fromLatin1(tool.key),
         .in_tool_bar = true,
         .run = [fit, kind = tool.kind] { fit().SetTool(kind, fit().Tool() != kind); },
         .checked = [fit, kind = tool.kind] { return fit().Tool() == kind; }});
  bench->commands.Add({.id = "tool.leave",
                       .menu = "object",
                       .text = Commands::tr("Leave tool"),
                       .tip = Commands::tr("Back to moving the view"),
                       .keys = QStringLiteral("Esc"),
                       .run = [bench] {
                         bench->Shown().fit.leaveTools();
                         bench->Shown().measure.leave();
                       }});
}

void AddFitCommands(Workbench* bench) {
  bench->commands.Add({.id = "object.fit",
                       .menu = "object",
                       .icon = "fit",
                       .text = Commands::tr("Fit"),
                       .tip = Commands::tr("Fit the object into the region again"),
                       .keys = QStringLiteral("F"),
                       .in_tool_bar = true,
                       .run = [bench] { bench->Shown().fit.fit(); },
                       .why_not = Because([bench] { return bench->Shown().fit.CanFit(); },
                                          Commands::tr("Draw a region over the object first."))});
  bench->commands.Add(
      {.id = "object.compare_sources",
       .menu = "object",
       .icon = "compare",
       .text = Commands::tr("Compare sources"),
       .tip = Commands::tr("Fit to the lidar returns and every depth method, side by side"),
       .keys = QStringLiteral("Shift+F"),
       .run = [bench] { bench->Shown().gallery.start(); },
       .why_not = Because([bench] { return bench->Shown().gallery.CanStart(); },
                          Commands::tr("Draw a region over the object first."))});
  if (bench->robot_fit)
    bench->commands.Add(
        {.id = "object.fit_on_robot",
         .menu = "object",
         .icon = "fit",
         .text = Commands::tr("Fit on robot"),
         .tip = Commands::tr(
             "Have the robot fit in the scan that is still coming: only the pose crosses the link"),
         .keys = QStringLiteral("Ctrl+F"),
         .in_tool_bar = true,
         .run = [bench] { bench->robot_fit->fit(); },
         .why_not = [bench]() -> QString {
           return bench->ShowsReview()
                      ? Commands::tr("The robot fits in live scans. Go back to live.")
                      : bench->robot_fit->WhyNot();
         }});
  const Why none = Because([bench] { return bench->Shown().session.Selected() != nullptr; },
                           Commands::tr("No object is selected."));
  const auto add = [&](const char* id, const char* text, const char* tip, const char* keys,
                       void (*act)(SessionModel&), const char* icon = "") {
    bench->commands.Add({.id = id,
                         .menu = "object",
                         .icon = icon,
                         .text = Commands::tr(text),
                         .tip = Commands::tr(tip),
                         .keys = QString::fromLatin1(keys),
                         .run = [bench, act] { act(bench->Shown().session); },
                         .why_not = none});
  };
  add("object.next", QT_TRANSLATE_NOOP("Commands", "Next answer"),
      QT_TRANSLATE_NOOP("Commands", "Show the next alternative, or the next surface"), "N",
      [](SessionModel& session) { session.nextCandidate(); });
  add("object.previous", QT_TRANSLATE_NOOP("Commands", "Previous answer"),
      QT_TRANSLATE_NOOP("Commands", "Show the alternative or surface before"), "Shift+N",
      [](SessionModel& session) { session.previousCandidate(); });
  add(
      "object.accept", QT_TRANSLATE_NOOP("Commands", "Accept"),
      QT_TRANSLATE_NOOP("Commands", "Keep the decision that this object is right"), "Ctrl+Return",
      [](SessionModel& session) { session.Decide(Decision::kAccepted); }, "confirmed");
  add(
      "object.reject", QT_TRANSLATE_NOOP("Commands", "Reject"),
      QT_TRANSLATE_NOOP("Commands", "Keep the decision that this object is wrong"),
      "Ctrl+Backspace", [](SessionModel& session) { session.Decide(Decision::kRejected); },
      "unsure");
  if (bench->send_pose)
    bench->commands.Add(
        {.id = "object.send",
         .menu = "object",
         .icon = "export",
         .text = Commands::tr("Send to robot"),
         .tip = Commands::tr("Send the accepted pose to the robot; its answer shows here"),
         .keys = QStringLiteral("Ctrl+Shift+Return"),
         .run = [bench] { bench->send_pose->send(); },
         .why_not = [bench]() -> QString {
           return bench->ShowsReview()
                      ? Commands::tr("A pose from a review goes to no robot. Go back to live.")
                      : bench->send_pose->WhyNot();
         }});
  add("object.copy", QT_TRANSLATE_NOOP("Commands", "Copy object"),
      QT_TRANSLATE_NOOP("Commands", "List the object a second time, not decided on"),
      "Ctrl+Shift+D", [](SessionModel& session) { session.CopySelected(); });
  add("object.delete", QT_TRANSLATE_NOOP("Commands", "Delete object"),
      QT_TRANSLATE_NOOP("Commands", "Take the object from the list; the mission keeps its record"),
      "Delete", [](SessionModel& session) { session.RemoveSelected(); });
}

void AddEditCommands(Workbench* bench) {
  const auto undo = [bench] { return bench->Shown().session.Undo(); };
  bench->commands.Add({.id = "edit.undo",
                       .menu = "edit",
                       .icon = "undo",
                       .text = Commands::tr("Undo"),
                       .tip = Commands::tr("Take the last region or decision back"),
                       .keys = QStringLiteral("Ctrl+Z"),
                       .in_tool_bar = true,
                       .run = [undo] { undo()->undo(); },
                       .why_not = Because([undo] { return undo()->CanUndo(); },
                                          Commands::tr("There is nothing to take back."))});
  bench->commands.Add({.id = "edit.redo",
                       .menu = "edit",
                       .text = Commands::tr("Redo"),
                       .tip = Commands::tr("Do again what was taken back"),
                       .keys = QStringLiteral("Ctrl+Shift+Z"),
                       .run = [undo] { undo()->redo(); },
                       .why_not = Because([undo] { return undo()->CanRedo(); },
                                          Commands::tr("There is nothing to do again."))});
}

void AddViewCommands(Workbench* bench) {
  const auto layers = [bench]() -> LayersViewModel& { return bench->Shown().layers; };
  bench->commands.Add(
      {.id = "view.live",
       .menu = "view",
       .text = Commands::tr("Back to live"),
       .tip = Commands::tr("Show the live session again; the mission under review stays open"),
       .keys = QStringLiteral("Ctrl+L"),
       .run = [bench] { bench->backToLive(); },
       .why_not = Because([bench] { return bench->ShowsReview(); },
                          Commands::tr("The live session is shown already."))});
  bench->commands.Add({.id = "view.review",
                       .menu = "view",
                       .text = Commands::tr("Show review"),
                       .tip = Commands::tr("Show the mission that was opened for review"),
                       .keys = QStringLiteral("Ctrl+R"),
                       .run = [bench] { bench->showReview(); },
                       .why_not = [bench]() -> QString {
                         if (bench->ShowsReview())
                           return Commands::tr("The review is shown already.");
                         return bench->reviewer.Path().isEmpty()
                                    ? Commands::tr(
                                          "No mission is open for review. Open one (Ctrl+O).")
                                    : QString();
                       }});
  bench->commands.Add({.id = "view.mask",
                       .menu = "view",
                       .text = Commands::tr("Mask on or off"),
                       .tip = Commands::tr("Hatch the uncertain depths"),
                       .keys = QStringLiteral("M"),
                       .run = [layers] { layers().toggleMask(); }});
  bench->commands.Add({.id = "view.layer",
                       .menu = "view",
                       .text = Commands::tr("Depth or confidence"),
                       .tip = Commands::tr("Change what the depth pane shows"),
                       .keys = QStringLiteral("C"),
                       .run = [layers] { layers().toggleLayer(); }});
  bench->commands.Add(
      {.id = "view.rejected",
       .menu = "view",
       .text = Commands::tr("Rejected samples"),
       .tip = Commands::tr("Show or hide the lidar samples that were rejected, and why"),
       .keys = QStringLiteral("H"),
       .run = [layers] { layers().toggleRejected(); }});
  bench->commands.Add({.id = "log.acknowledge",
                       .menu = "view",
                       .text = Commands::tr("Acknowledge messages"),
                       .tip = Commands::tr("Take note of all warnings and errors in the strip"),
                       .keys = QStringLiteral("Ctrl+K"),
                       .run = [bench] { bench->log.acknowledgeAll(); }});
}

}  // namespace

void AddCommands(Workbench* bench) {
  AddHeadCommands(bench);
  AddToolCommands(bench);
  AddFitCommands(bench);
  AddEditCommands(bench);
  AddViewCommands(bench);
  AddMeasureCommands(bench);
  bench->commands.Add(
      {.id = "recording.continue",
       .menu = "file",
       .text = Commands::tr("Go on in the interrupted mission"),
       .tip = Commands::tr("Record into the mission that the program was recording when it "
                           "ended unexpectedly"),
       .run = [bench] { bench->recording.continueInterrupted(); },
       .why_not = [bench]() -> QString {
         if (bench->recording.Interrupted().isEmpty())
           return Commands::tr("No mission was interrupted.");
         return bench->head.WhyNotDuringScan();
       }});
  bench->commands.Add(
      {.id = "recording.retry",
       .menu = "file",
       .text = Commands::tr("Write the mission again"),
       .tip = Commands::tr("After you have made room: write what is kept in memory"),
       .run = [bench] { bench->recording.tryAgain(); },
       .why_not = Because([bench] { return bench->recording.Waiting() > 0; },
                          Commands::tr("Everything is written."))});
}

}  // namespace foresight
