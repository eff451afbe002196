#include "app/workstation/review_commands.h"

#include <QCoreApplication>

#include "app/workstation/workbench.h"

namespace foresight {
namespace {

/// Texts that lupdate finds under this name.
struct ReviewCommands {
  Q_DECLARE_TR_FUNCTIONS(Commands)
};

struct Row {
  const char* id;
  const char* icon;
  const char* text;
  const char* tip;
  const char* keys;
  void (*run)(Workbench*);
};

constexpr Row kReplay[] = {
    {"review.play", "timeline_play", QT_TRANSLATE_NOOP("Commands", "Play or pause"),
     QT_TRANSLATE_NOOP("Commands",
                       "Replay the mission under review: lines, images, depth and objects come as "
                       "they came then"),
     "P", [](Workbench* bench) { bench->replay.togglePlaying(); }},
    {"review.previous_event", "timeline_previous", QT_TRANSLATE_NOOP("Commands", "Previous event"),
     QT_TRANSLATE_NOOP("Commands", "Show the moment of the event before, on the timeline"),
     "Ctrl+Left", [](Workbench* bench) { bench->replay.previousEvent(); }},
    {"review.next_event", "timeline_next", QT_TRANSLATE_NOOP("Commands", "Next event"),
     QT_TRANSLATE_NOOP("Commands", "Show the moment of the next event on the timeline"),
     "Ctrl+Right", [](Workbench* bench) { bench->replay.nextEvent(); }},
    {"review.faster", "timeline_faster", QT_TRANSLATE_NOOP("Commands", "Replay faster"),
     QT_TRANSLATE_NOOP("Commands", "Twice as fast, up to 64 times real time"), "Ctrl+Up",
     [](Workbench* bench) { bench->replay.faster(); }},
    {"review.slower", "timeline_slower", QT_TRANSLATE_NOOP("Commands", "Replay slower"),
     QT_TRANSLATE_NOOP("Commands", "Half as fast, down to a quarter of real time"), "Ctrl+Down",
     [](Workbench* bench) { bench->replay.slower(); }}};

constexpr Row kTimeline[] = {
    {"review.zoom_in", "timeline_closer", QT_TRANSLATE_NOOP("Commands", "Timeline closer"),
     QT_TRANSLATE_NOOP("Commands", "Show a shorter part of the timeline (wheel)"),
     "Ctrl+=", [](Workbench* bench) { bench->timeline.zoomIn(); }},
    {"review.zoom_out", "timeline_farther", QT_TRANSLATE_NOOP("Commands", "Timeline farther"),
     QT_TRANSLATE_NOOP("Commands", "Show a longer part of the timeline (wheel)"), "Ctrl+-",
     [](Workbench* bench) { bench->timeline.zoomOut(); }},
    {"review.zoom_all", "", QT_TRANSLATE_NOOP("Commands", "Whole timeline"),
     QT_TRANSLATE_NOOP("Commands", "Show all of the mission on the timeline"), "Ctrl+0",
     [](Workbench* bench) { bench->timeline.showAll(); }},
    {"review.earlier", "", QT_TRANSLATE_NOOP("Commands", "Timeline earlier"),
     QT_TRANSLATE_NOOP("Commands", "Move the timeline to earlier times (drag, Shift and wheel)"),
     "Shift+Left", [](Workbench* bench) { bench->timeline.panEarlier(); }},
    {"review.later", "", QT_TRANSLATE_NOOP("Commands", "Timeline later"),
     QT_TRANSLATE_NOOP("Commands", "Move the timeline to later times (drag, Shift and wheel)"),
     "Shift+Right", [](Workbench* bench) { bench->timeline.panLater(); }}};

void Add(Workbench* bench, const Row& row, std::function<QString()> why_not) {
  bench->commands.Add({.id = row.id,
                       .menu = "review",
                       .icon = row.icon,
                       .text = ReviewCommands::tr(row.text),
                       .tip = ReviewCommands::tr(row.tip),
                       .keys = QString::fromLatin1(row.keys),
                       .run = [bench, run = row.run] { run(bench); },
                       .why_not = std::move(why_not)});
}

}  // namespace

void AddReviewCommands(Workbench* bench) {
  const auto in_review = [bench]() -> QString {
    return bench->ShowsReview()
               ? QString()
               : ReviewCommands::tr("The live session is shown. Show the review first (Ctrl+R).");
  };
  const auto playable = [bench, in_review] {
    const QString live = in_review();
    return live.isEmpty() ? bench->replay.WhyNot() : live;
  };
  for (const Row& row : kReplay) Add(bench, row, playable);
  bench->commands.Add(
      {.id = "review.skip_idle",
       .menu = "review",
       .text = ReviewCommands::tr("Skip idle time"),
       .tip = ReviewCommands::tr("Let the replay jump over time in which nothing "
                                 "happened, to half a second before the next event"),
       .keys = QStringLiteral("Ctrl+Shift+Right"),
       .run = [bench] { bench->replay.toggleSkipsIdle(); },
       .checked = [bench] { return bench->replay.SkipsIdle(); }});
  bench->commands.Add(
      {.id = "review.whole",
       .menu = "review",
       .icon = "timeline_whole",
       .text = ReviewCommands::tr("Leave the replay"),
       .tip = ReviewCommands::tr("Show all of the scan again, with all that was found"),
       .keys = QStringLiteral("Shift+P"),
       .run = [bench] { bench->replay.leave(); },
       .why_not = [bench, in_review]() -> QString {
         const QString live = in_review();
         if (!live.isEmpty()) return live;
         return bench->replay.Active() ? QString()
                                       : ReviewCommands::tr("All of the scan is shown already.");
       }});
  for (const Row& row : kTimeline) Add(bench, row, playable);
  bench->commands.Add(
      {.id = "review.close",
       .menu = "review",
       .text = ReviewCommands::tr("Close the mission"),
       .tip = ReviewCommands::tr("Close the mission that is shown for review; what you "
                                 "found in it is kept beside it"),
       .keys = QStringLiteral("Ctrl+W"),
       .run = [bench] { bench->reviewer.close(); },
       .why_not = [bench, in_review]() -> QString {
         const QString live = in_review();
         if (!live.isEmpty()) return live;
         return bench->reviewer.File() ? QString() : ReviewCommands::tr("No mission is open.");
       }});
}

}  // namespace foresight
