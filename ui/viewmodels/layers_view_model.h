#pragma once

#include <QObject>

#include "core/pictures/depth_picture.h"
#include "core/pictures/sample_marks.h"

namespace foresight {

/// How the depth is looked at: which of its maps, in which colours, with what drawn over it. Shared
/// by the panes; computes nothing.
class LayersViewModel : public QObject {
  Q_OBJECT

 public:
  explicit LayersViewModel(QObject* parent = nullptr) : QObject(parent) {}

  DepthLayer Layer() const { return layer_; }
  ColorMap DepthColors() const { return colors_; }
  bool MaskShown() const { return mask_shown_; }
  const SampleLayers& Samples() const { return samples_; }
  /// Whether the passes of the filter can be stepped through.
  bool IterationsOpen() const { return iterations_open_; }

  void SetLayer(DepthLayer layer);
  void SetDepthColors(ColorMap colors);
  void ShowSamples(RejectReason kind, bool shown);
  /// D0, D1, ...; past the last pass there is nothing to show, so that one is shown.
  void SetIteration(int iteration);

  /// The pass to show of this result, -1 = its final depth.
  int IterationOf(const DenseDepth& dense) const;
  const DepthImage& DepthOf(const DenseDepth& dense) const;

 public Q_SLOTS:
  void setMaskShown(bool shown);
  void openIterations(bool open);
  void toggleMask() { setMaskShown(!mask_shown_); }
  void toggleLayer();
  /// All three reasons of rejection at once.
  void toggleRejected();

 Q_SIGNALS:
  void changed();

 private:
  template <class T>
  void Set(T* member, const T& value);

  DepthLayer layer_ = DepthLayer::kDepth;
  ColorMap colors_ = DepthColorMaps().front().map;
  bool mask_shown_ = true;
  SampleLayers samples_;
  bool iterations_open_ = false;
  int iteration_ = -1;
};

}  // namespace foresight
