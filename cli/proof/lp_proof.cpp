#include "cli/proof/lp_proof.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/tables/write_file.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

constexpr const char* kFormat = "lp proof 1";

std::string file_objective(const MpsProgram& mps, const LpProof& proof) {
  if (proof.status != Status::kOptimal) return "";
  mpq_class sum = exact_objective(mps.program, proof.x);
  if (mps.minimize) sum = -sum;
  sum += mps.constant;
  return sum.get_str();
}

std::vector<std::string> fractions(const RationalVector& v) {
  std::vector<std::string> all;
  for (const mpq_class& each : v) all.push_back(each.get_str());
  return all;
}

/// Whether the text is like "-12" or "-12/5", without any other sign or blank, and with a
/// denominator other than zero.
bool is_fraction(const std::string& text) {
  const auto digits = [](std::string_view part) {
    return !part.empty() && part.find_first_not_of("0123456789") == part.npos;
  };
  const std::string_view whole = std::string_view(text).substr(text.starts_with('-') ? 1 : 0);
  const std::size_t bar = whole.find('/');
  if (bar == whole.npos) return digits(whole);
  const std::string_view below = whole.substr(bar + 1);
  return digits(whole.substr(0, bar)) && digits(below) &&
         below.find_first_not_of('0') != below.npos;
}

[[noreturn]] void throw_bad_input(const std::string& file, const std::string& why) {
  throw std::invalid_argument(file + ": " + why + ", expected a certificate of 'lp --certificate'");
}

RationalVector read_fractions(const std::string& file, const ordered_json& object,
                              const char* key) {
  RationalVector all;
  for (const auto& each : object.at(key)) {
    const auto text = each.get<std::string>();
    if (!is_fraction(text)) throw_bad_input(file, fmt::format("{}: got '{:.40}'", key, text));
    all.emplace_back(text);
    all.back().canonicalize();
  }
  return all;
}

Status read_status(const std::string& file, const std::string& name) {
  for (const Status status : {Status::kOptimal, Status::kInfeasible, Status::kUnbounded}) {
    if (name == to_string(status)) return status;
  }
  throw_bad_input(file, fmt::format("status: got '{:.40}'", name));
}

}  // namespace

std::string lp_proof_text(const std::string& mps_file, const MpsProgram& mps,
                          const LpProof& proof) {
  const ordered_json object = {{"maxwrench", kFormat},
                               {"version", version()},
                               {"file", mps_file},
                               {"status", to_string(proof.status)},
                               {"objective", file_objective(mps, proof)},
                               {"x", fractions(proof.x)},
                               {"lambda", fractions(proof.lambda)},
                               {"certificate", fractions(proof.certificate)}};
  return object.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

bool is_lp_proof(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream.get() == '{';
}

LpVerification verify_lp(const std::string& file, const std::string& mps_file) {
  const ordered_json object = ordered_json::parse(text_of(file), nullptr, false);
  LpVerification result;
  LpProof proof;
  try {
    if (object.at("maxwrench") != kFormat) throw_bad_input(file, "maxwrench: got another format");
    result.mps_file = mps_file.empty() ? object.at("file").get<std::string>() : mps_file;
    result.objective = object.at("objective").get<std::string>();
    proof.status = result.status = read_status(file, object.at("status").get<std::string>());
    proof.x = read_fractions(file, object, "x");
    proof.lambda = read_fractions(file, object, "lambda");
    proof.certificate = read_fractions(file, object, "certificate");
  } catch (const nlohmann::json::exception&) {
    throw_bad_input(file, "got a missing key or a key of the wrong type");
  }
  const MpsProgram mps = read_mps(result.mps_file);
  result.rejection = reject_lp_proof(mps.program, proof);
  if (result.rejection.empty() && result.objective != file_objective(mps, proof)) {
    result.rejection = "the objective is " + file_objective(mps, proof);
  }
  return result;
}

}  // namespace maxwrench
