// Other programs' files in the window: a mission that is made of them, and what is said of it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/import_choices.h"
#include "ui/viewmodels/import_view_model.h"
#include "ui/viewmodels/review_view_model.h"

namespace foresight {
namespace {

/// 8 turns of 200 points, as KITTI's records.
std::string Turns() {
  std::string bytes;
  for (int ring = 0; ring < 8; ++ring)
    for (int i = 0; i < 200; ++i) {
      const double azimuth = (i + 0.5) * 1.8 * std::numbers::pi / 180.0;
      const float record[4] = {static_cast<float>(6.0 * std::cos(azimuth)),
                               static_cast<float>(6.0 * std::sin(azimuth)),
                               -0.1f * static_cast<float>(ring), 0.25f};
      bytes.append(reinterpret_cast<const char*>(record), sizeof(record));
    }
  return bytes;
}

class ImportInTheWindow : public testing::Test {
 protected:
  ImportInTheWindow() {
    QObject::connect(&session_, &SessionModel::noticed, &session_,
                     [this](const Notice& notice) { said_.push_back(notice); });
    QObject::connect(&importer_, &ImportViewModel::imported, &reviewer_,
                     [this](const QString& mission) {
                       missions_ << mission;
                       reviewer_.Open(mission);
                     });
  }
  void Import(const QStringList& files) {
    importer_.Import(files, QString::fromStdString(folder_.path().string()));
    ASSERT_TRUE(WaitFor([this] { return !importer_.Runner()->Busy() && !reviewer_.Busy(); }));
  }
  QString In(const char* name) const { return QString::fromStdString((folder_ / name).string()); }

  TemporaryFolder folder_;
  TaskQueue tasks_;
  SessionModel session_{SessionMode::kReplay, &tasks_};
  ReviewViewModel reviewer_{&session_};
  ImportViewModel importer_{&session_};
  std::vector<Notice> said_;
  QStringList missions_;
};

TEST_F(ImportInTheWindow, ACloudIsShownForReviewAndWhatWasAssumedIsSaid) {
  ASSERT_TRUE(WriteFileAtomically(folder_ / "sweep.bin", Turns()));
  Import({In("sweep.bin")});
  ASSERT_EQ(missions_.size(), 1);
  EXPECT_EQ(missions_[0], In("sweep-imported.foresight"));
  ASSERT_TRUE(session_.CurrentScan());
  EXPECT_EQ(session_.CurrentScan()->given.lines, 8);
  ASSERT_FALSE(said_.empty());
  EXPECT_EQ(said_[0].level, Notice::Level::kWarning);
  EXPECT_TRUE(said_[0].what.contains("Imported a scan")) << said_[0].what.toStdString();
  Import({In("sweep.bin")});
  ASSERT_EQ(missions_.size(), 2);
  EXPECT_EQ(missions_[1], In("sweep-imported-2.foresight")) << "nothing is written over";
}

TEST_F(ImportInTheWindow, WhatWasChosenIsHowTheFilesAreTaken) {
  std::string text;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 30; ++column)
      text += fmt::format("3000 {} {}\n", 50 * column - 750, 50 * row - 500);
  ASSERT_TRUE(WriteFileAtomically(folder_ / "wall.xyz", text));
  const auto options = ImportOptionsFrom({{"unit", "mm"}, {"viewpoint", "0, 0, 0"}});
  ASSERT_TRUE(options) << options.error().message;
  importer_.Import({In("wall.xyz")}, QString::fromStdString(folder_.path().string()), *options);
  ASSERT_TRUE(WaitFor([this] { return !importer_.Runner()->Busy() && !reviewer_.Busy(); }));
  ASSERT_TRUE(session_.CurrentScan());
  float furthest = 0.0F;
  for (const Eigen::Vector3f& point : session_.CurrentScan()->given.points)
    if (point.allFinite()) furthest = std::max(furthest, point.norm());
  EXPECT_GT(furthest, 2.9F);
  EXPECT_LT(furthest, 4.0F);
}

TEST_F(ImportInTheWindow, AChoiceThatCannotBeIsNamed) {
  const auto message = [](const ImportChoices& choices) {
    const auto options = ImportOptionsFrom(choices);
    return options ? std::string("none") : options.error().message;
  };
  EXPECT_EQ(message({}), "none");
  EXPECT_NE(message({{"viewpoint", "1,2"}}).find("Measured from: 3 numbers"), std::string::npos);
  EXPECT_NE(message({{"image-deg", "1,x"}}).find("'x' is no number"), std::string::npos);
  EXPECT_NE(message({{"clouds", "0"}}).find("from 1"), std::string::npos);
  EXPECT_NE(message({{"rig", "none.yaml"}}).find("none.yaml"), std::string::npos);
  EXPECT_EQ(ImportKindOf({"a.png", "b.BAG"}), ImportKind::kBag);
  EXPECT_EQ(ImportKindOf({"a.bin", "a.png"}), ImportKind::kKitti);
  EXPECT_EQ(ImportKindOf({"a.ply"}), ImportKind::kCloud);
}

TEST_F(ImportInTheWindow, AFileThatIsNoneIsNamed) {
  ASSERT_TRUE(WriteFileAtomically(folder_ / "bad.ply", "hello"));
  Import({In("bad.ply")});
  EXPECT_TRUE(missions_.isEmpty());
  ASSERT_FALSE(said_.empty());
  EXPECT_EQ(said_[0].level, Notice::Level::kError);
  EXPECT_TRUE((said_[0].what + said_[0].next).contains("bad.ply")) << said_[0].what.toStdString();
}

}  // namespace
}  // namespace foresight
