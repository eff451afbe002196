#include "ui/viewmodels/layers_view_model.h"

#include <algorithm>

namespace foresight {

template <class T>
void LayersViewModel::Set(T* member, const T& value) {
  if (*member == value) return;
  *member = value;
  Q_EMIT changed();
}

void LayersViewModel::SetLayer(DepthLayer layer) {
  Set(&layer_, layer);
}

void LayersViewModel::SetDepthColors(ColorMap colors) {
  Set(&colors_, colors);
}

void LayersViewModel::ShowSamples(RejectReason kind, bool shown) {
  SampleLayers samples = samples_;
  samples.Show(kind, shown);
  Set(&samples_, samples);
}

void LayersViewModel::SetIteration(int iteration) {
  Set(&iteration_, std::max(-1, iteration));
}

int LayersViewModel::IterationOf(const DenseDepth& dense) const {
  const int last = static_cast<int>(dense.iterations.size()) - 1;
  return iterations_open_ && iteration_ >= 0 ? std::min(iteration_, last) : -1;
}

const DepthImage& LayersViewModel::DepthOf(const DenseDepth& dense) const {
  const int iteration = IterationOf(dense);
  return iteration < 0 ? dense.depth_m : dense.iterations[static_cast<std::size_t>(iteration)];
}

void LayersViewModel::setMaskShown(bool shown) {
  Set(&mask_shown_, shown);
}

void LayersViewModel::openIterations(bool open) {
  iteration_ = -1;
  Set(&iterations_open_, open);
}

void LayersViewModel::toggleLayer() {
  SetLayer(layer_ == DepthLayer::kDepth ? DepthLayer::kConfidence : DepthLayer::kDepth);
}

void LayersViewModel::toggleRejected() {
  SampleLayers samples = samples_;
  const bool show = !samples.Shows(RejectReason::kFlying) ||
                    !samples.Shows(RejectReason::kIsolated) ||
                    !samples.Shows(RejectReason::kFlipping);
  for (const RejectReason kind : kSampleKinds)
    if (kind != RejectReason::kKept) samples.Show(kind, show);
  Set(&samples_, samples);
}

}  // namespace foresight
