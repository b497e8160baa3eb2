#include "view/page.h"

#include <fmt/format.h>

#include <cassert>
#include <string_view>

#include "drawing/svg.h"
#include "solvers/solve/format.h"
#include "view/base64.h"
#include "view/engine/module.h"
#include "view/engine/problem_data.h"
#include "view/page_file.h"

namespace maxwrench {
namespace {

/// JSON that no HTML parser takes for the end of its element.
std::string in_script(const std::string& json) {
  std::string result;
  for (const char c : json) result += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return result;
}

/// The engine and the task for it; empty if it does not support the task.
std::string engine_html(const Problem& task) {
  if (!why_no_engine(task).empty()) return "";
  constexpr const char* kData = "<script type=\"text/plain\" id=\"{}\">{}</script>\n";
  return fmt::format("<script>{}</script>\n", engine_loader()) +
         fmt::format(kData, "engine-module", base64(engine_module())) +
         fmt::format(kData, "engine-task", base64(problem_data(task)));
}

}  // namespace

std::string view_page(const Problem& task, const nlohmann::ordered_json& scene) {
  std::string text;
  std::string_view rest = page_file();
  const auto fill = [&](std::string_view mark, const std::string& with) {
    const std::size_t at = rest.find(mark);
    assert(at != std::string_view::npos);
    text += rest.substr(0, at);
    text += with;
    rest.remove_prefix(at + mark.size());
  };
  fill("{{title}}", escaped(task.name));
  fill("{{scene}}", in_script(in_one_line(scene)));
  fill("{{engine}}", engine_html(task));
  text += rest;
  return text;
}

}  // namespace maxwrench
