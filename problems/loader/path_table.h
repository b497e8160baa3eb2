#pragma once

#include <filesystem>

#include "maxwrench/path.h"

namespace maxwrench {

/// Reads a path through poses in the world from CSV, with columns t,x,y,z and roll,pitch,yaw or
/// qw,qx,qy,qz [s, m, rad], t from 0. Rejects invalid files with a message of one line.
Path read_path_table(const std::filesystem::path& file);

/// Reads wrenches over time from CSV, with columns t,fx,fy,fz,tx,ty,tz [s, N, N m], t from 0.
/// Rejects invalid files likewise.
WrenchTable read_wrench_table(const std::filesystem::path& file);

}  // namespace maxwrench
