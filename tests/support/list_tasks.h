#pragma once

#include <ostream>
#include <vector>

#include "tests/support/scenario_task.h"

namespace maxwrench {

/// A list of scenarios of each form that proofs support.
struct ListForm {
  const char* name;
  std::string wrench, tables;
};

inline void PrintTo(const ListForm& form, std::ostream* out) { *out << form.name; }

inline std::vector<ListForm> list_forms() {
  const std::string parameters = kParameters;
  return {
      {"senses", "set = [[0,0,0,0,0,2], [0,0,0,0,0,-1]]", ""},
      {"mixed set", "set = [[0,0,-10,0,0,5], [0,0,-10,0,0,-5], [10,0,0,0,0,0]]\nhold = true", ""},
      {"ball", "ball = { axes = ['fx', 'fy'], radius = 1 }", ""},
      {"cone", "c = [1,0,0,0,0,0]\nball = { axes = ['fy', 'fz'], radius = 0.36397 }", ""},
      {"torques", "ball = { axes = ['tx', 'ty', 'tz'], radius = 2 }\nhold = true", ""},
      {"losses", kLift, "[loss]\nany = 1\n"},
      {"locked joint", kTurn,
       "[loss]\ncases = [['q1_shoulder_yaw'], ['rear_left_vertical']]\njoints = 'locked'\n"},
      {"corners", kLift, parameters},
      {"corners, weaker", kTurn, parameters + "thrust = 0.1\ntorque = 0.05\n"},
      {"payload of a corner", kTurn,
       "[uncertainty]\npayload = { mass = 1, com = [0.1, 0, 0.02] }\n"},
      {"current", kLift, "[uncertainty]\ncurrent = { speed = 0.3, directions = 8 }\n"},
      {"set, losses and corners", "set = [[10,0,0,0,0,0], [0,0,10,0,0,0]]",
       parameters + "\n[loss]\ncases = [['front_left_vertical'], ['rear_left_vertical']]\n"},
      {"carried mass", "", "[payload]\ncom = [0.05, 0, 0.02]\n"}};
}

}  // namespace maxwrench
