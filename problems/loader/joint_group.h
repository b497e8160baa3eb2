#pragma once

#include <string>
#include <vector>

#include "problems/loader/urdf_choices.h"
#include "problems/loader/urdf_structure.h"

namespace maxwrench {

/// Locks the joints outside of `choices.group`.
///
/// The joints of a chain are those between its base link and its tip link, that of a link is the
/// one that leads to it. Joints that mimic others are not locked: they follow their leader. Each
/// other joint outside stays where `choices.joints` locks it, else where `rest` or `state` of the
/// group has it, else at zero or at its limit nearest to zero.
///
/// Adds a line to `notes` that says which joints move and where the others stay.
///
/// @return the tips: the links of the group that carry no other link of it. A chain has one
/// @throws BadValue of `group` if a link is not in the URDF or no joint moves, or of `rest` if it
/// names no joint outside
std::vector<std::string> lock_outside_of_group(const UrdfStructure& structure, UrdfChoices& choices,
                                               std::vector<std::string>& notes);

}  // namespace maxwrench
