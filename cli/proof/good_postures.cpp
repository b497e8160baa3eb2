#include "cli/proof/good_postures.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "drawing/projections.h"
#include "solvers/certify/box_coordinates.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

constexpr double kLeastShare = kLeastGap / kGapPart;
/// The most clusters that are printed.
constexpr std::size_t kPrinted = 20;

/// "1%", "1 %" or "0.01"; NaN for any other text.
double parse_share(std::string text) {
  double unit = 1;
  if (text.ends_with('%')) {
    unit = 0.01;
    text.pop_back();
    while (text.ends_with(' ')) text.pop_back();
  }
  double number = 0;
  const bool read = CLI::detail::lexical_cast(text, number);
  return read ? unit * number : std::nan("");
}

std::string reject_share(const std::string& text) {
  const double share = parse_share(text);
  if (share >= kLeastShare && share <= 1) return "";
  return fmt::format("got '{}', expected a share from {:g} to 1, or from {:g}% to 100%", text,
                     kLeastShare, 100 * kLeastShare);
}

std::string reject_resolution(const std::string& text) {
  double side = 0;
  const bool read = CLI::detail::lexical_cast(text, side);
  if (read && side >= kLeastResolution && side < kInfinity) return "";
  return fmt::format("got '{}', expected a number >= {:g} [rad or m]", text, kLeastResolution);
}

const char* word_of(const GoodPostures& good, const Cluster& cluster) {
  return good.holds(cluster) ? "holds" : "may_hold";
}

long holding(const GoodPostures& good) {
  long count = 0;
  for (const Cluster& cluster : good.clusters) count += good.holds(cluster) ? 1 : 0;
  return count;
}

void print_cluster(const BoxCoordinates& coordinates, const GoodPostures& good, std::size_t i) {
  const Cluster& cluster = good.clusters[i];
  const bool found = cluster.best.value > -kInfinity;
  fmt::print("{:<3} {:<9} {:>9} {:>10} {:>8}   theta_r {}\n", i + 1,
             good.holds(cluster) ? "holds" : "may hold",
             found ? fmt::format("{:.5f}", cluster.best.value) : "-", cluster.boxes,
             percent(cluster.share), found ? line(cluster.best.theta_r) : " none found");
  for (int k = 0; k < coordinates.count(); ++k) {
    fmt::print("{:>44}   {:.3f} to {:.3f} {}\n", coordinates.name(k), cluster.lower[k],
               cluster.upper[k], coordinates.unit(k));
  }
}

/// The longest side.
double widest(const GoodPostures& good) {
  double most = 0;
  for (const GoodBox& box : good.boxes) {
    for (const double side : box.upper - box.lower) most = std::max(most, side);
  }
  return most;
}

std::string boxes_csv(const GoodPostures& good) {
  const Eigen::Index d = good.boxes.front().lower.size();
  std::string text;
  for (const char* end : {"lower", "upper"}) {
    for (Eigen::Index i = 1; i <= d; ++i) text += fmt::format("{}_{},", end, i);
  }
  text += "cluster,high\n";
  for (const GoodBox& box : good.boxes) {
    for (const Eigen::VectorXd* end : {&box.lower, &box.upper}) {
      for (const double side : *end) text += fmt::format("{:.17g},", side);
    }
    text += fmt::format("{},{:.17g}\n", box.cluster + 1, box.high);
  }
  return text;
}

/// The best clusters that hold good postures, the other ones that do, and those that may.
std::vector<BoxGroup> groups_of(const GoodPostures& good, const char* unit) {
  std::vector<BoxGroup> groups;
  const auto holds = static_cast<std::size_t>(holding(good));
  const std::size_t coloured = std::min(holds, kBoxColours);
  for (std::size_t i = 0; i < coloured; ++i) {
    const Cluster& cluster = good.clusters[i];
    groups.push_back(
        {fmt::format("{}: {:.5g} {}", i + 1, cluster.best.value, unit), false, {}, {}, cluster.x});
  }
  const std::size_t others = groups.size();
  groups.push_back({"other boxes that hold such postures", true, {}, {}});
  groups.push_back({"may hold such postures", true, {}, {}});
  for (const GoodBox& box : good.boxes) {
    const auto cluster = static_cast<std::size_t>(box.cluster);
    const std::size_t place = cluster < coloured ? cluster : cluster < holds ? others : others + 1;
    groups[place].lower.push_back(box.lower);
    groups[place].upper.push_back(box.upper);
  }
  std::erase_if(groups, [](const BoxGroup& group) { return group.lower.empty(); });
  return groups;
}

std::string draw_good(const Answer& row, const GoodPostures& good, const WithinOptions& options) {
  const Problem& problem = *row.task;
  std::vector<BoxAxis> axes;
  const BoxCoordinates coordinates(problem);
  for (int i = 0; i < coordinates.count(); ++i) {
    axes.push_back({coordinates.name(i), coordinates.unit(i), good.lower[i], good.upper[i]});
  }
  const std::string title = fmt::format("{}: within {} of {:.5g} {}", problem.name,
                                        percent(options.share()), row.capability.beta, row.unit);
  return draw_projections(title, axes, groups_of(good, row.unit.c_str()));
}

}  // namespace

void WithinOptions::add_list(CLI::App& command) {
  CLI::Option* const asked =
      command
          .add_option("--within", within,
                      "list all postures within this share of the best, such as 1%")
          ->check(reject_share);
  command.add_option("--resolution", resolution, "longest side of the listed boxes [rad or m]")
      ->capture_default_str()
      ->check(reject_resolution)
      ->needs(asked);
}

void WithinOptions::add(CLI::App& command) {
  add_list(command);
  CLI::Option* const asked = command.get_option("--within");
  command.add_option("--figure", figure, "SVG file for the projections of the boxes")
      ->check(reject_empty)
      ->needs(asked);
  command.add_option("--boxes", boxes, "CSV file for the boxes")->check(reject_empty)->needs(asked);
}

void WithinOptions::require_listable(const Problem& problem) const {
  if (asked() && problem.contact) {
    throw std::invalid_argument("--within: got a task with a second contact, expected one without");
  }
}

double WithinOptions::share() const { return parse_share(within); }

GoodPostures verified_good_postures(const Problem& problem, const Method& method,
                                    const Bound& bound, double high, GoodOptions options,
                                    Answer& row) {
  const MeasureMaker& make = method.make_measure;
  options.turns = BoxCoordinates(problem).turns();
  if (!problem.dependent.empty()) {
    options.make_postures = make_all_postures(problem, row.choice.wrench, make);
  }
  const auto objective = make_capability_objective(problem, row.choice.wrench, make);
  GoodPostures good = find_good_postures(*objective, bound,
                                         {row.posture.theta_r, row.capability.beta}, high, options);
  for (Cluster& cluster : good.clusters) {
    if (cluster.best.value == -kInfinity) continue;
    const Answer found = evaluate(problem, cluster.best.theta_r, {method.choice});
    if (!found.has_value()) {
      cluster.best = {};
    } else if (found.capability.beta > row.capability.beta) {
      row = found;
    }
  }
  return good;
}

void print_good(const Problem& problem, const GoodPostures& good, const WithinOptions& options) {
  const std::string share = percent(options.share());
  fmt::print("\nwithin    {}: {}{}{}\n", share, to_string(good.status),
             good.reason.empty() ? "" : ": ", good.reason.c_str());
  fmt::print("boxes     {}, sides at most {:.3g}: no posture outside is within {} of the best\n",
             good.boxes.size(), widest(good), share);
  fmt::print("least     {:>9.5f} {} is within {}\n", good.least, problem.unit(), share);
  const long holds = holding(good);
  fmt::print("clusters  {} hold such postures, {} may; {} boxes were bounded in {:.3g} s\n\n",
             holds, static_cast<long>(good.clusters.size()) - holds, good.bounded, good.seconds);
  fmt::print("{:<13} {:>9} {:>10} {:>8}\n", "cluster", problem.unit(), "boxes", "volume");
  const std::size_t printed = std::min(kPrinted, good.clusters.size());
  const BoxCoordinates coordinates(problem);
  for (std::size_t i = 0; i < printed; ++i) print_cluster(coordinates, good, i);
  if (printed < good.clusters.size()) {
    fmt::print("and {} more: --json lists all\n", good.clusters.size() - printed);
  }
}

nlohmann::ordered_json to_json(const Problem& problem, const GoodPostures& good,
                               const WithinOptions& options) {
  const BoxCoordinates named(problem);
  auto coordinates = nlohmann::ordered_json::array();
  for (int i = 0; i < named.count(); ++i) coordinates.push_back(named.name(i));
  auto clusters = nlohmann::ordered_json::array();
  for (const Cluster& cluster : good.clusters) {
    const bool found = cluster.best.value > -kInfinity;
    clusters.push_back({{"status", word_of(good, cluster)},
                        {"boxes", cluster.boxes},
                        {"volume", cluster.share},
                        {"lower", array(cluster.lower)},
                        {"upper", array(cluster.upper)},
                        {"bound", known(std::isfinite(cluster.high), cluster.high)},
                        {"beta", known(found, cluster.best.value)},
                        {"theta_r", known(found, array(cluster.best.theta_r))},
                        {"x", known(found, array(cluster.x))}});
  }
  return {{"share", options.share()},
          {"least", good.least},
          {"resolution", options.resolution},
          {"widest", widest(good)},
          {"status", to_string(good.status)},
          {"reason", good.reason.str()},
          {"boxes", good.boxes.size()},
          {"bounded", good.bounded},
          {"wall_s", good.seconds},
          {"coordinates", coordinates},
          {"clusters", clusters}};
}

void write_good(const Answer& row, const GoodPostures& good, const WithinOptions& options) {
  if (!options.boxes.empty()) write_file(options.boxes, boxes_csv(good));
  if (!options.figure.empty()) write_file(options.figure, draw_good(row, good, options));
}

}  // namespace maxwrench
