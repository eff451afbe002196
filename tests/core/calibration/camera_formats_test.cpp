#include "core/calibration/camera_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foresight {
namespace {

using testing::HasSubstr;

CameraModel CameraWith(const Lens& lens) {
  return {.width = 1288,
          .height = 964,
          .fx = 1101.36,
          .fy = 1100.80,
          .cx = 650.3,
          .cy = 477.1,
          .lens = lens};
}

constexpr std::array<CameraFormat, 4> kAll = {CameraFormat::kOpenCv, CameraFormat::kRos,
                                              CameraFormat::kKalibr, CameraFormat::kColmap};

TEST(CameraFormats, WhatIsExportedComesBackToTheSamePixels) {
  for (const Lens& lens :
       {Lens(FisheyeLens{0.9413}), Lens(FisheyeLens{0.0}),
        Lens(KannalaBrandtLens(-0.02, 0.01, -0.001, 0.0002)), Lens(ExtendedUnifiedLens{0.6, 1.1}),
        Lens(RadialTangentialLens(-0.1, 0.02, 1e-3, -5e-4, 0.0)),
        Lens(RadialTangentialLens(-0.1, 0.02, 1e-3, -5e-4, 0.003))})
    for (const CameraFormat format : kAll) {
      const CameraModel camera = CameraWith(lens);
      SCOPED_TRACE(testing::Message() << camera.Key() << " as " << ToString(format));
      const auto written = ExportCamera(camera, format);
      ASSERT_TRUE(written) << written.error().message;
      const auto read = ImportCamera(written->text, format, "file");
      ASSERT_TRUE(read) << read.error().message << "\n" << written->text;
      // A refit may be off by what it states, anything else by rounding.
      const double allowed = written->refit ? written->refit->max_error_px + 1e-9 : 1e-9;
      for (const Eigen::Vector2d& pixel : PixelGrid(camera, 20)) {
        const auto back = read->Project(*camera.Unproject(pixel));
        ASSERT_TRUE(back);
        // Between the refit's own samples the error is a little larger at most.
        EXPECT_LT((*back - pixel).norm(), 1.05 * allowed);
      }
    }
}

TEST(CameraFormats, TheFovModelCarriesKWhereItHasAName) {
  const CameraModel camera = CameraWith(FisheyeLens{0.9413});
  EXPECT_FALSE(ExportCamera(camera, CameraFormat::kColmap)->refit);
  EXPECT_EQ(ExportCamera(camera, CameraFormat::kColmap)->model, "FOV");
  EXPECT_EQ(ExportCamera(camera, CameraFormat::kKalibr)->model, "pinhole-fov");
  const auto ros = ExportCamera(camera, CameraFormat::kRos).value();
  EXPECT_EQ(ros.model, "equidistant");
  ASSERT_TRUE(ros.refit);
  EXPECT_LT(ros.refit->max_error_px, 0.01);
}

TEST(CameraFormats, ColmapCountsPixelsFromTheirCorners) {
  const auto written = ExportCamera(CameraWith(FisheyeLens{0.0}), CameraFormat::kColmap).value();
  EXPECT_THAT(written.text, HasSubstr("1 PINHOLE 1288 964 1101.36 1100.8 650.8 477.6"));
}

TEST(CameraFormats, ReadsWhatOthersWrote) {
  const std::string ros =
      "image_width: 640\nimage_height: 480\ncamera_name: narrow\ncamera_matrix:\n  rows: 3\n  "
      "cols: "
      "3\n  data: [535.4, 0, 320.1, 0, 539.1, 247.6, 0, 0, 1]\ndistortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.29, 0.11, 0.001, -0.0002, 0]\n"
      "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
  const auto camera = ImportCamera(ros, CameraFormat::kRos, "ost.yaml");
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->fx, 535.4);
  EXPECT_EQ(std::get<RadialTangentialLens>(camera->lens).Parameters()[0], -0.29);
}

TEST(CameraFormats, NamesWhatIsWrong) {
  const auto fault = [](const std::string& text, CameraFormat format) {
    const auto camera = ImportCamera(text, format, "file");
    return camera ? std::string("accepted") : camera.error().message;
  };
  EXPECT_THAT(fault("1 THIN_PRISM_FISHEYE 640 480 1 2 3", CameraFormat::kColmap),
              HasSubstr("'THIN_PRISM_FISHEYE' is none of ours"));
  EXPECT_THAT(fault("# nothing", CameraFormat::kColmap), HasSubstr("no camera"));
  EXPECT_THAT(fault("1 PINHOLE 640 480 500 x 320 240", CameraFormat::kColmap),
              HasSubstr("'x' is not a number"));
  EXPECT_THAT(fault("1 PINHOLE 640 480 500 500 320", CameraFormat::kColmap),
              HasSubstr("PINHOLE has 4 parameters, not 3"));
  EXPECT_THAT(fault("cam0: {camera_model: omni, intrinsics: [1], resolution: [640, 480]}",
                    CameraFormat::kKalibr),
              HasSubstr("'omni' is none of ours"));
  EXPECT_THAT(fault("image_width: 640\n", CameraFormat::kRos), HasSubstr("image_height"));
  EXPECT_THAT(CameraFormatFromText("xml").error().message, HasSubstr("format 'xml'"));
}

}  // namespace
}  // namespace foresight
