#pragma once

#include <span>
#include <string>

#include "core/depth/aligned_samples.h"
#include "core/io/csv_samples.h"
#include "core/sensor/camera_model.h"

namespace foresight {

/// Samples that somebody else projected into an image, ready for the pipeline. With a camera each
/// gets its 3D point; without one the points lie on the optical axis, so that Eq. (7) compares
/// depths only. Rows outside the image are left out and counted in `outside`. Fails with
/// kInvalidInput (camera of another size), kBadData (a place of the lidar's grid named twice, a
/// grid of more than 100 million places; `source` names the file) and kTooFewPoints.
Result<AlignedSamples> ImportSamples(std::span<const CsvSample> rows, int width, int height,
                                     const CameraModel* camera, const std::string& source,
                                     int* outside);

/// The reverse, millimetres.
std::vector<CsvSample> ExportSamples(const AlignedSamples& samples);

}  // namespace foresight
