#include "benchmarks/suite/map_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/write_file.h"
#include "maxwrench/load.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

class MapStoreTest : public testing::Test {
 protected:
  MapStoreTest() { plan.over = {{"azimuth", 0, 6, 9}}; }

  /// A cell without a value and one with one.
  MapCell cell(long i) const {
    MapCell made;
    made.index = {i};
    made.at = Eigen::VectorXd::Constant(1, 0.75 * static_cast<double>(i));  // 9 from 0 to 6
    made.unit = "N";
    made.conclude(Status::kNoneFound, "nothing, \"really\" nothing");
    if (i % 2 == 0) return made;
    made.conclude(Status::kBestFound);
    made.theta_r = Eigen::VectorXd::Constant(2, 0.7);
    made.beta = evaluate(posed(task, plan.over, made.at), made.theta_r, {choice}).beta();
    made.q = Eigen::VectorXd::Constant(2, 0.7);
    made.base = Eigen::VectorXd::LinSpaced(6, 0, 1);
    made.level = 2;
    made.evaluations = 41;
    made.bound = 7.5;
    made.scratch = -kInfinity;
    return made;
  }
  MapStore open(const std::string& name, bool again = false) {
    return {folder.path() / name, task, plan, choice, again};
  }

  const Problem task = load_problem("planar/force");
  MapPlan plan;
  const Case choice = with_map_search(task, {});
  const TemporaryFolder folder;
};

TEST_F(MapStoreTest, KeepsCellsOfARunThatWasKilled) {
  {
    MapStore store = open("a");
    EXPECT_EQ(store.known(), 0u);
    store.put(cell(1));
    store.put(cell(2));
  }  // without `write`
  const MapStore store = open("a");
  EXPECT_EQ(store.known(), 2u);
  EXPECT_FALSE(store.find({3}));
  const MapCell one = *store.find({1}), two = *store.find({2}), was = cell(1);
  EXPECT_EQ(one.status, Status::kBestFound);
  EXPECT_EQ(one.beta, was.beta);
  EXPECT_EQ(one.at, was.at);
  EXPECT_EQ(one.theta_r, was.theta_r);
  EXPECT_EQ(one.q, was.q);
  EXPECT_EQ(one.base, was.base);
  EXPECT_EQ(one.level, 2);
  EXPECT_EQ(one.evaluations, 41);
  EXPECT_EQ(one.bound, 7.5);
  EXPECT_EQ(one.scratch, -kInfinity);
  EXPECT_EQ(two.status, Status::kNoneFound);
  EXPECT_EQ(two.reason.str(), "nothing, \"really\" nothing");
  EXPECT_EQ(two.theta_r.size(), 0);
  EXPECT_EQ(two.bound, kInfinity);
  EXPECT_FALSE(two.scratch);
}

TEST_F(MapStoreTest, RejectsTheFolderOfAnotherMap) {
  open("a").put(cell(1));
  plan.over.front().high = 5;
  EXPECT_THAT(rejection_of([&] { open("a"); }), HasSubstr("another map"));
  plan.over.front().high = 6;
  EXPECT_EQ(open("a", true).known(), 0u);
}

TEST_F(MapStoreTest, MergesParts) {
  for (const auto& [name, i] : {std::pair("a", 1L), {"b", 2L}}) {
    MapStore store = open(name);
    store.put(cell(i));
    store.put(cell(3));
    store.write();
  }
  const std::string a = folder.path() / "a", b = folder.path() / "b";
  EXPECT_EQ(merge_maps(folder.path() / "all", {a, b}), 3u);
  EXPECT_EQ(merge_maps(folder.path() / "back", {b, a}), 3u);
  EXPECT_EQ(csv_text(folder.path() / "all" / "map.csv.gz"),
            csv_text(folder.path() / "back" / "map.csv.gz"));
  EXPECT_EQ(open("all").known(), 3u);
}

/// Each posture is evaluated again.
TEST_F(MapStoreTest, RejectsAValueThatThePostureDoesNotHave) {
  MapCell wrong = cell(1);
  wrong.beta *= 1 + 1e-4;
  open("value").put(wrong);
  EXPECT_THAT(rejection_of([&] { open("value").find({1}); }),
              HasSubstr("map.csv.gz: cell 1: got beta"));
  MapCell moved = cell(1);
  moved.at[0] += 0.1;
  open("place").put(moved);
  EXPECT_THAT(rejection_of([&] { open("place").find({1}); }), HasSubstr("other coordinates"));
  MapCell bound = cell(1);
  bound.bound = 0.9 * bound.beta;
  open("bound").put(bound);
  EXPECT_THAT(rejection_of([&] { open("bound").find({1}); }), HasSubstr("got bound"));
  MapCell beyond = cell(1);
  beyond.theta_r[0] = 100;
  open("posture").put(beyond);
  EXPECT_THAT(rejection_of([&] { open("posture").find({1}); }), HasSubstr("expected nan"));
}

/// One part has bounds and checks, the other has not: the whole has what either has.
TEST_F(MapStoreTest, MergesWhatOnlyOnePartHas) {
  MapCell plain = cell(1);
  plain.bound = kInfinity;
  plain.scratch.reset();
  MapCell weaker = cell(1);
  weaker.bound = 9;
  weaker.scratch = 0.25;
  for (const auto& [name, made] :
       {std::pair("plain", plain), {"whole", cell(1)}, {"weaker", weaker}}) {
    MapStore store = open(name);
    store.put(made);
    store.write();
  }
  const auto path = [&](const char* name) { return std::string(folder.path() / name); };
  const auto first_row = [&](const char* name) {
    return read_csv(folder.path() / name / "map.csv.gz", {"bound", "scratch"});
  };
  merge_maps(folder.path() / "ab", {path("plain"), path("whole")});
  EXPECT_EQ(csv_text(folder.path() / "ab" / "map.csv.gz"),
            csv_text(folder.path() / "whole" / "map.csv.gz"));
  for (const std::vector<std::string>& order : {std::vector{path("whole"), path("weaker")},
                                                {path("weaker"), path("plain"), path("whole")}}) {
    merge_maps(folder.path() / "all", order);
    EXPECT_EQ(*first_row("all").number(0, "bound"), 7.5);
    EXPECT_EQ(*first_row("all").number(0, "scratch"), 0.25);
    std::filesystem::remove_all(folder.path() / "all");
  }
}

/// A part without cells yet is no reason to stop; a table that is none is, in one line.
TEST_F(MapStoreTest, MergesPartsWithoutCells) {
  open("empty").write();
  const std::string empty = folder.path() / "empty", full = folder.path() / "full";
  std::filesystem::remove(folder.path() / "empty" / "map.csv.gz");
  MapStore store = open("full");
  store.put(cell(1));
  store.write();
  for (const std::vector<std::string>& order : {std::vector{empty, full}, {full, empty}}) {
    EXPECT_EQ(merge_maps(folder.path() / "all", order), 1u);
    std::filesystem::remove_all(folder.path() / "all");
  }
  EXPECT_THAT(rejection_of([&] { merge_maps(folder.path() / "all", {empty}); }),
              HasSubstr("empty: got no cell, here and in the other folders"));
  write_file(folder.path() / "empty" / "map.csv", "i_x,x,beta\n0,0,1\n");
  EXPECT_THAT(rejection_of([&] {
                merge_maps(folder.path() / "all", {empty, full});
              }),
              HasSubstr("line 1: got 'i_x,x,beta', expected the columns of a map"));
}

TEST_F(MapStoreTest, MergesNoOtherValuesAndNoOtherMap) {
  open("a").put(cell(1));
  MapCell other = cell(1);
  other.beta += 1e-9;
  open("b").put(other);
  const std::string a = folder.path() / "a", b = folder.path() / "b", c = folder.path() / "c";
  EXPECT_THAT(rejection_of([&] {
                merge_maps(folder.path() / "all", {a, b});
              }),
              HasSubstr("another value of a cell"));
  plan.over.front().high = 5;
  open("c").put(cell(1));
  EXPECT_THAT(rejection_of([&] {
                merge_maps(folder.path() / "all", {a, c});
              }),
              HasSubstr("another map"));
}

}  // namespace
}  // namespace maxwrench
