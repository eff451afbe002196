#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/common/link_arguments.h"
#include "app/common/option_flags.h"
#include "app/ctl/depth_files.h"
#include "app/ctl/open_scan.h"
#include "core/detection/fit_in_scan.h"

namespace foresight {

/// A region as the command line gives it, one of these.
struct RegionArguments {
  std::vector<double> rectangle;   ///< left, top, right, bottom, px
  std::vector<double> polygon;     ///< x, y, x, y, ... px
  std::vector<double> two_clicks;  ///< x, y, x, y, px
  std::vector<double> box;         ///< centre x, y, z, size x, y, z: metres, robot
};

struct FitArguments {
  const CLI::App* command = nullptr;  ///< knows which options were given
  ObjectKind kind = ObjectKind::kValve;
  ScanArguments scan;
  DepthArguments depth;
  RegionArguments region;
  std::string source = "raw";

  std::string depth_file;  ///< instead of a mission, with `rig`
  double density = 0.02;
  std::string cloud_file;  ///< instead of a mission, with `viewpoint`
  std::string unit = "m";  ///< of the cloud file's coordinates
  std::vector<double> viewpoint;
  std::vector<double> up = {0.0, 0.0, 1.0};
  double noise_mm = 0.0;  ///< deviation of a cloud's ranges; 0 = measured in the region
  std::string rig;

  LinkArguments link;     ///< the head makes the fit, in a scan that it has
  std::string head_scan;  ///< its id, or how that begins; empty = the newest

  GivenFlags given;  ///< of FitOptionTable

  bool save = false;
  bool json = false;
  std::string picture;
  std::string gallery;
};

/// Adds scan, source, region and what becomes of the answer, then depth map or cloud, a head, what
/// belongs to the kind of object in `arguments`, and last the depth method's options.
void AddFitArguments(CLI::App& command, FitArguments& arguments);

/// Options that contradict each other or lack one another. Fails with kInvalidOptions.
Status CheckFitArguments(const FitArguments& arguments);

/// Against gravity in the frame that regions and answers are in, length 1: z, or what --up says of
/// a cloud's frame.
Eigen::Vector3d UpOf(const FitArguments& arguments);
/// That, where a cloud has another way up than z: FactsOf's.
std::optional<Eigen::Vector3d> UpOfCloud(const FitArguments& arguments);

/// The region on the picture at `motor_rad`. Fails with kInvalidOptions: none, or no region.
Result<Roi> RegionFrom(const RegionArguments& arguments, double motor_rad,
                       const Rigid<frame::Robot, frame::Base>& robot_from_base);

/// The fit's options as the command line wants them. Fails as ApplyFlags does.
Result<FitOptions> FitOptionsFrom(const FitArguments& arguments,
                                  const Rigid<frame::Robot, frame::Base>& robot_from_base);

/// "raw", "foresight", "paper", ...: raw, then the depth methods, the default first.
std::vector<std::string> SourceNames();

}  // namespace foresight
