#pragma once

#include "maxwrench/task.h"

namespace maxwrench {

/// Sets the contact and appends the regrasp coordinates to theta_r, which must already hold the
/// joints.
void set_contact(const ContactSpec& spec, Problem& problem);

/// The index of an end effector by its name.
int find_end_effector(std::string_view key, const std::string& name, const Robot& robot);

}  // namespace maxwrench
