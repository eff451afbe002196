#include "core/calibration/lens_model.h"

#include <algorithm>
#include <array>

#include "core/base/contract.h"

namespace foresight {
namespace {

struct ModelRow {
  LensModel model;
  std::string_view text;
};
constexpr std::array<ModelRow, 4> kModels = {{{LensModel::kFisheyeK, "k"},
                                              {LensModel::kExtendedUnified, "eucm"},
                                              {LensModel::kKannalaBrandt, "kb4"},
                                              {LensModel::kRadialTangential, "radtan"}}};

}  // namespace

std::string_view ToString(LensModel model) {
  for (const ModelRow& row : kModels)
    if (row.model == model) return row.text;
  FORESIGHT_EXPECTS(false, "a model of the enumeration");
  return {};
}

Result<LensModel> LensModelFromText(std::string_view text) {
  for (const ModelRow& row : kModels)
    if (row.text == text) return row.model;
  return Fail(ErrorCode::kInvalidOptions, "camera model '{}' is not one of k, eucm, kb4, radtan",
              text);
}

Result<std::vector<LensModel>> LensModelsFromText(std::string_view text) {
  std::vector<LensModel> models;
  for (;;) {
    const std::size_t end = text.find(',');
    FORESIGHT_TRY(const LensModel model, LensModelFromText(text.substr(0, end)));
    if (std::find(models.begin(), models.end(), model) != models.end())
      return Fail(ErrorCode::kInvalidOptions, "camera model '{}' is named twice", ToString(model));
    models.push_back(model);
    if (end == std::string_view::npos) return models;
    text.remove_prefix(end + 1);
  }
}

Lens StartLens(LensModel model) {
  switch (model) {
    case LensModel::kFisheyeK:
      return FisheyeLens{1.0};
    case LensModel::kExtendedUnified:
      return ExtendedUnifiedLens{0.6, 1.1};  // close to equidistant up to 90 deg
    case LensModel::kKannalaBrandt:
      return KannalaBrandtLens();
    case LensModel::kRadialTangential:
      return RadialTangentialLens();
  }
  FORESIGHT_EXPECTS(false, "a model of the enumeration");
  return {};
}

LensModel LensModelOf(const Lens& lens) {
  if (std::holds_alternative<ExtendedUnifiedLens>(lens)) return LensModel::kExtendedUnified;
  if (std::holds_alternative<KannalaBrandtLens>(lens)) return LensModel::kKannalaBrandt;
  if (std::holds_alternative<RadialTangentialLens>(lens)) return LensModel::kRadialTangential;
  return LensModel::kFisheyeK;
}

}  // namespace foresight
