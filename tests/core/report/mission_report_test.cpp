#include "core/report/mission_report.h"
#include "core/base/utc_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

#include "core/base/atomic_file.h"
#include "core/depth/depth_method.h"
#include "core/detection/fit_in_scan.h"
#include "core/io/png.h"
#include "core/measure/measurement_json.h"
#include "core/mission/new_records.h"
#include "core/mission/side_result.h"
#include "core/report/report_pages.h"
#include "core/sensor/rig_id.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/synthetic_scan.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two scans; a valve was found in the first and accepted; the log has a warning.
struct MissionReportTest : testing::Test {
  static inline std::unique_ptr<TemporaryFolder> folder;
  static inline std::unique_ptr<MissionFile> mission;
  static inline std::unique_ptr<MissionFile> review;
  static inline Scan scan;
  static inline MissionReportFiles files;

  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    const std::filesystem::path path = *folder / "run <1>.foresight";
    mission = MissionFile::Create(path).value();
    for (const double to_rad : {0.20, 0.12}) {
      Scan added = WallAndValveScan({.from_rad = -0.20, .to_rad = to_rad, .speed_rad_s = 0.15});
      added.uuid = NewUuid();
      const std::int64_t id = mission->BeginScan(added).value();
      for (const LidarLine& line : added.lines) ASSERT_TRUE(mission->AppendLine(id, line));
      ASSERT_TRUE(mission->AppendMotorSamples(id, added.track.samples()));
      for (const CameraFrame& frame : added.frames) ASSERT_TRUE(mission->AppendFrame(id, frame));
      ASSERT_TRUE(mission->EndScan(id, ScanState::kComplete, ""));
      if (id == 1) scan = added;
    }
    AddValve();
    ASSERT_TRUE(mission->AddEvent({0, NowUtc_ns(), "head", "warning", "the lamp is dim", ""}));
    ASSERT_TRUE(mission->AddEvent({0, NowUtc_ns(), "anna", "info", "command head.scan", ""}));
    review = MissionFile::OpenReviewOf(path).value();
    AddNotes();
    RunAgainSettings settings;
    settings.depth = DefaultsOf(DepthMethod::kJointBilateral);
    ASSERT_TRUE(KeepSideResult(*review, "softer", scan, settings,
                               RunAgain(scan, {}, settings, {}).value()));
    std::filesystem::create_directory(*folder / "all");
    files = WriteMissionReport(*mission, review.get(), *folder / "all", {std::nullopt, true}, {})
                .value();
  }
  static void TearDownTestSuite() {
    mission.reset();
    review.reset();
    folder.reset();
  }
  static void AddValve() {
    const CameraFrame& frame = scan.frames.at(0);
    const auto center = scan.rig.camera.Project(scan.rig.CameraFromBase(frame.motor_angle_rad) *
                                                SyntheticValvePose().translation());
    const Roi roi = ImageRoi::Rectangle(frame.motor_angle_rad, *center - Eigen::Vector2d(50, 50),
                                        *center + Eigen::Vector2d(50, 50));
    const FitOptions options = FitOptionsFor(ObjectKind::kValve, scan.rig.robot_from_base);
    const Detection found = FitInScan({scan.rig, RegisterScan(scan, {}).value(), scan.frames},
                                      FitSource::kRaw, roi, options, {})
                                .value();
    DetectionRecord record = NewDetectionRecord(
        scan, found, ProvenanceOfFit(scan, FitSource::kRaw, nullptr, {}, options, roi).value());
    record.scan_id = 1;
    record.author = "anna";
    const std::int64_t id = mission->AddDetection(record).value();
    ASSERT_TRUE(mission->AddDetectionEvent(
        id, {NowUtc_ns(), "bert", DetectionEvent::Action::kAccepted, ""}));
    ASSERT_TRUE(mission->AddDetectionEvent(
        id, {NowUtc_ns(), "bert", DetectionEvent::Action::kRenamed, "main valve"}));
  }
  /// A distance in the first scan, and in the review a note about the mission.
  static void AddNotes() {
    MeasuredPoint a, b;
    a.position_m = {1.0, 0.0, 0.0};
    b.position_m = {1.0, 0.5, 0.0};
    a.scan_uuid = b.scan_uuid = scan.uuid;
    a.line = a.beam = b.line = b.beam = 0;
    NoteRecord measured;
    measured.scan_uuid = scan.uuid;
    measured.kind = kMeasurementKind;
    measured.text = "rim to wall";
    measured.made_by = measured.author = "carl";
    measured.json = MeasurementToJson(Measure(MeasureKind::kDistance, {a, b}, {}).value());
    ASSERT_TRUE(mission->AddNote(measured));
    NoteRecord note;
    note.kind = kNoteKind;
    note.text = "windy all day";
    ASSERT_TRUE(review->AddNote(note));
  }
  static std::string Html() { return ReadFile(*folder / "all" / "report.html").value(); }
};

TEST_F(MissionReportTest, TellsWhatWasFoundByWhomAndWhereItComesFrom) {
  const std::string html = Html();
  for (const std::string& wanted :
       {std::string("main valve"), std::string("accepted by bert"), std::string("anna"),
        std::string("sigma"), std::string("lidar returns"), RigId(scan.rig), scan.uuid,
        std::string("the lamp is dim"), std::string("softer"),
        std::string("method jbu instead of foresight"), std::string("run &lt;1&gt;.foresight"),
        std::string("Settings of the depth map"), std::string("rim to wall: 0.500 m"),
        std::string("windy all day")})
    EXPECT_THAT(html, HasSubstr(wanted));
  EXPECT_THAT(html, Not(HasSubstr("command head.scan")));
  EXPECT_EQ(files.scans, 2);
  EXPECT_EQ(files.objects, 1);
  EXPECT_TRUE(files.left_out.empty()) << files.left_out.front();
}

TEST_F(MissionReportTest, NeedsNothingButThePicturesBesideIt) {
  const std::string html = Html();
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("@media print"));
  const std::regex source("src=\"([^\"]*)\"");
  int pictures = 0;
  for (auto at = std::sregex_iterator(html.begin(), html.end(), source);
       at != std::sregex_iterator(); ++at, ++pictures) {
    const auto image = ReadPng(*folder / "all" / (*at)[1].str());
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_GT(image->width(), 300);
  }
  EXPECT_EQ(pictures, 8);  // image, depth, cloud from above and from aside, of two scans
}

TEST_F(MissionReportTest, TheOutlineOfTheValveIsDrawnOverTheImage) {
  const ColorImage drawn = ReadPng(*folder / "all" / "scan-1-image.png").value();
  ASSERT_EQ(files.files.size(), 10u);
  EXPECT_NE(drawn, scan.frames.at(0).image);
  EXPECT_EQ(ReadPng(*folder / "all" / "scan-2-image.png")->width(), drawn.width());
}

TEST_F(MissionReportTest, ThePdfHasTheSameTextOnNumberedPages) {
  if (std::system("command -v pdftotext > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs pdftotext (poppler-utils)";
  const std::string pdf = *folder / "all" / "report.pdf";
  ASSERT_EQ(std::system(("pdftotext -layout '" + pdf + "' '" + pdf + ".txt'").c_str()), 0);
  const std::string text = ReadFile(pdf + ".txt").value();
  for (const char* wanted : {"main valve", "accepted by bert", "the lamp is dim", "softer",
                             "Cloud from above", "Scan 2", "Settings of the depth map"})
    EXPECT_THAT(text, HasSubstr(wanted));
  EXPECT_GE(std::count(text.begin(), text.end(), '\f'), 4) << "a page for each scan, and the log";
}

TEST_F(MissionReportTest, AReportOfOneScanHasThatScanAlone) {
  const std::filesystem::path one = *folder / "one";
  std::filesystem::create_directory(one);
  const auto written = WriteMissionReport(*mission, nullptr, one, {2, false}, {});
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(written->scans, 1);
  const std::string html = ReadFile(one / "report.html").value();
  EXPECT_THAT(html, HasSubstr("Scan 2"));
  EXPECT_THAT(html, Not(HasSubstr("main valve")));
  EXPECT_THAT(html, Not(HasSubstr("rim to wall")));
  EXPECT_FALSE(std::filesystem::exists(one / "report.pdf"));
}

TEST_F(MissionReportTest, AScanThatIsNotThereIsNamedAndACancelledReportSaysSo) {
  EXPECT_THAT(WriteMissionReport(*mission, nullptr, folder->path(), {9, false}, {}).error().message,
              HasSubstr("no scan 9"));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(WriteMissionReport(*mission, nullptr, folder->path(), {}, context).error().code,
            ErrorCode::kCancelled);
}

TEST(ReportPages, LongTextsAreWrappedAndNothingIsLeftOut) {
  if (std::system("command -v pdftotext > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs pdftotext (poppler-utils)";
  HtmlReport report;
  report.title = "Report";
  HtmlReport::Table table{"Table", {}, {"name", "value", "more"}};
  for (int i = 0; i < 150; ++i)
    table.rows.push_back({fmt::format("row{}", i),
                          std::string(90, 'w') + fmt::format("end{}", i),
                          {"a sentence that is much wider than the column which it stands in, "
                           "so that it takes several lines"}});
  report.tables = {table};
  const TemporaryFolder folder;
  const std::string pdf = folder / "r.pdf";
  ASSERT_TRUE(WriteFileAtomically(pdf, PagesOf(report, folder.path(), {}).value()));
  ASSERT_EQ(std::system(("pdftotext -layout '" + pdf + "'").c_str()), 0);
  const std::string text = ReadFile(folder / "r.txt").value();
  EXPECT_THAT(text, HasSubstr("row0"));
  EXPECT_THAT(text, HasSubstr("row149"));
  EXPECT_THAT(text, HasSubstr("end149"));
  EXPECT_GT(std::count(text.begin(), text.end(), '\f'), 3);
}

}  // namespace
}  // namespace foresight
