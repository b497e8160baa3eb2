#include <gtest/gtest.h>

#include "tests/support/bad_input.h"

namespace maxwrench {
namespace {

const std::vector<ChangedProblem> kBadWater = {
    {"hydrodynamics_of_unknown_link",
     "vehicle.toml",
     "[collision]",
     "[hydrodynamics.float]\n[collision]",
     {"hydrodynamics.float", "link_1"}},
    {"hydrodynamics_without_drag",
     "vehicle.toml",
     "[collision]",
     "[hydrodynamics.hull]\nadded_mass = [0, 0, 0, 0, 0, 0]\n[collision]",
     {"hydrodynamics.hull.damping_linear: got nothing", "6 finite numbers"}},
    {"short_added_mass",
     "vehicle.toml",
     "[collision]",
     "[hydrodynamics.hull]\nadded_mass = [1, 1, 1]\n[collision]",
     {"hydrodynamics.hull.added_mass: got [1, 1, 1]", "6 finite numbers"}},
    {"negative_added_mass",
     "vehicle.toml",
     "[collision]",
     "[hydrodynamics.hull]\nadded_mass = [1, 1, -1, 0, 0, 0]\n[collision]",
     {"hydrodynamics.hull.added_mass: got [1, 1, -1, 0, 0, 0]", "6 numbers >= 0"}},
    {"unknown_hydrodynamics_key",
     "vehicle.toml",
     "[collision]",
     "[hydrodynamics.hull]\ndrag = 1\n[collision]",
     {"hydrodynamics.hull.drag", "added_mass, damping_linear"}},
    {"hydrodynamics_center",
     "vehicle.toml",
     "[collision]",
     "[hydrodynamics.hull]\ncenter = [0, 0]\n[collision]",
     {"hydrodynamics.hull.center: got [0, 0]", "3 finite numbers"}},
    {"added_mass_of_one_body_only",
     "vehicle.toml",
     "[collision]",
     "[buoyancy]\nlink_1 = { volume = 0.001, cob = [0, 0, 0] }\n"
     "[hydrodynamics.hull]\nadded_mass = [1, 1, 1, 0, 0, 0]\n"
     "damping_linear = [0, 0, 0, 0, 0, 0]\ndamping_quadratic = [0, 0, 0, 0, 0, 0]\n[collision]",
     {"hydrodynamics.link_1: got nothing", "zeros", "displaces water as 'hull' does"}},
    {"hydrodynamics_in_air",
     "vehicle.toml",
     "[collision]",
     "[hydrodynamics.hull]\nadded_mass = [1, 1, 1, 0, 0, 0]\n"
     "damping_linear = [0, 0, 0, 0, 0, 0]\ndamping_quadratic = [0, 0, 0, 0, 0, 0]\n[collision]",
     {"environment.water_density: got 0", "a density > 0", "'hull'"}},
    {"trim_without_position",
     "vehicle.toml",
     "[collision]",
     "[trim]\nbuoyancy_mass = 1\n[collision]",
     {"trim.position: got nothing", "3 finite numbers"}},
    {"trim_without_mass",
     "vehicle.toml",
     "[collision]",
     "[trim]\nposition = [0, 0, 0]\n[collision]",
     {"trim.buoyancy_mass: got nothing", "a finite number"}},
    {"trim_nan",
     "vehicle.toml",
     "[collision]",
     "[trim]\nbuoyancy_mass = nan\nposition = [0, 0, 0]\n[collision]",
     {"trim.buoyancy_mass: got nan"}},
    {"unknown_trim_key",
     "vehicle.toml",
     "[collision]",
     "[trim]\nmass = 1\n[collision]",
     {"trim.mass", "buoyancy_mass, position"}},
    {"trim_not_a_table", "vehicle.toml", "[base]", "[[trim]]\n[base]", {": trim: got", "a table"}},
};

class BadWaterTest : public testing::TestWithParam<ChangedProblem> {};

TEST_P(BadWaterTest, IsRejected) { expect_rejected(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Loader, BadWaterTest, testing::ValuesIn(kBadWater),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace maxwrench
