// Best, default and a user's posture beside each other, as a table.
import { byId, make } from "./dom.js";
import { kAtLimit, shareOf } from "./efforts.js";
import { shown, words } from "./format.js";

export const kTitles = { best: "Best", default: "Default", given: "Given", own: "Yours" };

const atLimit = (frame, actuators) => (frame.u.length ? actuators.filter((actuator, i) => shareOf(actuator, frame.u[i]) >= kAtLimit).map((actuator) => words(actuator.name)) : []);

/** `entries` are postures or trajectories; `frames` what is shown of each, with its limits. */
export function showComparison(scene, entries, frames, chosen) {
  const base = entries.find((entry) => entry.name === "default");
  const unit = entries[0].unit;
  const value = (entry) => (Number.isFinite(entry.beta ?? NaN) ? entry.beta : null);
  const gain = (entry) => (base && value(entry) !== null && value(base) > 0 ? `${shown(value(entry) / value(base), 3)}\u00d7` : "\u2013");
  const at = scene.task.type === "static" ? "" : " at the cursor";
  const rows = [
    [`value [${unit}]`, ...entries.map((entry) => shown(value(entry), 5))],
    ["of the default", ...entries.map(gain)],
    ...scene.task.theta_r.map((coordinate, i) => [`${words(coordinate.name)} [${coordinate.unit}]${at}`, ...frames.map((frame) => shown(frame.theta_r[i], 3))]),
    [`efforts at their limits${at}`, ...frames.map((frame) => (frame.u.length ? String(atLimit(frame, frame.limits).length) : "\u2013"))],
  ];
  const cell = (tag, text, k) => make(tag, { class: k > 0 && entries[k - 1].name === chosen ? "chosen" : null, scope: tag === "th" ? (k ? "col" : "row") : null }, text);
  byId("compare").replaceChildren(
    make("thead", {}, make("tr", {}, ...["", ...entries.map((entry) => kTitles[entry.name])].map((text, k) => cell("th", text, k)))),
    make("tbody", {}, ...rows.map((cells) => make("tr", {}, ...cells.map((text, k) => cell(k ? "td" : "th", text, k))))),
  );
}
