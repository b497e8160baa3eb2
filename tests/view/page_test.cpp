#include "view/page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/support.h"
#include "tests/view/no_collision.h"
#include "view/base64.h"

namespace maxwrench {
namespace {

std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t from = text.find(before) + before.size();
  return text.substr(from, text.find(after, from) - from);
}

/// A name of a robot must not end the element that holds it, or begin another one.
TEST(ViewPage, HoldsAnyTextOfTheScene) {
  const nlohmann::ordered_json scene = {{"name", "</script><script>alert(1)</script>"},
                                        {"more", "<!-- & {{scene}} $& \u03b2"}};
  Problem task;
  task.name = "a < b & c";
  task.robot.collision = std::make_shared<NoCollision>();  // the engine does not support it
  const std::string page = view_page(task, scene);
  EXPECT_EQ(between(page, "<title>", "</title>"), "a &lt; b &amp; c");
  const std::string json =
      between(page, "<script type=\"application/json\" id=\"scene\">", "</script>");
  EXPECT_EQ(nlohmann::ordered_json::parse(json), scene);
  EXPECT_EQ(json.find('<'), std::string::npos);
}

/// Test vectors of RFC 4648, section 10, and bytes with their highest bit.
TEST(ViewPage, Base64) {
  for (const auto& [bytes, text] : {std::pair("", ""),
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"},
                                    {"\xff\xfe\xfd", "//79"}}) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

TEST(ViewCommand, WritesAPageThatNeedsNothingElse) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "view planar/force --budget 200 --theta-r 0.3,-0.7 --out v.html", folder.path());
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.out, "");
  const std::string page = read_text(folder.path() / "v.html");
  EXPECT_LT(page.size(), 4'000'000U);
  EXPECT_EQ(page.find("<script src"), std::string::npos);
  EXPECT_EQ(page.find("<link rel=\"stylesheet"), std::string::npos);
  const auto scene = nlohmann::json::parse(
      between(page, "<script type=\"application/json\" id=\"scene\">", "</script>"));
  ASSERT_EQ(scene["shown"].size(), 3U);
  // The command's own value at the same posture.
  const CommandResult eval =
      run_maxwrench("eval planar/force --theta-r 0.3,-0.7 --json", folder.path());
  EXPECT_EQ(scene["shown"][1]["name"], "given");
  EXPECT_EQ(scene["shown"][1]["beta"], nlohmann::json::parse(eval.out)["beta"]);
}

TEST(ViewCommand, ShowsAPostureThatDoesNotExistAndSaysSo) {
  const CommandResult result = run_maxwrench("view planar/force --budget 200 --theta-r 9,9");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.out.find("joint limit: shoulder at 9 rad"), std::string::npos);
}

TEST(ViewCommand, RejectsBadInputInOneLine) {
  for (const char* words :
       {"view planar/force --theta-r 1", "view nowhere/none", "view planar/force --theta-r nan,0",
        "view planar/force --out ''", "view planar/force --out problems/planar/force.toml",
        "view uvms/valve --measure none", "view planar/force --scheme ends"}) {
    const CommandResult result = run_maxwrench(words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << words << result.err;
    EXPECT_EQ(result.out, "") << words;
  }
}

}  // namespace
}  // namespace maxwrench
