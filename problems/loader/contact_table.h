#pragma once

#include "maxwrench/task.h"
#include "problems/loader/block.h"

namespace maxwrench {

/// Reads `[contact]`.
ContactSpec read_contact(const Block& contact);

}  // namespace maxwrench
