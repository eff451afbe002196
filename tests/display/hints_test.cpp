// What the window says where there is nothing to see yet.
#include <gtest/gtest.h>

#include <QLabel>

#include "tests/ui/synthetic_scan.h"
#include "ui/panels/notes_panel.h"
#include "ui/panels/objects_panel.h"
#include "ui/viewmodels/map_view_model.h"
#include "ui/views/image_pane.h"

namespace foresight {
namespace {

TEST(Hints, TheMissionsObjectsAndNotesOfBeforeAreMentioned) {
  SessionModel session(SessionMode::kSimulation);
  FitViewModel fit(&session);
  MapViewModel map(&session);
  MeasureViewModel measure(&session, &map);
  CommandTable commands;
  for (const char* id : {"object.accept", "object.reject", "object.copy", "object.delete",
                         "object.fit", "measure.tool", "notes.delete"})
    commands.Add({.id = id, .run = [] {}});
  const ObjectsPanel objects(&session, &fit, &commands);
  const NotesPanel notes(&session, &measure, &commands);
  EarlierContents earlier;
  earlier.objects = 2;
  earlier.notes = 1;
  session.SetEarlier(earlier);
  const auto mentions = [](const QWidget& panel, const QString& text) {
    for (const auto* label : panel.findChildren<QLabel*>())
      if (label->text().contains(text)) return true;
    return false;
  };
  EXPECT_TRUE(
      mentions(objects, QStringLiteral("The mission holds 2 objects from before the restart")));
  EXPECT_TRUE(mentions(notes, QStringLiteral("The mission holds 1 note from before the restart")));
}

TEST(Hints, AReviewedScanWithoutAnImageIsSaidToHaveNone) {
  SessionModel session(SessionMode::kReplay);
  FitViewModel fit(&session);
  LayersViewModel layers;
  const ImagePane early(&session, &fit, &layers);
  const auto hint = [](const ImagePane& pane) {
    return pane.findChild<QLabel*>(QStringLiteral("emptyState"))->text().toStdString();
  };
  EXPECT_EQ(hint(early), "Open a mission for review (Ctrl+O), or choose one of its scans");
  Scan scan = WallAndValveScan({.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1});
  scan.frames.clear();
  session.SetScan(std::make_shared<const Scan>(scan));
  const ImagePane late(&session, &fit, &layers);
  EXPECT_EQ(hint(early), "This scan holds no image");
  EXPECT_EQ(hint(late), "This scan holds no image");
}

}  // namespace
}  // namespace foresight
