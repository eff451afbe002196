#include "ui/viewmodels/import_choices.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "core/io/cloud_table.h"

namespace foresight {
namespace {

/// Texts that lupdate finds under this name.
struct ImportTexts {
  Q_DECLARE_TR_FUNCTIONS(ImportTexts)
};

bool AnyEndsWith(const QStringList& files, const QString& suffix) {
  return std::any_of(files.begin(), files.end(), [&suffix](const QString& file) {
    return QFileInfo(file).suffix().compare(suffix, Qt::CaseInsensitive) == 0;
  });
}

/// Numbers with commas between them; `count` 0 = any number of them.
Result<std::vector<double>> Numbers(const QString& title, const QString& text, int count) {
  std::vector<double> numbers;
  for (const QString& part : text.split(QLatin1Char(','))) {
    bool good = false;
    numbers.push_back(part.trimmed().toDouble(&good));
    if (!good || !std::isfinite(numbers.back()))
      return Fail(ErrorCode::kInvalidOptions, "{}: '{}' is no number", title.toStdString(),
                  part.trimmed().toStdString());
  }
  if (count > 0 && static_cast<int>(numbers.size()) != count)
    return Fail(ErrorCode::kInvalidOptions, "{}: {} numbers with commas between them are needed",
                title.toStdString(), count);
  return numbers;
}

Status TakeNumbers(const ImportField& field, const QString& text, ImportOptions& options) {
  const bool list = field.key == QLatin1String("image-deg") || field.key == QLatin1String("clouds");
  FORESIGHT_TRY(const std::vector<double> numbers, Numbers(field.title, text, list ? 0 : 3));
  if (field.key == QLatin1String("viewpoint")) options.viewpoint = Eigen::Vector3d(numbers.data());
  if (field.key == QLatin1String("up")) options.up = Eigen::Vector3d(numbers.data());
  for (const double number : numbers) {
    if (field.key == QLatin1String("image-deg"))
      options.image_angles_rad.push_back(RadiansFromDegrees(number));
    if (field.key != QLatin1String("clouds")) continue;
    if (number < 1.0 || number > 1e9 || number != std::floor(number))
      return Fail(ErrorCode::kInvalidOptions, "{}: '{}' is no number of a cloud, from 1",
                  field.title.toStdString(), number);
    options.clouds.push_back(static_cast<int>(number));
  }
  if (field.key == QLatin1String("view")) {
    BlankView view;
    view.azimuth_rad = RadiansFromDegrees(numbers[0]);
    view.elevation_rad = RadiansFromDegrees(numbers[1]);
    view.field_rad = RadiansFromDegrees(numbers[2]);
    options.view = view;
  }
  return {};
}

Status Take(const ImportField& field, const QString& text, ImportOptions& options) {
  if (field.key == QLatin1String("rig")) {
    FORESIGHT_TRY(options.rig, LoadSensorRig(text.toStdString()));
  } else if (field.key == QLatin1String("frame")) {
    FORESIGHT_TRY(options.frame, CloudFrameFromText(text.toStdString()));
  } else if (field.key == QLatin1String("unit")) {
    FORESIGHT_TRY(options.unit_m, MetresIn(text.toStdString()));
  } else if (field.key == QLatin1String("kitti-camera")) {
    options.kitti_camera = text.toInt();
  } else if (field.key == QLatin1String("cloud-topic")) {
    options.cloud_topic = text.toStdString();
  } else if (field.key == QLatin1String("image-topic")) {
    options.image_topic = text.toStdString();
  } else {
    return TakeNumbers(field, text, options);
  }
  return {};
}

}  // namespace

ImportKind ImportKindOf(const QStringList& files) {
  if (AnyEndsWith(files, QStringLiteral("bag"))) return ImportKind::kBag;
  return AnyEndsWith(files, QStringLiteral("bin")) ? ImportKind::kKitti : ImportKind::kCloud;
}

QString KeyOf(ImportKind kind) {
  switch (kind) {
    case ImportKind::kKitti:
      return QStringLiteral("kitti");
    case ImportKind::kBag:
      return QStringLiteral("bag");
    case ImportKind::kCloud:
      break;
  }
  return QStringLiteral("cloud");
}

std::vector<ImportField> ImportFieldsOf(ImportKind kind) {
  const auto field = [](const char* key, const QString& title, const QString& tip,
                        const QStringList& values = {}) {
    return ImportField{QString::fromLatin1(key), title, tip, values};
  };
  std::vector<ImportField> fields;
  if (kind == ImportKind::kBag) {
    fields.push_back(field("cloud-topic", ImportTexts::tr("Topic of the clouds"),
                           ImportTexts::tr("Where the bag has several")));
    fields.push_back(field("image-topic", ImportTexts::tr("Topic of the images"),
                           ImportTexts::tr("Where the bag has several")));
    fields.push_back(field("clouds", ImportTexts::tr("Only these clouds"),
                           ImportTexts::tr("Numbers from 1, with commas between them")));
  }
  if (kind == ImportKind::kKitti)
    fields.push_back(field(
        "kitti-camera", ImportTexts::tr("Camera of the calibration"), ImportTexts::tr("P0 to P3"),
        {QStringLiteral("2"), QStringLiteral("0"), QStringLiteral("1"), QStringLiteral("3")}));
  fields.push_back(field("rig", ImportTexts::tr("Rig file"),
                         ImportTexts::tr("The rig that the files were taken with")));
  fields.push_back(field("frame", ImportTexts::tr("Frame of the points"),
                         ImportTexts::tr("robot, or base, lidar, camera of the rig"),
                         {QString(), QStringLiteral("robot"), QStringLiteral("base"),
                          QStringLiteral("lidar"), QStringLiteral("camera")}));
  fields.push_back(field("viewpoint", ImportTexts::tr("Measured from"),
                         ImportTexts::tr("x,y,z in the points' frame, metres")));
  fields.push_back(field("up", ImportTexts::tr("Up"),
                         ImportTexts::tr("x,y,z in the points' frame; without a rig")));
  if (kind == ImportKind::kCloud)
    fields.push_back(field("unit", ImportTexts::tr("Unit of the coordinates"), {},
                           {QStringLiteral("m"), QStringLiteral("cm"), QStringLiteral("mm")}));
  fields.push_back(field("image-deg", ImportTexts::tr("Motor's angle of each image"),
                         ImportTexts::tr("Degrees, with commas between them")));
  fields.push_back(field("view", ImportTexts::tr("Grey image"),
                         ImportTexts::tr("azimuth,elevation,field in degrees: for clouds without "
                                         "an image")));
  return fields;
}

Result<ImportOptions> ImportOptionsFrom(const ImportChoices& choices) {
  ImportOptions options;
  QStringList done;
  for (const ImportKind kind : {ImportKind::kCloud, ImportKind::kKitti, ImportKind::kBag})
    for (const ImportField& field : ImportFieldsOf(kind)) {
      const QString text = choices.value(field.key).trimmed();
      if (text.isEmpty() || done.contains(field.key)) continue;
      done << field.key;
      FORESIGHT_CHECK(Take(field, text, options));
    }
  FORESIGHT_CHECK(options.Check());
  return options;
}

}  // namespace foresight
