#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/geometry/rigid.h"
#include "core/objects/solid_part.h"
#include "core/sensor/camera_model.h"

namespace foresight {

/// Where an image was taken from, and through which lens.
struct ImageView {
  CameraModel camera;
  Rigid<frame::Camera, frame::Base> camera_from_base;
};

/// What an image says of an outline.
struct OutlineSupport {
  double nats = 0.0;       ///< that there are edges where the outline lies, against none
  double length_px = 0.0;  ///< of the outline, where the image shows it

  /// 0 for an outline of no length.
  double NatsPerPixel() const { return length_px > 0.0 ? nats / length_px : 0.0; }
};

/// The edges of an image round a region, as evidence for solids at a place: a camera sees an
/// outline several times finer than beams touch it.
///
/// An outline is where, of two rays beside an edge, one passes the solids, or enters them well
/// behind the other. Each piece of it looks for the image's gradient across it, a few pixels to
/// either side (rigs are off, and no real thing is its template). The gradient over the region's
/// median is worth what it is in outlines of right fits against outlines of wrong ones
/// (foresightctl evaluate-outlines), which is compressed: neither a missing edge nor a sharp one
/// decides alone.
class ImageEdges {
 public:
  /// Neighbouring pixels of an outline are not independent: what one of them counts
  /// (docs/evaluation/kinds.md, "The image beside the beams").
  static constexpr double kIndependentPerPixel = 0.25;

  /// Keeps what the image shows round the points of base that were `seen`: empty where that is
  /// nothing. `independent_per_px`: another value, to choose it.
  /// @pre the image's size is the camera's
  ImageEdges(const ColorImage& image, const ImageView& view, std::span<const Eigen::Vector3d> seen,
             double independent_per_px = kIndependentPerPixel);

  bool Empty() const { return width_ == 0; }

  /// What the image says of solids at a place. Nothing for what lies outside of the region.
  OutlineSupport SupportOf(std::span<const SolidPart> parts,
                           const Rigid<frame::Base, frame::Object>& base_from_object) const;

  /// The gradient across each piece of the outline over the region's median, and how long the piece
  /// is: what the nats are made of.
  struct Piece {
    Eigen::Vector2d pixel;
    double response = 0.0;
    double length_px = 0.0;
    std::size_t turn = 0;  ///< which of the directions that are looked at lies across
  };
  std::vector<Piece> PiecesOf(std::span<const SolidPart> parts,
                              const Rigid<frame::Base, frame::Object>& base_from_object) const;

  /// An edge as the image shows it.
  struct Edge {
    Eigen::Vector2d from_px;
    Eigen::Vector2d to_px;
  };
  /// Where rays from Eye(), of these directions in base, first enter what is looked at; infinite
  /// where they miss that.
  using RangesAlong =
      std::function<void(std::span<const Eigen::Vector3d> directions, std::span<double> ranges_m)>;
  /// The pieces of edges of anything else, where they are an outline; without `ranges_along` all of
  /// them.
  std::vector<Piece> PiecesAlong(std::span<const Edge> edges,
                                 const RangesAlong& ranges_along) const;
  /// The same pieces as if they lay beside where they do: a rig that is off by little moves all of
  /// an outline alike. What leaves the region is left out.
  std::vector<Piece> Moved(std::span<const Piece> pieces, const Eigen::Vector2d& by_px) const;
  /// What pieces say together.
  OutlineSupport SupportOf(std::span<const Piece> pieces) const;

  const Eigen::Vector3d& Eye() const { return eye_; }
  /// Where a point of base lies, also beside what is kept of the image; nothing where the lens does
  /// not see it.
  std::optional<Eigen::Vector2d> PixelOf(const Eigen::Vector3d& point) const {
    return view_.camera.Project(view_.camera_from_base * point);
  }

  /// What a response is worth, nats: right outlines against wrong ones.
  static double NatsOf(double response);

 private:
  static constexpr int kTurns = 8;  // directions of an outline, half a circle

  void FindEdges(const ColorImage& image);
  std::optional<Eigen::Vector3d> RayThrough(const Eigen::Vector2d& pixel) const;
  /// Of pieces, and the rays on either side of each, those where something ends.
  static std::vector<Piece> WhereSomethingEnds(std::span<const Piece> pieces,
                                               std::span<const Eigen::Vector3d> beside,
                                               const RangesAlong& ranges_along);
  /// `turn`: which of the directions lies across.
  std::optional<double> ResponseAt(const Eigen::Vector2d& pixel, std::size_t turn) const;

  ImageView view_;
  Eigen::Vector3d eye_;  ///< in base
  double independent_per_px_;
  int left_ = 0, top_ = 0, width_ = 0, height_ = 0;  ///< what is kept of the image
  std::vector<Eigen::Vector2d> turns_;               ///< the directions, of length 1
  std::vector<Image<float>> responses_;              ///< across each of them
  Image<Eigen::Vector3f> rays_;                      ///< in base; zero = the lens shows nothing
};

}  // namespace foresight
