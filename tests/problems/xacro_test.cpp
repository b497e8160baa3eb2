#include "problems/loader/xacro.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/written_urdf.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;
using urdf::link, urdf::UrdfTest;

/// The program xacro is a script of the test, or not installed: PATH leads to this folder alone.
class XacroTest : public UrdfTest {
 protected:
  XacroTest() { setenv("PATH", bin_.path().c_str(), 1); }
  ~XacroTest() override { setenv("PATH", path_.c_str(), 1); }
  void install(const std::string& script) {
    std::ofstream(bin_.path() / "xacro") << "#!/bin/sh\n" + script;
    std::filesystem::permissions(bin_.path() / "xacro", std::filesystem::perms::owner_all);
  }

  const TemporaryFolder bin_;
  const std::string path_ = std::getenv("PATH");
};

TEST_F(XacroTest, IsNamedWhereItIsNotInstalled) {
  EXPECT_THAT(rejection(link("${prefix}base")),
              testing::AllOf(HasSubstr("robot.urdf: xacro: got"), HasSubstr("not installed"),
                             HasSubstr("'xacro robot.urdf > robot.urdf'")));
  EXPECT_THAT(rejection("<xacro:include filename='a'/>" + link("base")), HasSubstr("xacro"));
  EXPECT_EQ(rejection("<xacro:property name='a' value='1'/>" + link("base")), "accepted");
}

TEST_F(XacroTest, ExpandsTheFile) {
  install("echo \"<robot name='made'><link name='from_$(/usr/bin/basename $1)'/></robot>\"\n");
  const Robot robot = load(link("${prefix}base"));
  EXPECT_EQ(robot.links[0].name, "from_robot.urdf");
}

TEST_F(XacroTest, ThatFailsIsRejected) {
  install("echo '<robot/>'\nexit 1\n");
  EXPECT_THAT(rejection(link("${prefix}base")), HasSubstr("got a file that xacro does not expand"));
}

TEST_F(XacroTest, ThatPrintsNoUrdfIsRejected) {
  install("echo 'error'\n");
  EXPECT_THAT(rejection(link("${prefix}base")), HasSubstr("expected valid XML"));
}

}  // namespace
}  // namespace maxwrench
