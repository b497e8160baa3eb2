#pragma once

#include "maxwrench/map.h"

namespace maxwrench {

/// An orthonormal basis of the wrenches of W (6×k) across c (6×(k-1)). c is in their span.
Matrix6Xd basis_across(const Matrix6Xd& W, const Vector6d& c);

}  // namespace maxwrench
