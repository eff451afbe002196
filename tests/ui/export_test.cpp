#include <gtest/gtest.h>

#include <QTemporaryDir>

#include "core/base/atomic_file.h"
#include "core/depth/depth_method.h"
#include "core/exchange/export_mission.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/export_view_model.h"
#include "ui/viewmodels/mission_objects.h"

namespace foresight {
namespace {

struct ExportTest : testing::Test {
  QTemporaryDir folder;
  QString path = folder.filePath("run 7.foresight");
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  ExportViewModel exporter{&session};
  std::vector<Notice> notices;

  ExportTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
    const Scan scan = WallAndValveScan({.from_rad = -0.05, .to_rad = 0.05, .speed_rad_s = 0.1});
    const auto file = MissionFile::Create(path.toStdString()).value();
    EXPECT_TRUE(AppendScan(file.get(), scan, {}));
    EXPECT_TRUE(file->Close());
  }
  bool Settled() {
    return WaitFor([&] { return !exporter.MissionRunner()->Busy(); });
  }
};

TEST_F(ExportTest, AMissionIsExportedAsForesightctlDoesIt) {
  exporter.ExportMission(path, folder.path());
  ASSERT_TRUE(Settled());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].level, Notice::Level::kInfo) << notices[0].what.toStdString();

  MissionExportOptions options;
  options.depth = DefaultsOf(DepthMethod::kForesight);
  const std::filesystem::path by_core = folder.filePath("by core").toStdString();
  const auto report =
      ExportMission(*MissionFile::OpenReadOnly(path.toStdString()).value(), by_core, options, {})
          .value();
  EXPECT_GT(report.files.size(), 15u);
  for (const std::filesystem::path& file : report.files)
    EXPECT_TRUE(ReadFile(folder.filePath("run 7-export").toStdString() / file).value() ==
                ReadFile(by_core / file).value())
        << file;
}

TEST_F(ExportTest, TwoExportsComeOneAfterTheOther) {
  exporter.ExportMission(path, folder.filePath("a"));
  exporter.ExportMission(path, folder.filePath("b"));
  ASSERT_TRUE(Settled());
  EXPECT_EQ(notices.size(), 2u);
  for (const char* name : {"a/run 7-export/mission.bag", "b/run 7-export/mission.bag"})
    EXPECT_TRUE(std::filesystem::exists(folder.filePath(name).toStdString())) << name;
}

TEST_F(ExportTest, WhatCannotBeExportedIsSaid) {
  exporter.ExportMission(folder.filePath("none.foresight"), folder.path());
  ASSERT_TRUE(Settled());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].level, Notice::Level::kError);
  EXPECT_TRUE(notices[0].what.contains("none.foresight")) << notices[0].what.toStdString();
}

TEST_F(ExportTest, ASupportBundleIsWrittenWithWhatIsAttached) {
  const QString zip = folder.filePath("bundle.zip");
  SupportBundleSources sources;
  sources.mission = path.toStdString();
  sources.attachments = {{"windows/window-1.png", "image"}};
  exporter.WriteBundle(zip, sources);
  ASSERT_TRUE(Settled());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].level, Notice::Level::kInfo) << notices[0].what.toStdString();
  const std::string bytes = ReadFile(zip.toStdString()).value();
  for (const char* name : {"windows/window-1.png", "last_scan.foresight", "contents.txt"})
    EXPECT_NE(bytes.find(name), std::string::npos) << name;
}

TEST_F(ExportTest, ACancelledExportLeavesNoBag) {
  exporter.ExportMission(path, folder.path());
  exporter.MissionRunner()->cancel();
  ASSERT_TRUE(Settled());
  EXPECT_FALSE(std::filesystem::exists(folder.filePath("run 7-export/mission.bag").toStdString()));
}

}  // namespace
}  // namespace foresight
