// What binds: the limits at work, in words first; and the scenarios of a list.
import { byId, make } from "./dom.js";
import { shown, unbroken, withUnit, words } from "./format.js";

const row = (tag, ...cells) => make("tr", {}, ...cells.map((cell) => make(tag, {}, unbroken(cell))));

const kSides = { min: "lower", max: "upper", smaller: "smaller" };

function table(head, rows) {
  return make("table", { class: "numbers" }, make("thead", {}, row("th", ...head)), make("tbody", {}, ...rows.map((cells) => row("td", ...cells))));
}

/** Names are long: each stands above its numbers. */
function namedTable(head, rows) {
  const lines = rows.flatMap(([name, ...cells]) => [make("tr", { class: "name" }, make("td", { colspan: head.length }, name)), row("td", ...cells)]);
  return make("table", { class: "numbers named" }, make("thead", {}, row("th", ...head)), make("tbody", {}, ...lines));
}

const nameOf = (limit) => `${words(limit.actuator ?? limit.name)}, ${kSides[limit.limit] ?? limit.limit}`;

/** Limits, what 10 % more of each gives, and between which values that rate holds. */
function bindingTable({ binding }, unit) {
  const range = (limit) => (limit.rate_up === null ? "\u2013"
    : `${limit.down === null ? "\u2212\u221e" : shown(limit.at - limit.down, 4)} \u2026 ${limit.up === null ? "\u221e" : shown(limit.at + limit.up, 4)}`);
  // At a kink a limit that falls and one that rises have rates of their own.
  const rate = ({ rate, rate_down: down, rate_up: up }) => (up === null || shown(down, 4) === shown(up, 4) ? shown(rate, 4) : `${shown(down, 4)} / ${shown(up, 4)}`);
  return namedTable(["at", `10\u00a0% more [${unit}]`, "rate", "holds\u00a0in"],
    binding.map((limit) => [nameOf(limit), withUnit(limit.at, limit.unit, 4), limit.gain === null ? "\u2013" : shown(limit.gain, 4), rate(limit), range(limit)]));
}

function ratesTable(limits, unit) {
  return namedTable(["at", `rate [${unit} per unit]`], limits.map((limit) => [nameOf(limit), withUnit(limit.at, limit.unit, 4), shown(limit.rate, 4)]));
}

/** The value as a sum of what limits and loads contribute. */
function budgetWords({ budget, binding }, unit) {
  if (!budget) return null;
  const parts = [["limits", binding.reduce((sum, limit) => sum + limit.share, 0)], ...["weight", "buoyancy", "trim", "other"].map((name) => [name, budget[name]])];
  const terms = parts.filter(([, value]) => Math.abs(value) > 1e-9).map(([name, value]) => `${name} ${shown(value, 5)}`);
  return `The value is the sum of ${terms.join(", ")} ${unit}.`;
}

function ofPosture(explanation, unit) {
  if (explanation.missing) return [make("p", {}, `Not known: ${words(explanation.missing)}.`)];
  const parts = explanation.words.trim().split("\n").map((line) => make("p", {}, sentence(line)));
  if (explanation.binding.length) parts.push(bindingTable(explanation, unit));
  const more = [];
  const sum = budgetWords(explanation, unit);
  if (sum) more.push(make("p", {}, sum));
  const best = explanation.best_posture;
  if (!best.missing && best.limits.length) more.push(make("p", {}, "If the posture is optimised again, to first order:"), ratesTable(best.limits, unit));
  else if (best.missing) more.push(make("p", {}, `With the posture optimised again there are no rates: ${best.missing}.`));
  const least = explanation.least_efforts;
  if (least.u) more.push(make("p", {}, `Marks in the list of efforts are the least efforts for the same wrench: |W\u1d64 u| is ${shown(least.norm, 4)}${least.vertex_norm === null ? "" : `, that of the efforts shown ${shown(least.vertex_norm, 4)}`}.`));
  parts.push(make("details", {}, make("summary", {}, "more"), ...more));
  return parts;
}

const sentence = (line) => {
  const text = words(line.replace(/^binds: /, ""));
  return unbroken(text.charAt(0).toUpperCase() + text.slice(1) + ".");
};

function ofInstant(explanation, frame, unit) {
  if (explanation.missing) return [make("p", {}, `Not known: ${words(explanation.missing)}.`)];
  const at = explanation.instants.find((instant) => Math.abs(instant.t - frame.near.t) < 1e-9);
  const where = `at ${withUnit(frame.near.t, "s", 4)}`;
  if (!at) {
    const times = [...new Set(explanation.instants.map((instant) => shown(instant.t, 3)))];
    return [make("p", {}, `No limit counts ${where}. ${times.length ? `The value is determined at ${times.slice(0, 8).join(", ")}${times.length > 8 ? " \u2026" : ""} s.` : ""}`)];
  }
  return [make("p", {}, `${sentence(at.words).slice(0, -1)} ${where}.`), ratesTable(at.limits, unit)];
}

let written = []; // what stands there

/** Writes what binds at a frame. `stale`: it is that of the posture before. */
export function showExplanation(explanation, frame, unit, stale) {
  const section = byId("binds-section");
  section.hidden = !explanation;
  section.classList.toggle("stale", Boolean(stale));
  const key = [explanation, frame.near?.t];
  if (!explanation || key.every((part, i) => part === written[i])) return;
  written = key;
  const open = byId("binds").querySelector("details")?.open;
  byId("binds").replaceChildren(...(frame.t === undefined ? ofPosture(explanation, unit) : ofInstant(explanation, frame, unit)));
  const details = byId("binds").querySelector("details");
  if (details && open) details.open = true;
}

const endText = (value, none) => (value === null ? none : shown(value, 5));

/** The ends of a list at a posture. */
function endsTable({ ends }, unit) {
  const rows = ends.map((each) => [words(each.name), ...(each.held ? [endText(each.low, "\u2212\u221e"), endText(each.high, "\u221e")] : ["not held", ""])]);
  return table(["scenario", `from [${unit}]`, `to [${unit}]`], rows);
}

/** The instant whose numbers stand for a time. */
const nearestIn = (times, t) => times.reduce((best, time, i) => (Math.abs(time - t) < Math.abs(times[best] - t) ? i : best), 0);

/** The scenarios over the whole motion, each alone, and at an instant. */
function endsInTime({ ends, t: times }, unit, t) {
  const at = nearestIn(times, t);
  const most = (each) => (each.held ? endText(each.high, "\u2013") : "not held");
  return namedTable([`throughout [${unit}]`, `at ${shown(times[at], 3)} s [${unit}]`], ends.map((each) => [words(each.name), most(each), endText(each.values[at], "\u2013")]));
}

/** Which scenario has least left at a time; limits of effort rates join instants and are left out. */
function worstAt({ ends, t: times }, unit, t) {
  const at = nearestIn(times, t);
  const left = ends.filter((each) => each.values[at] !== null);
  if (!left.length) return "";
  const worst = left.reduce((a, b) => (b.values[at] < a.values[at] ? b : a));
  return ` At ${shown(times[at], 3)} s least is left with ${words(worst.name)}: ${withUnit(worst.values[at], unit, 5)}, limits of effort rates aside.`;
}

/** Writes which scenario decides, and the ends of all; `t` is the cursor of a task in time. */
export function showScenarios(scenarios, unit, stale, t) {
  const section = byId("scenarios-section");
  section.hidden = !scenarios;
  section.classList.toggle("stale", Boolean(stale));
  if (!scenarios) return;
  const all = scenarios.count === 1 ? "the only scenario" : `of ${scenarios.count} scenarios`;
  const when = scenarios.decides_at === undefined || scenarios.decides_at === null ? "" : ` at ${shown(scenarios.decides_at, 4)} s`;
  const decides = scenarios.decides ? `${words(scenarios.decides)} decides${when}, ${all}; the picture shows its efforts.` : `None of them decides (${scenarios.count}).`;
  const listed = scenarios.ends?.length;
  const inTime = listed && t !== undefined;
  byId("decides").textContent = decides + (inTime ? worstAt(scenarios, unit, t) : "");
  if (!listed) byId("ends").replaceChildren(make("p", { class: "note" }, "They are too many to be listed."));
  else byId("ends").replaceChildren(inTime ? endsInTime(scenarios, unit, t) : endsTable(scenarios, unit));
}
