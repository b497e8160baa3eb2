#include "maxwrench/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>

#include "benchmarks/suite/map_store.h"
#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/suite/shard_option.h"
#include "cli/task/problem_options.h"
#include "maxwrench/figures.h"
#include "solvers/map/plan_check.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

struct MapCommandOptions : CommonOptions {
  ProblemOptions source;
  std::vector<std::string> over;
  std::string out, figure, shard = "1/1";
  MapPlan plan;
  bool again = false;
};

/// NAME=LOW:HIGH:COUNT.
MapAxis parse_axis(const std::string& text) {
  const auto throw_bad = [&text] {
    throw std::invalid_argument(
        fmt::format("over: got '{}', expected NAME=LOW:HIGH:COUNT such as x=-0.2:0.2:9", text));
  };
  const std::size_t equals = text.find('='), first = text.find(':'),
                    last = text.find(':', first + 1);
  if (equals == std::string::npos || first == std::string::npos || last == std::string::npos) {
    throw_bad();
  }
  MapAxis axis{text.substr(0, equals)};
  const auto read = [&](std::size_t begin, std::size_t end, auto& number) {
    const auto [at, error] = std::from_chars(text.data() + begin, text.data() + end, number);
    if (error != std::errc() || at != text.data() + end) throw_bad();
  };
  read(equals + 1, first, axis.low);
  read(first + 1, last, axis.high);
  read(last + 1, text.size(), axis.count);
  return axis;
}

/// Rejects before the search what `map_figure` does not draw.
void require_drawable(const MapPlan& plan) {
  const auto several = std::count_if(plan.over.begin(), plan.over.end(),
                                     [](const MapAxis& axis) { return axis.count > 1; });
  const auto count = static_cast<long>(plan.over.size());
  if (count <= 3 && (several == count || count == 3)) return;
  throw std::invalid_argument(
      fmt::format("figure: got {} coordinates, {} of them with several values, expected 1, 2 or 3",
                  count, several));
}

int print_map(const MapCommandOptions& options) {
  require_apart(options.source.inputs(options.choice.problem), {{"--figure", options.figure}});
  const Problem problem = options.source.load(options.choice.problem);
  require_static(problem, "map");
  MapPlan plan = options.plan;
  for (const std::string& text : options.over) plan.over.push_back(parse_axis(text));
  std::tie(plan.shard, plan.shards) = parse_shard(options.shard);
  check_plan(problem, plan);
  if (!options.figure.empty()) require_drawable(plan);
  Options how = options.read_options();
  CtrlC ctrl_c;
  how.interrupted = ctrl_c.asked();
  std::unique_ptr<MapStore> store;
  if (!options.out.empty()) {
    const Method method = resolve(problem, with_map_search(problem, how));
    store = std::make_unique<MapStore>(options.out, problem, plan, method.choice, options.again);
    plan.known = [&store](const std::vector<long>& index) { return store->find(index); };
    plan.computed = [&store](const MapCell& cell) { store->put(cell); };
  }
  double all = 1;
  for (const MapAxis& axis : plan.over) all *= static_cast<double>(axis.count);
  Progress progress("map", all / plan.shards);
  plan.progress = [&progress](long finished, long) {
    progress.show(static_cast<double>(finished));
  };
  const CapabilityMap result = map(problem, plan, how);
  progress.finish();
  if (store) store->write();
  if (!options.figure.empty() && result.best() != nullptr) {
    write_file(options.figure, map_figure(result));
  }
  fmt::print("{}", options.json ? to_json(result) + "\n" : summary(result));
  return result.status == Status::kBestFound ? kAnswered : kOtherStatus;
}

}  // namespace

void add_map(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<MapCommandOptions>();
  CLI::App& command = *app.add_subcommand(
      "map", "finds the best wrench over a grid of poses, directions and parameters");
  options->add_case(command);
  options->add_search(command);
  command.get_option("--search")
      ->description(
          "search of each cell, or stages joined by + (default: facet_sqp where it applies, else "
          "crs2+cmaes)");
  command.get_option("--budget")->description("evaluation budget of each cell (default: 3000)");
  options->add_threads(command);
  options->add_json(command);
  options->source.add(command);
  command
      .add_option(
          "--over", options->over,
          "NAME=LOW:HIGH:COUNT for each coordinate: x y z roll pitch yaw (offsets of the "
          "pose), azimuth elevation (of c), wrench (its number), thrust torque or the name of "
          "an actuator (factors of limits), environment.gravity, environment.water_density, "
          "environment.current.x (.y .z), trim.buoyancy_mass, links.NAME.mass (values in place of "
          "the robot's), payload.mass (carried beside the wrench), wrench.ball.radius, "
          "uncertainty.trim (.mass.NAME .volume.NAME .payload.mass) (in place of the task's)")
      ->required();
  command
      .add_option("--refine", options->plan.refine,
                  "how often cells are halved whose corners differ")
      ->capture_default_str()
      ->check(whole_number(0, kMostHalvings));
  command
      .add_option("--tolerance", options->plan.tolerance,
                  "the difference of corners, as a share, above which a cell is halved")
      ->capture_default_str();
  CLI::Option* check = command.add_option("--check", options->plan.check,
                                          "share of the cells that a search from scratch checks");
  command
      .add_option("--check-budget", options->plan.check_budget,
                  "evaluations of such a search (default: it is restarted until another optimum is "
                  "unlikely)")
      ->check(CLI::Range(1L, long{kMostBudget}))
      ->needs(check);
  CLI::Option* certify =
      command.add_flag("--certify", options->plan.bound, "also prove a bound in each cell");
  command.add_option("--gap", options->plan.gap, "the gap at which such a proof is complete")
      ->capture_default_str()
      ->needs(certify);
  command.add_option("--time", options->plan.seconds, "seconds after which such a proof ends")
      ->capture_default_str()
      ->needs(certify);
  command.add_option("--out", options->out, "folder for the cells, map.csv.gz")
      ->check(reject_empty);
  command.add_flag("--again", options->again, "compute existing cells again, too");
  command.add_option("--shard", options->shard, "I/N: only part I of N")->capture_default_str();
  command.add_option("--figure", options->figure, "SVG file for the map")->check(reject_empty);
  command.callback([options, &exit_status] { exit_status = print_map(*options); });
}

}  // namespace maxwrench
