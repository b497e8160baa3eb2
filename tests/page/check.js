// Runs within a page of `report` and says what passed; whoever runs it looks for other lines of the console.
const check = (passed, what) => console.log((passed ? "passed: " : "failed: ") + what);

const cells = (table, column) => [...table.tBodies[0].rows].map(row => row.cells[column].textContent);

// Whether each cell may stand before the next; those without a value stand last.
const ordered = (texts, before) => texts.every((text, i) => i === 0 || text === "" || (texts[i - 1] !== "" && before(texts[i - 1], text)));

const sorts = (table, th) => {
  const column = th.cellIndex, before = cells(table, column);
  const words = new Intl.Collator("en", {numeric: true});
  const compare = th.className === "n" ? (a, b) => Number(a) - Number(b) : words.compare;
  th.querySelector("button").click();
  const up = cells(table, column), arrow = th.getAttribute("aria-sort") === "ascending";
  th.querySelector("button").click();
  const down = cells(table, column);
  const same = texts => JSON.stringify([...texts].sort()) === JSON.stringify([...before].sort());
  return arrow && th.getAttribute("aria-sort") === "descending" && same(up) && same(down) &&
    ordered(up, (a, b) => compare(a, b) <= 0) && ordered(down, (a, b) => compare(a, b) >= 0);
};

// By the words of the first cell in capitals, by a word that is nowhere, by none.
const filters = (section, table) => {
  const input = section.querySelector("input"), output = section.querySelector("output");
  const rows = [...table.tBodies[0].rows];
  const shown = text => {
    input.value = text;
    input.dispatchEvent(new Event("input"));
    return rows.filter(row => row.offsetParent !== null);
  };
  const words = rows[0].cells[0].textContent.toLowerCase().split(" ");
  const expected = rows.filter(row => words.every(word => row.innerText.toLowerCase().includes(word)));
  const found = shown(words.join(" ").toUpperCase());
  const right = found.length === expected.length && found.every(row => expected.includes(row));
  const none = shown("no such word anywhere").length === 0 && output.textContent === `0 of ${rows.length} rows`;
  return right && none && shown("").length === rows.length;
};

addEventListener("load", () => {
  check(innerWidth === document.expectedWidth, `the page is ${innerWidth} px wide`);
  const sections = [...document.querySelectorAll("section")];
  const wide = [...document.querySelectorAll("body *")].filter(
    element => !element.closest(".scroll, svg, pre") && element.getBoundingClientRect().right > innerWidth + 1);
  check(wide.length === 0 && document.documentElement.scrollWidth <= innerWidth, "wide tables scroll within their boxes, nothing else is too wide " + wide.map(e => e.tagName));
  check(document.querySelectorAll("[src], link:not([href^='data:']), script[src]").length === 0, "nothing comes from outside");
  check(sections.length > 3 && [...document.querySelectorAll("nav a")].every(a => document.querySelector(a.getAttribute("href"))), "links lead to sections");
  for (const section of sections) {
    const table = section.querySelector("table");
    if (!table) { check(section.textContent.includes("none"), `${section.id} is empty and says so`); continue; }
    check(filters(section, table), `${section.id} filters`);
    const wrong = [...table.tHead.rows[0].cells].filter(th => !sorts(table, th)).map(th => th.textContent);
    check(wrong.length === 0, `${section.id} sorts by each column ${wrong}`);
    check([...table.tHead.rows[0].cells].every(th => th.firstChild.title !== ""), `${section.id} explains its columns`);
  }
  console.log("the end");
});
