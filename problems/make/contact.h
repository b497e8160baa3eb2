#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

/// Fills contact, and adds the regrasp coordinates to theta_r, which the joints have filled.
void set_contact(const ContactSpec& spec, Problem& problem);

/// The index of an end effector by its name.
int find_end_effector(std::string_view key, const std::string& name, const Robot& robot);

}  // namespace maxwrench
