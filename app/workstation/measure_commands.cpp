#include "app/workstation/measure_commands.h"

#include <QCoreApplication>

#include "app/workstation/workbench.h"

namespace foresight {
namespace {

/// Texts that lupdate finds under this name.
struct MeasureCommands {
  Q_DECLARE_TR_FUNCTIONS(MeasureCommands)
};

QString TipOf(MeasureKind kind) {
  switch (kind) {
    case MeasureKind::kPoint:
      return MeasureCommands::tr("Click one point: where it is in the robot's frame");
    case MeasureKind::kDistance:
      return MeasureCommands::tr("Click two points");
    case MeasureKind::kAngle:
      return MeasureCommands::tr("Click three points: the angle at the second one");
    case MeasureKind::kPlaneDistance:
      return MeasureCommands::tr("Click a flat place or draw a box over it, then click a point");
    case MeasureKind::kHeight:
      break;
  }
  return MeasureCommands::tr("Click one point; the ground is found in the scan");
}

/// Stable, for tests and the journal.
const char* IdOf(MeasureKind kind) {
  switch (kind) {
    case MeasureKind::kPoint:
      return "measure.point";
    case MeasureKind::kDistance:
      return "measure.distance";
    case MeasureKind::kAngle:
      return "measure.angle";
    case MeasureKind::kPlaneDistance:
      return "measure.plane_distance";
    case MeasureKind::kHeight:
      break;
  }
  return "measure.height";
}

QString WhyNoMap(Workbench* bench) {
  const bool none =
      bench->ShowsReview() ? bench->reviewer.Scans().empty() : bench->recording.Scans().empty();
  return none ? MeasureCommands::tr("The mission holds no scan.") : bench->Shown().map.WhyNoMap();
}

}  // namespace

void AddMapFileCommands(Workbench* bench, const AskForFile& ask) {
  bench->commands.Add(
      {.id = "map.make_with_odometry",
       .menu = "measure",
       .text = MeasureCommands::tr("Make map with odometry"),
       .tip = MeasureCommands::tr(
           "Bring the scans together from where a file (CSV: scan,x_m,y_m,z_m,qw,qx,qy,qz) says "
           "that the robot stood"),
       .run =
           [bench, ask] {
             ask(MeasureCommands::tr("Make the map with the robot's odometry"),
                 MeasureCommands::tr("Odometry (*.csv)"),
                 // The mission is the one that was shown when the file was asked for.
                 [map = &bench->Shown().map, mission = bench->ShownMission()](const QString& file) {
                   map->Make(mission, file);
                 });
           },
       .why_not = [bench] { return WhyNoMap(bench); }});
}

void AddMeasureCommands(Workbench* bench) {
  const auto measure = [bench]() -> MeasureViewModel& { return bench->Shown().measure; };
  const auto notes = [bench]() -> NotesModel& { return *bench->Shown().session.Notes(); };
  bench->commands.Add({.id = "measure.tool",
                       .menu = "measure",
                       .icon = "measure",
                       .text = MeasureCommands::tr("Measure"),
                       .tip = MeasureCommands::tr("Click measured points in cloud, depth or image"),
                       .keys = QStringLiteral("L"),
                       .in_tool_bar = true,
                       .run = [measure] { measure().toggle(); },
                       .checked = [measure] { return measure().On(); }});
  for (const MeasureKind kind : kMeasureKinds)
    bench->commands.Add(
        {.id = IdOf(kind),
         .menu = "measure",
         .text = NameOf(kind),
         .tip = TipOf(kind),
         .run = [measure, kind] { measure().SetKind(kind); },
         .checked = [measure, kind] { return measure().On() && measure().Kind() == kind; }});
  bench->commands.Add(
      {.id = "measure.back",
       .menu = "measure",
       .text = MeasureCommands::tr("Take point back"),
       .tip = MeasureCommands::tr("Take back the point that was clicked last, or the plane"),
       .keys = QStringLiteral("Backspace"),
       .run = [measure] { measure().back(); },
       .why_not =
           [measure] {
             return measure().CanTakeBack() ? QString()
                                            : MeasureCommands::tr("No point was taken yet.");
           }});
  bench->commands.Add(
      {.id = "map.make",
       .menu = "measure",
       .text = MeasureCommands::tr("Make map"),
       .tip = MeasureCommands::tr("Bring the scans of the mission that is shown together"),
       .run = [bench] { bench->Shown().map.Make(bench->ShownMission()); },
       .why_not = [bench] { return WhyNoMap(bench); }});
  bench->commands.Add({.id = "map.cancel",
                       .menu = "measure",
                       .text = MeasureCommands::tr("Cancel map"),
                       .tip = MeasureCommands::tr("Stop making the map, or looking for changes"),
                       .run = [bench] { bench->Shown().map.cancel(); },
                       .why_not =
                           [bench] {
                             return bench->Shown().map.Busy()
                                        ? QString()
                                        : MeasureCommands::tr("No map is being made.");
                           }});
  bench->commands.Add({.id = "view.clip_box",
                       .menu = "view",
                       .text = MeasureCommands::tr("Clip box"),
                       .tip = MeasureCommands::tr("Draw only what is inside a box in the cloud"),
                       .keys = QStringLiteral("K"),
                       .run = [bench] { bench->Shown().clip.toggle(); },
                       .checked = [bench] { return bench->Shown().clip.On(); }});
  bench->commands.Add(
      {.id = "notes.delete",
       .menu = "measure",
       .text = MeasureCommands::tr("Delete note"),
       .tip = MeasureCommands::tr("Delete the measurement or note that is selected"),
       .keys = QStringLiteral("Shift+Delete"),
       .run = [notes] { notes().removeSelected(); },
       .why_not =
           [notes] {
             return notes().Selected() != nullptr ? QString()
                                                  : MeasureCommands::tr("No note is selected.");
           }});
}

}  // namespace foresight
