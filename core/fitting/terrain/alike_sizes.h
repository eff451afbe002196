#pragma once

#include <span>
#include <vector>

namespace foresight {

/// The odds, in nats, that a top is a block's and not another thing's, by its own margin of sizes
/// (SizeMargin) alone: right answers against answers that took another thing for a block, at home
/// (`foresightctl verdict odds terrain --of size_margin`; docs/evaluation/terrain.md, "Blocks among
/// other things" and, of a top that an image shows, "Blocks in the image").
double NatsOfSize(double size_margin, bool of_map, bool in_image);

/// The same for each top of a region, by its own nats and by those of the others: blocks that stand
/// together are mostly all blocks or none, but some regions hold both. What fraction of a region's
/// tops are blocks' is taken for unknown, all and none for the likeliest; the others tell of it.
/// Margins of one region err together, so that nats count half.
///
/// NaN = a top whose size was not measured: the others alone tell.
std::vector<double> NatsAmongOthers(std::span<const double> own_nats);

}  // namespace foresight
