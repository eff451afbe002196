#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "core/evaluation/method_score.h"
#include "core/pictures/depth_view.h"
#include "core/report/comparison_page.h"

namespace foresight {

/// What a method made of a scene, and the truth: all that its pictures show. Images of one size.
struct EvaluatedDepth {
  const MethodScore& score;
  const DepthResult& result;
  const ColorImage& guide;
  const DepthImage& truth_m;  ///< NaN = not scored
  RayOfPixel ray;             ///< of the guide's camera
};

/// The pictures of Fig. 7 for every scene and method, and index.html, which sets them side by side.
/// Pictures of scenes wider than 1000 pixels show every n-th pixel.
class EvaluationPictures {
 public:
  /// @param folder exists.
  explicit EvaluationPictures(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes SCENE-METHOD-depth.png, -error.png, -view.png and -samples.png, and with a scene's
  /// first method SCENE-image.png, SCENE-truth.png and SCENE-truth-view.png. A scene's methods come
  /// one after the other. Fails with kInvalidInput when scene and method were there before: their
  /// pictures would be overwritten.
  Status Add(const EvaluatedDepth& evaluated);

  /// Writes index.html about all that was added.
  Status WritePage() const;

 private:
  struct SceneFrame;

  Status AddScene(const EvaluatedDepth& evaluated, const SceneFrame& frame);
  Status AddMethod(const EvaluatedDepth& evaluated, const SceneFrame& frame);
  Result<ComparisonPage::Picture> Write(const ColorImage& picture, const std::string& name,
                                        const std::string& caption) const;

  std::filesystem::path folder_;
  std::set<std::string> names_;  ///< of files, to find two that are the same
  ComparisonPage page_;
};

}  // namespace foresight
