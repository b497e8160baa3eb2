#include "cli/report/page.h"

#include <fmt/format.h>

#include "drawing/svg.h"

namespace maxwrench {
namespace {

/// The most rows of a table that a browser shows without delay; the CSV file has all.
constexpr std::size_t kMostShown = 5000;

constexpr const char* kStyle = R"(
:root { color-scheme: light; --ink: #1f2429; --soft: #5b6770; --line: #dfe5ea; --blue: #0072b2; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.2rem; max-width: 1280px; color: var(--ink); background: #fff;
  font: 15px/1.5 Helvetica, Arial, "DejaVu Sans", sans-serif; }
h1 { margin: 0; font-size: 1.6rem; overflow-wrap: anywhere; } h2 { margin: 2.4rem 0 .3rem; font-size: 1.2rem; }
a { color: var(--blue); }
nav a { display: inline-block; margin: .2rem 1rem .2rem 0; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .1rem 1rem; margin: .8rem 0; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
pre { overflow-x: auto; padding: .6rem; background: #f6f8f9; font-size: .85rem; }
summary { cursor: pointer; color: var(--soft); }
.note { max-width: 75ch; margin: .2rem 0 .6rem; color: var(--soft); }
.figures { display: flex; flex-wrap: wrap; gap: 1rem; }
.figures figure { margin: 0; flex: 0 1 400px; border: 1px solid var(--line); border-radius: 6px; }
.figures svg { display: block; width: 100%; height: auto; border-radius: 6px; }
.tools { display: flex; flex-wrap: wrap; align-items: center; gap: .3rem 1rem; margin: .8rem 0 .3rem; }
.tools input { font: inherit; padding: .25rem .5rem; width: 16rem; max-width: 100%;
  border: 1px solid #b4bfc7; border-radius: 6px; }
.tools output { color: var(--soft); }
.scroll { overflow: auto; max-height: 34rem; border: 1px solid var(--line); border-radius: 6px; }
table { border-collapse: separate; border-spacing: 0; min-width: 100%; font-size: .85rem; }
th { position: sticky; top: 0; background: #f0f3f5; text-align: left; }
th button { font: inherit; font-weight: bold; width: 100%; padding: .35rem .6rem; border: 0;
  background: none; color: inherit; text-align: inherit; white-space: nowrap; cursor: pointer; }
th[aria-sort=ascending] button::after { content: " \25B2"; }
th[aria-sort=descending] button::after { content: " \25BC"; }
td { padding: .2rem .6rem; border-top: 1px solid var(--line); white-space: nowrap; }
.n { text-align: right; font-variant-numeric: tabular-nums; }
tbody tr:hover td { background: #eef6fb; }
@media (max-width: 600px) { body { padding: .8rem; } dl { grid-template-columns: 1fr; }
  dd { margin-bottom: .3rem; } .tools input { width: 100%; } }
)";

constexpr const char* kScript = R"(
for (const table of document.querySelectorAll("table")) {
  const body = table.tBodies[0], rows = [...body.rows];
  const tools = table.closest(".scroll").previousElementSibling;
  const input = tools.querySelector("input"), output = tools.querySelector("output");
  const texts = new Map(rows.map(row => [row, row.innerText.toLowerCase()]));
  const filter = () => {
    const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      row.hidden = !words.every(word => texts.get(row).includes(word));
      shown += row.hidden ? 0 : 1;
    }
    output.textContent = shown === rows.length ? `${shown} rows` : `${shown} of ${rows.length} rows`;
  };
  // Cells without a value stay below in both orders.
  const sort = th => {
    const column = th.cellIndex, number = th.classList.contains("n");
    const sign = th.ariaSort === "ascending" ? -1 : 1;
    for (const other of th.parentNode.cells) other.ariaSort = null;
    th.ariaSort = sign > 0 ? "ascending" : "descending";
    const text = row => row.cells[column].textContent;
    rows.sort((a, b) => {
      const x = text(a), y = text(b);
      if (x === "" || y === "") return (x === "") - (y === "");
      return sign * (number ? x - y : x.localeCompare(y, "en", {numeric: true}));
    });
    body.append(...rows);
  };
  input.addEventListener("input", filter);
  for (const th of table.tHead.rows[0].cells) th.firstChild.addEventListener("click", () => sort(th));
  filter();
}
)";

std::string head_html(const PageHead& head, const std::vector<ReportSection>& sections) {
  std::string text = fmt::format("<header>\n<h1>{}</h1>\n<dl>\n", escaped(head.title));
  for (const auto& [name, fact] : head.facts) {
    text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(fact));
  }
  text += "</dl>\n";
  for (const auto& [name, body] : head.texts) {
    text += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", escaped(name),
                        escaped(body));
  }
  text += "<nav>\n";
  for (const ReportSection& section : sections) {
    text +=
        fmt::format("<a href=\"#{}\">{}</a>\n", section.table.name, escaped(section.table.title));
  }
  return text + "</nav>\n</header>\n";
}

std::string section_html(const ReportSection& section) {
  const ReportTable& table = section.table;
  std::string text =
      fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", table.name, escaped(table.title));
  if (!table.note.empty()) {
    text += fmt::format("<p class=\"note\">{}</p>\n", escaped(table.note));
  }
  if (!section.figures.empty()) {
    text += "<div class=\"figures\">\n";
    for (const std::string& svg : section.figures) text += "<figure>" + svg + "</figure>\n";
    text += "</div>\n";
  }
  text += table.rows.empty() ? "<p>none</p>\n" : html_of_table(table, kMostShown);
  return text + "</section>\n";
}

}  // namespace

std::string html_page(const PageHead& head, const std::vector<ReportSection>& sections) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n",
      escaped(head.title), kStyle);
  text += head_html(head, sections) + "<main>\n";
  for (const ReportSection& section : sections) text += section_html(section);
  return text + fmt::format("</main>\n<script>{}</script>\n</body>\n</html>\n", kScript);
}

}  // namespace maxwrench
