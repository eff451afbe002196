#include "ui/viewmodels/camera_calibration_model.h"

#include <fmt/format.h>

#include <QDateTime>
#include <QDir>
#include <QLocale>
#include <QStandardPaths>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/io/image_file.h"
#include "core/io/png.h"
#include "ui/viewmodels/sentence.h"

namespace foresight {
namespace {

const QString kUndoTopic = QStringLiteral("camera calibration");
constexpr int kThumbnailWidth = 96;
constexpr int kMinImages = 4;

// Limits of the verdict.
/// Images that were not used are predicted nearly as well as those that were.
constexpr double kGoodPrediction = 1.10;
/// Relative standard deviation of the focal length: 1.2 px of 600, and what is hardly of use.
constexpr double kGoodFocalSigma = 0.002;
constexpr double kBadFocalSigma = 0.010;
constexpr double kGoodCoverage = 0.80;
constexpr double kBadCoverage = 0.50;
constexpr int kGoodNumber = 15;

GrayImage ThumbnailOf(const GrayImage& image) {
  if (image.empty()) return {};
  const int width = std::min(kThumbnailWidth, image.width());
  const int height = std::max(1, width * image.height() / image.width());
  GrayImage small(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int left = x * image.width() / width, right = (x + 1) * image.width() / width;
      const int top = y * image.height() / height, bottom = (y + 1) * image.height() / height;
      int sum = 0;
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) sum += image(u, v);
      small(x, y) = static_cast<std::uint8_t>(sum / std::max(1, (right - left) * (bottom - top)));
    }
  return small;
}

/// "fx 601.234 ± 0.051 px", one a line.
QString ParametersOf(const ModelCalibration& model) {
  const std::vector<std::string_view> names = model.camera.ParameterNames();
  const CameraModel::Parameters values = model.camera.Values();
  QStringList lines;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const char* unit = i < 4 ? " px" : "";
    std::string line = fmt::format("{} {:.6g}", names[i], values[at]);
    if (model.covariance) line += fmt::format(" ± {:.2g}", model.covariance->ValueSigmas()[at]);
    lines << QString::fromStdString(line + unit);
  }
  if (model.warp_estimated)
    lines << QString::fromStdString(fmt::format("board bent by {:.2f} and {:.2f} mm",
                                                1000.0 * model.warp.x_m, 1000.0 * model.warp.y_m));
  return lines.join(QLatin1Char('\n'));
}

QString TitleOf(LensModel model) {
  CameraModel camera;
  camera.lens = StartLens(model);
  return model == LensModel::kFisheyeK ? CameraCalibrationModel::tr("fisheye with k")
                                       : QString::fromStdString(std::string(camera.Name()));
}

using Level = CalibrationCheck::Level;

CalibrationCheck CheckError(const ModelCalibration& m) {
  return {CalibrationCheck::LevelOf(m.mean_error_px, kPaperError_px, kHighError_px),
          CameraCalibrationModel::tr("Mean error %1 px; the paper's is %2 px.")
              .arg(m.mean_error_px, 0, 'f', 3)
              .arg(kPaperError_px, 0, 'f', 3)};
}

CalibrationCheck CheckPrediction(const ModelCalibration& m) {
  if (!std::isfinite(m.cross_validation_px))
    return {Level::kCaution, CameraCalibrationModel::tr("Too few images for a cross-validation.")};
  const bool good = m.cross_validation_px <= kGoodPrediction * m.mean_error_px;
  return {good ? Level::kGood : Level::kCaution,
          CameraCalibrationModel::tr("Images that were not used are predicted to %1 px%2.")
              .arg(m.cross_validation_px, 0, 'f', 3)
              .arg(good ? CameraCalibrationModel::tr(", as well as those that were")
                        : CameraCalibrationModel::tr(", worse than those that were: more images "
                                                     "help"))};
}

CalibrationCheck CheckFocal(const ModelCalibration& m) {
  if (!m.covariance)
    return {Level::kBad, CameraCalibrationModel::tr("The focal length is not observable.")};
  const CameraModel::Parameters sigmas = m.covariance->ValueSigmas();
  const double relative = std::max(sigmas[0] / m.camera.fx, sigmas[1] / m.camera.fy);
  return {CalibrationCheck::LevelOf(relative, kGoodFocalSigma, kBadFocalSigma),
          CameraCalibrationModel::tr("The focal length %1 px is known to ± %2 px (limit: ± %3).")
              .arg(m.camera.fx, 0, 'f', 1)
              .arg(std::max(sigmas[0], sigmas[1]), 0, 'f', 2)
              .arg(kGoodFocalSigma * m.camera.fx, 0, 'f', 1)};
}

CalibrationCheck CheckCoverage(const ViewCoverage& coverage) {
  const double covered = coverage.CoveredFraction();
  return {CalibrationCheck::LevelOf(-covered, -kGoodCoverage, -kBadCoverage),
          CameraCalibrationModel::tr("Corners cover %1 % of the image (limit: %2 %).")
              .arg(100.0 * covered, 0, 'f', 0)
              .arg(100.0 * kGoodCoverage, 0, 'f', 0)};
}

CalibrationCheck CheckNumber(const ViewCoverage& coverage) {
  return {coverage.images >= kGoodNumber ? Level::kGood : Level::kCaution,
          CameraCalibrationModel::tr("%1 images are used; 15 to 30 are a good number.")
              .arg(coverage.images)};
}

}  // namespace

CameraCalibrationModel::CameraCalibrationModel(HeadViewModel* head, SessionModel* session,
                                               const QString& folder, QObject* parent)
    : QObject(parent),
      head_(head),
      session_(session),
      root_(folder),
      rig_(head, session),
      captures_(head),
      live_(head, session->Tasks()) {
  for (TaskRunner* runner : {&reader_, &solver_, &mapper_, &keeper_})
    connect(runner, &TaskRunner::changed, this, &CameraCalibrationModel::changed);
  connect(&captures_, &HeadCaptures::changed, this, &CameraCalibrationModel::changed);
  connect(&captures_, &HeadCaptures::captured, this,
          [this](const std::shared_ptr<const StopCapture>& capture) {
            if (capture->image) AddFromHead(capture->image->image, capture->position.angle_rad);
          });
  connect(&captures_, &HeadCaptures::stopsEnded, this, [this](bool, const QString& reason) {
    if (!reason.isEmpty())
      session_->Report({Notice::Level::kWarning, tr("No image was captured: %1.").arg(reason),
                        tr("Try again.")});
  });
  live_.SetBoard(board_);
  connect(&rig_, &RigVersionModel::changed, this, &CameraCalibrationModel::changed);
  connect(session_, &SessionModel::imageChanged, this, &CameraCalibrationModel::changed);
}

CameraCalibrationModel::~CameraCalibrationModel() {
  session_->Undo()->Forget(kUndoTopic);
}

QString CameraCalibrationModel::DefaultFolder() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation))
      .filePath(QStringLiteral("calibrations"));
}

QString CameraCalibrationModel::Root() const {
  return root_.isEmpty() ? DefaultFolder() : root_;
}

QString CameraCalibrationModel::LastSession() const {
  // Names begin with the date and the time.
  const QStringList names =
      QDir(Root()).entryList({QStringLiteral("camera-*")}, QDir::Dirs, QDir::Name | QDir::Reversed);
  for (const QString& name : names) {
    const QString path = QDir(Root()).filePath(name);
    if (path != folder_ && IsCameraSession(path.toStdString())) return path;
  }
  return {};
}

void CameraCalibrationModel::MakeFolder() {
  if (!folder_.isEmpty()) return;
  const QString now = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd-HHmmss"));
  folder_ = QDir(Root()).filePath(QStringLiteral("camera-") + now);
  for (int i = 2; QDir(folder_).exists(); ++i)
    folder_ = QDir(Root()).filePath(QStringLiteral("camera-%1-%2").arg(now).arg(i));
  QDir().mkpath(QString::fromStdString(CameraSessionImages(folder_.toStdString()).string()));
  rig_.SetFolder(folder_);
}

void CameraCalibrationModel::Clear() {
  reader_.cancel();
  solver_.cancel();
  ++session_version_;  // answers that are on their way are of no image any more
  ++solve_version_;
  entries_.clear();
  folder_.clear();
  next_number_ = 1;
  result_.reset();
  maps_.reset();
  chosen_ = -1;
  failure_.clear();
  keep_wanted_ = solve_wanted_ = false;
  rig_.SetFolder({});
  rig_.Forget();
  session_->Undo()->Forget(kUndoTopic);
}

void CameraCalibrationModel::startNew() {
  Clear();
  SortImages();
  Announce();
}

void CameraCalibrationModel::OpenSession(const QString& folder) {
  const auto work = [path = folder.toStdString()](const RunContext&) {
    return LoadCameraSession(path);
  };
  reader_.Run<CameraSession>(
      tr("Opening the calibration"), work, [this, folder](Result<CameraSession> loaded) {
        if (!loaded) {
          session_->Report(NoticeOf(tr("Opening the calibration"), loaded.error()));
          return;
        }
        Clear();
        folder_ = folder;
        rig_.SetFolder(folder);
        board_ = loaded->board;
        live_.SetBoard(board_);
        models_ = loaded->models;
        for (const CameraSessionImage& image : loaded->images) {
          entries_.push_back({.kept = image, .on_disk = true});
          next_number_ = std::max(next_number_, std::atoi(image.file.c_str()) + 1);
        }
        for (const Entry& entry : entries_) ReadAgain(entry);
        Changed();
      });
}

Status CameraCalibrationModel::SetBoard(const CalibrationBoard& board) {
  FORESIGHT_CHECK(board.Check());
  if (board == board_) return {};
  board_ = board;
  live_.SetBoard(board_);
  ++*board_version_;
  for (Entry& entry : entries_) {
    if (!entry.on_disk) continue;
    entry.read = false;
    ReadAgain(entry);
  }
  Changed();
  return {};
}

void CameraCalibrationModel::SetModels(const std::vector<LensModel>& models) {
  if (models.empty() || models == models_) {
    Announce();
    return;
  }
  models_ = models;
  Changed();
}

std::string CameraCalibrationModel::NewFileName(const std::string& name) {
  return fmt::format("{:03}-{}", next_number_++, name);
}

void CameraCalibrationModel::AddFiles(const QStringList& places) {
  std::vector<std::string> list;
  for (const QString& place : places) list.push_back(place.toStdString());
  using Files = std::vector<std::filesystem::path>;
  reader_.Run<Files>(
      tr("Listing images"), [list](const RunContext&) { return ListImageFiles(list); },
      [this](const Result<Files>& files) {
        if (!files) {
          session_->Report(NoticeOf(tr("Adding images"), files.error()));
          return;
        }
        for (const std::filesystem::path& file : *files)
          Read({.file = NewFileName(file.filename().string()), .name = file.string()}, false,
               [file]() -> Result<std::string> { return ReadFile(file); });
        Changed();
      });
}

QString CameraCalibrationModel::WhyNotTakeFromHead() const {
  return session_->CurrentImage() == nullptr ? tr("There is no image of the head yet; scan first.")
                                             : QString();
}

void CameraCalibrationModel::takeFromHead() {
  if (session_->CurrentImage() == nullptr) {
    session_->Report({Notice::Level::kInfo, tr("No image was taken over."), WhyNotTakeFromHead()});
    return;
  }
  AddFromHead(session_->CurrentImage()->image, session_->CurrentImage()->motor_angle_rad);
}

void CameraCalibrationModel::captureFromHead() {
  if (const Status started = captures_.StartImage(); !started)
    session_->Report(NoticeOf(tr("Capturing an image"), started.error()));
}

void CameraCalibrationModel::AddFromHead(const ColorImage& image, double motor_rad) {
  const auto kept = std::make_shared<const ColorImage>(image);
  const std::string name = fmt::format("head-{:+.0f}deg.png", DegreesFromRadians(motor_rad));
  Read({.file = NewFileName(name), .name = tr("the head's image").toStdString()}, false,
       [kept] { return EncodePng(*kept, PngContent::kCapture); });
  Changed();
}

void CameraCalibrationModel::Read(const CameraSessionImage& image, bool on_disk,
                                  std::function<Result<std::string>()> bytes) {
  const auto is_it = [&](const Entry& entry) { return entry.kept.file == image.file; };
  if (std::none_of(entries_.begin(), entries_.end(), is_it))
    entries_.push_back({.kept = image, .on_disk = on_disk});
  MakeFolder();
  const auto file = CameraSessionImages(folder_.toStdString()) / image.file;
  const int version = *board_version_;
  const auto work = [file, on_disk, bytes = std::move(bytes), board = board_, version,
                     newest = board_version_](const RunContext& context) -> Result<ReadResult> {
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "it was cancelled");
    FORESIGHT_TRY(const std::string content, bytes());
    FORESIGHT_TRY(const GrayImage gray, DecodeImageGray(content, file.filename().string()));
    // On the disk before anything is computed from it: a crash loses no image.
    if (!on_disk) FORESIGHT_CHECK(WriteFileAtomically(file, content));
    ReadResult result{.on_disk = true, .thumbnail = ThumbnailOf(gray)};
    if (version == *newest) result.image = InspectBoardImage(gray, board);
    return result;
  };
  reader_.Run<ReadResult>(
      tr("Looking for the board"), work,
      [this, name = image.file, session = session_version_, version](Result<ReadResult> read) {
        if (session == session_version_) TakeRead(name, version, std::move(read));
      });
}

void CameraCalibrationModel::ReadAgain(const Entry& entry) {
  const auto file = CameraSessionImages(folder_.toStdString()) / entry.kept.file;
  Read(entry.kept, true, [file] { return ReadFile(file); });
}

void CameraCalibrationModel::TakeRead(const std::string& file, int board_version,
                                      Result<ReadResult> read) {
  const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& candidate) {
    return candidate.kept.file == file;
  });
  if (entry == entries_.end()) return;
  if (board_version != *board_version_) {
    // It came too late, with an older board; where it is kept it was asked for again.
    if (read && !entry->on_disk) {
      entry->on_disk = true;
      ReadAgain(*entry);
    } else if (!read && !entry->on_disk) {
      entries_.erase(entry);
    }
    Changed();
    return;
  }
  entry->read = true;
  if (read) {
    entry->on_disk = true;
    entry->image = std::move(read->image);
    entry->thumbnail = std::move(read->thumbnail);
  } else {
    entry->image = {};
    entry->image.fault = read.error().code == ErrorCode::kCancelled
                             ? "it was not looked at: that was cancelled"
                             : read.error().message;
    if (const std::string prefix = file + ": "; entry->image.fault.starts_with(prefix))
      entry->image.fault.erase(0, prefix.size());  // the image is named beside the reason
  }
  Changed();
}

void CameraCalibrationModel::SetExcluded(int index, bool excluded) {
  if (index < 0 || index >= static_cast<int>(entries_.size())) return;
  const CameraSessionImage& image = entries_[static_cast<std::size_t>(index)].kept;
  if (image.excluded == excluded) return;
  const std::string file = image.file;
  const QString text = excluded ? tr("Exclude %1") : tr("Include %1");
  session_->Undo()->Push(
      text.arg(QString::fromStdString(file)), kUndoTopic,
      [this, file, excluded] { ShowExcluded(file, !excluded); },
      [this, file, excluded] { ShowExcluded(file, excluded); });
  ShowExcluded(file, excluded);
}

void CameraCalibrationModel::ShowExcluded(const std::string& file, bool excluded) {
  for (Entry& entry : entries_)
    if (entry.kept.file == file) entry.kept.excluded = excluded;
  Changed();
}

void CameraCalibrationModel::Changed() {
  keep_wanted_ = true;
  solve_wanted_ = true;
  SortImages();
  Advance();
  Announce();
}

void CameraCalibrationModel::SortImages() {
  std::vector<std::string> names;
  std::vector<BoardImage> images;
  for (const Entry& entry : entries_) {
    if (!entry.read || entry.kept.excluded) continue;
    names.push_back(entry.kept.file);
    images.push_back(entry.image);
  }
  sorted_ = SortBoardImages(names, std::move(images));
  if (sorted_.width > 0) {
    width_ = sorted_.width;
    height_ = sorted_.height;
  }
}

/// Keeps the session first, then solves: what was captured is safe before anything is computed.
void CameraCalibrationModel::Advance() {
  if (keep_wanted_) Keep();
  if (!solve_wanted_ || keep_wanted_ || keeper_.Busy()) return;
  const bool unread =
      std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return !entry.read; });
  if (unread) return;
  solve_wanted_ = false;
  StartSolve();
}

void CameraCalibrationModel::Keep() {
  if (keeper_.Busy()) return;  // it is kept once more then
  keep_wanted_ = false;
  if (folder_.isEmpty()) return;
  CameraSession session{.board = board_, .models = models_};
  for (const Entry& entry : entries_)
    if (entry.on_disk) session.images.push_back(entry.kept);
  keeper_.Run<bool>(
      tr("Keeping the calibration"),
      [session = std::move(session),
       folder = folder_.toStdString()](const RunContext&) -> Result<bool> {
        FORESIGHT_CHECK(SaveCameraSession(session, folder));
        return true;
      },
      [this](const Result<bool>& kept) {
        if (!kept) session_->Report(NoticeOf(tr("Keeping the calibration"), kept.error()));
        Advance();
        Announce();
      });
}

void CameraCalibrationModel::StartSolve() {
  const int version = ++solve_version_;
  if (static_cast<int>(sorted_.images.size()) < kMinImages) {
    solver_.cancel();
    result_.reset();
    chosen_ = -1;
    failure_.clear();
    rig_.Forget();
    return;
  }
  IntrinsicsOptions options;
  options.models = models_;
  options.min_images = kMinImages;
  const auto images = sorted_.images;
  const auto work = [board = board_, images, width = sorted_.width, height = sorted_.height,
                     options](const RunContext& context) {
    return CalibrateIntrinsics(board, images, width, height, options, context);
  };
  std::vector<std::string> files;
  for (const IntrinsicsImage& image : images) files.push_back(image.name);
  solver_.Run<IntrinsicsCalibration>(
      tr("Calibrating the camera"), work,
      [this, version, files = std::move(files)](Result<IntrinsicsCalibration> result) mutable {
        if (version != solve_version_) return;
        solved_files_ = std::move(files);
        TakeResult(std::move(result));
      });
}

void CameraCalibrationModel::TakeResult(Result<IntrinsicsCalibration> result) {
  rig_.Forget();
  if (!result) {
    failure_ = result.error().code == ErrorCode::kCancelled
                   ? tr("The solve was cancelled; Solve starts it again.")
                   : Sentence(result.error().message);
    result_.reset();
    chosen_ = -1;
    Announce();
    return;
  }
  failure_.clear();
  chosen_ = result->best;
  if (chosen_ < 0) failure_ = Sentence(result->models.front().failure);
  result_ = std::make_shared<const IntrinsicsCalibration>(std::move(*result));
  MakeMaps();
  Announce();
}

void CameraCalibrationModel::WantMaps(double distance_m) {
  if (distance_m == map_distance_m_) return;
  map_distance_m_ = distance_m;
  MakeMaps();
  Announce();
}

/// The last ones stay until the new ones are there.
void CameraCalibrationModel::MakeMaps() {
  const ModelCalibration* model = ChosenModel();
  if (model == nullptr || !(map_distance_m_ > 0.0)) {
    mapper_.cancel();
    maps_.reset();
    return;
  }
  mapper_.Run<CameraMaps>(
      tr("Mapping the camera's uncertainty"),
      [result = result_, chosen = chosen_, board = board_,
       distance = map_distance_m_](const RunContext& context) {
        return MakeCameraMaps(board, result->models[static_cast<std::size_t>(chosen)], distance,
                              context);
      },
      [this, result = result_, chosen = chosen_](Result<CameraMaps> maps) {
        if (!maps || result != result_ || chosen != chosen_) return;
        maps_ = std::make_shared<const CameraMaps>(std::move(*maps));
        Announce();
      });
}

void CameraCalibrationModel::solve() {
  solve_wanted_ = true;
  Advance();
  Announce();
}

void CameraCalibrationModel::cancel() {
  reader_.cancel();
  solver_.cancel();
}

void CameraCalibrationModel::Announce() {
  const ModelCalibration* model = ChosenModel();
  coverage_ = MeasureCoverage(board_, sorted_.images, std::max(1, sorted_.width),
                              std::max(1, sorted_.height),
                              model != nullptr ? model->images : std::vector<ImageErrors>());
  MakeRows();
  Q_EMIT changed();
}

void CameraCalibrationModel::MakeRows() {
  std::map<std::string, std::string> reasons;
  for (const RejectedImage& image : sorted_.rejected) reasons[image.name] = image.reason;
  if (result_)
    for (const RejectedImage& image : result_->images_rejected) reasons[image.name] = image.reason;
  std::map<std::string, double> errors;
  if (const ModelCalibration* model = ChosenModel())
    for (const ImageErrors& image : model->images)
      errors[solved_files_[image.image]] = image.rms_px;
  rows_.clear();
  for (const Entry& entry : entries_) {
    using State = CalibrationImageRow::State;
    const std::string& file = entry.kept.file;
    CalibrationImageRow row{.name = QString::fromStdString(file),
                            .origin = QString::fromStdString(entry.kept.name),
                            .rating = entry.image.detection.rating,
                            .thumbnail = entry.thumbnail};
    if (!entry.read) {
      row.reason = tr("looking for the board");
    } else if (entry.kept.excluded) {
      row.state = State::kExcluded;
      row.reason = tr("left out by you");
    } else if (const auto reason = reasons.find(file); reason != reasons.end()) {
      row.state = State::kRejected;
      row.reason = QString::fromStdString(reason->second);
    } else {
      row.state = State::kUsed;
      if (const auto error = errors.find(file); error != errors.end()) row.rms_px = error->second;
    }
    rows_.push_back(std::move(row));
  }
}

int CameraCalibrationModel::UsedCount() const {
  return static_cast<int>(std::count_if(rows_.begin(), rows_.end(), [](const auto& row) {
    return row.state == CalibrationImageRow::State::kUsed;
  }));
}

int CameraCalibrationModel::ReadPermille() const {
  if (entries_.empty()) return 0;
  const auto read = std::count_if(entries_.begin(), entries_.end(),
                                  [](const Entry& entry) { return entry.read; });
  return static_cast<int>(1000 * read / static_cast<std::ptrdiff_t>(entries_.size()));
}

QString CameraCalibrationModel::StateText() const {
  const auto unread = std::count_if(entries_.begin(), entries_.end(),
                                    [](const Entry& entry) { return !entry.read; });
  if (unread > 0)
    return tr("Looking for the board in %n image(s).", nullptr, static_cast<int>(unread));
  if (Solving()) return tr("Calibrating.");
  if (!failure_.isEmpty()) return failure_;
  const auto usable = static_cast<int>(sorted_.images.size());
  if (usable < kMinImages)
    return tr("At least %1 images with the board are needed; there are %2.")
        .arg(kMinImages)
        .arg(usable);
  return result_ ? tr("Calibrated from %1 images.").arg(result_->images_used.size())
                 : tr("Not calibrated yet.");
}

std::vector<CalibrationModelRow> CameraCalibrationModel::ModelRows() const {
  std::vector<CalibrationModelRow> rows;
  if (!result_) return rows;
  for (const ModelCalibration& model : result_->models) {
    CalibrationModelRow row{.model = model.model,
                            .title = TitleOf(model.model),
                            .failure = QString::fromStdString(model.failure)};
    row.mean_error_px = model.mean_error_px;
    row.rms_px = model.rms_px;
    row.cross_validation_px = model.cross_validation_px;
    if (model.corners > 0) row.parameters = ParametersOf(model);
    rows.push_back(row);
  }
  return rows;
}

const ModelCalibration* CameraCalibrationModel::ChosenModel() const {
  return result_ && chosen_ >= 0 ? &result_->models[static_cast<std::size_t>(chosen_)] : nullptr;
}

void CameraCalibrationModel::Choose(int index) {
  if (!result_ || index < 0 || index >= static_cast<int>(result_->models.size())) return;
  if (index == chosen_ || !result_->models[static_cast<std::size_t>(index)].Usable()) return;
  chosen_ = index;
  rig_.Forget();
  MakeMaps();
  Announce();
}

QString CameraCalibrationModel::WhyChosen() const {
  const ModelCalibration* model = ChosenModel();
  if (model == nullptr) return {};
  const QString title = TitleOf(model->model);
  if (chosen_ != result_->best) return tr("You chose %1.").arg(title);
  if (result_->models.size() == 1) return tr("%1 is the only model asked for.").arg(title);
  if (!std::isfinite(model->cross_validation_px))
    return tr("Chosen: %1, by its error; there are too few images for a cross-validation.")
        .arg(title);
  const bool least = std::all_of(
      result_->models.begin(), result_->models.end(), [&](const ModelCalibration& other) {
        return !other.Usable() || !(other.cross_validation_px < model->cross_validation_px);
      });
  return least ? tr("Chosen: %1, because it predicts images that were not used best.").arg(title)
               : tr("Chosen: %1, because it predicts as well as any, with fewer parameters.")
                     .arg(title);
}

std::vector<CalibrationCheck> CameraCalibrationModel::Verdict() const {
  const ModelCalibration* model = ChosenModel();
  if (model == nullptr) return {};
  std::vector<CalibrationCheck> checks = {CheckError(*model), CheckPrediction(*model),
                                          CheckFocal(*model), CheckCoverage(coverage_),
                                          CheckNumber(coverage_)};
  for (const std::string& warning : model->warnings)
    checks.push_back({Level::kCaution, Sentence(warning)});
  return checks;
}

QString CameraCalibrationModel::Next() const {
  const QString next = QString::fromStdString(NextImage(coverage_, kMinImages));
  return next.isEmpty() ? tr("next: nothing, no further image is needed")
                        : tr("next: %1").arg(next);
}

QString CameraCalibrationModel::WhyNotSaveRig() const {
  const ModelCalibration* model = ChosenModel();
  if (model == nullptr) return tr("There is no result yet.");
  if (!ResultIsCurrent()) return tr("The result is being made again.");
  const CameraModel camera = head_->Rig().camera;
  if (camera.width != model->camera.width || camera.height != model->camera.height)
    return tr("The images are %1 x %2 px and the head's camera has %3 x %4 px: they are of another "
              "camera.")
        .arg(model->camera.width)
        .arg(model->camera.height)
        .arg(camera.width)
        .arg(camera.height);
  return {};
}

QString CameraCalibrationModel::SuggestedRigFile() const {
  return RigVersionModel::FreeFile(QString::fromStdString(head_->Rig().name));
}

void CameraCalibrationModel::SaveRig(const QString& path) {
  if (const QString why = WhyNotSaveRig(); !why.isEmpty()) {
    session_->Report({Notice::Level::kInfo, tr("The rig cannot be saved now."), why});
    return;
  }
  rig_.Save(rig_.WithCamera(ChosenModel()->camera), path);
}

}  // namespace foresight
