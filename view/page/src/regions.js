// The regions of good postures as projections on each pair of redundant coordinates. A click, or a key, shows a posture there.
import { bytesOf } from "./bytes.js";
import { byId, make } from "./dom.js";
import { shown, withUnit, words } from "./format.js";

const kWidth = 320; // pixels of a projection, whatever its size on the screen
const kHeight = 240;
const kColours = { light: ["#0b6fb8", "#e8590c", "#2f9e44", "#8f3fd1", "#c2255c", "#a67c00"], dark: ["#63b3ed", "#ff8a4c", "#69db7c", "#c79bff", "#f783ac", "#ffd43b"] };
const kOther = { light: "#b3bec7", dark: "#5a6772" }; // clusters without a colour of their own, or without a good posture that was found
const kNear = 8; // pixels: a click beside a small box still counts
const kMostTried = 300; // boxes of a click
const kStep = 1 / 40; // of a key, share of the width

/** Ends of boxes: 16-bit shares of the limits. */
function endsOf(text, { low, extent }) {
  const bytes = bytesOf(text);
  return Float64Array.from({ length: bytes.length / 2 }, (_, k) => low[k % low.length] + ((bytes[2 * k] + 256 * bytes[2 * k + 1]) / 65535) * extent[k % low.length]);
}

export class Regions {
  /** `engine` evaluates postures; `act` has `move`, `rested`, `frame` and `dark`. */
  constructor(within, scene, engine, act) {
    Object.assign(this, { within, engine, act });
    this.coordinates = scene.task.theta_r;
    this.unit = scene.task.unit;
    const d = (this.d = this.coordinates.length);
    this.lower = endsOf(within.lower, within);
    this.upper = endsOf(within.upper, within);
    this.cluster = bytesOf(within.cluster);
    this.range = this.coordinates.map((_, i) => {
      let [low, high] = [Infinity, -Infinity];
      for (let k = i; k < this.lower.length; k += d) [low, high] = [Math.min(low, this.lower[k]), Math.max(high, this.upper[k])];
      const margin = 0.06 * (high - low) + 1e-6;
      return [low - margin, high + margin];
    });
    byId("regions-section").hidden = false;
    this.describe();
    this.addClusters();
    const pairs = d === 1 ? [[0, null]] : this.coordinates.flatMap((_, j) => this.coordinates.slice(0, j).map((_, i) => [i, j]));
    this.panels = pairs.map(([i, j]) => this.panel(i, j));
    byId("projections").replaceChildren(...this.panels.map((panel) => panel.figure));
  }

  describe() {
    const { share, status, reason, least, holding, clusters_all: all, boxes, drawn } = this.within;
    const texts = [
      `Every posture with ${withUnit(least, this.unit, 5)} or more, within ${shown(100 * share)} % of the best, is in the coloured regions: this is proven.`,
      holding < all ? `${holding} of ${all} clusters hold such postures, the other ones may.` : `${all} cluster${all === 1 ? " holds" : "s hold"} such postures.`,
      status === "proven" ? "" : `The list ended early (${reason ?? status.replaceAll("_", " ")}): its boxes are larger.`,
      drawn < boxes ? `${boxes} boxes are joined into ${drawn}.` : "",
      this.engine ? "Click to see a posture. Keys: arrows and Enter." : "This task cannot be evaluated in a page.",
    ];
    byId("regions-about").textContent = texts.filter(Boolean).join(" ");
  }

  addClusters() {
    byId("clusters").replaceChildren(...this.within.clusters.flatMap((cluster, k) => cluster.theta_r === null ? [] : [
      make("button", { type: "button", disabled: !this.engine, onclick: () => this.show(cluster.theta_r, `the best of cluster ${k + 1}`) },
        make("span", { class: "swatch", "data-cluster": k }), `${k + 1}: ${withUnit(cluster.beta, this.unit, 5)}`),
    ]));
  }

  panel(i, j) {
    const name = (k) => words(this.coordinates[k].name);
    const canvas = make("canvas", { width: kWidth, height: j === null ? kHeight / 4 : kHeight, tabindex: 0, role: "img",
      "aria-label": `Good postures: ${name(i)}${j === null ? "" : ` and ${name(j)}`}. Arrow keys move a mark, Enter shows a posture there.` });
    const panel = { i, j, canvas, mark: null };
    canvas.addEventListener("click", (event) => {
      const box = canvas.getBoundingClientRect();
      panel.mark = [this.valueAt(i, (event.clientX - box.left) / box.width), j === null ? 0 : this.valueAt(j, 1 - (event.clientY - box.top) / box.height)];
      this.pick(panel);
    });
    canvas.addEventListener("keydown", (event) => this.key(panel, event));
    canvas.addEventListener("blur", () => this.set(this.frame));
    canvas.addEventListener("focus", () => this.set(this.frame));
    const range = (k) => `${this.range[k].map((x) => shown(x, 3)).join(" \u2026 ")} ${this.coordinates[k].unit}`;
    const oneLine = (text) => text.replaceAll(" ", "\u00a0");
    const lines = [`\u2192 ${name(i)}, ${oneLine(range(i))}`, ...(j === null ? [] : [`\u2191 ${name(j)}, ${oneLine(range(j))}`])];
    panel.figure = make("figure", {}, canvas, make("figcaption", {}, ...lines.map((line) => make("span", {}, line))));
    return panel;
  }

  valueAt(k, share) {
    const [low, high] = this.range[k];
    return low + Math.min(Math.max(share, 0), 1) * (high - low);
  }

  /** Where a value of a coordinate is in a panel, in pixels of its canvas. */
  across = (k, value) => ((value - this.range[k][0]) / (this.range[k][1] - this.range[k][0])) * kWidth;
  up = (j, value) => (j === null ? kHeight / 8 : kHeight - ((value - this.range[j][0]) / (this.range[j][1] - this.range[j][0])) * kHeight);

  colourOf(cluster) {
    const scheme = this.act.dark ? "dark" : "light";
    const holds = this.within.clusters[cluster]?.holds;
    return holds && cluster < kColours[scheme].length ? kColours[scheme][cluster] : kOther[scheme];
  }

  /** Paints the boxes, the best clusters above the others: for a theme. */
  paint() {
    for (const swatch of byId("clusters").querySelectorAll(".swatch")) swatch.style.background = this.colourOf(Number(swatch.dataset.cluster));
    const order = Array.from(this.cluster.keys()).sort((a, b) => this.cluster[b] - this.cluster[a]);
    for (const panel of this.panels) {
      const { i, j, canvas } = panel;
      panel.boxes = make("canvas", { width: canvas.width, height: canvas.height });
      const pen = panel.boxes.getContext("2d");
      for (const k of order) {
        const [x, right] = [this.across(i, this.lower[this.d * k + i]), this.across(i, this.upper[this.d * k + i])];
        const [y, low] = j === null ? [0, canvas.height] : [this.up(j, this.upper[this.d * k + j]), this.up(j, this.lower[this.d * k + j])];
        pen.fillStyle = this.colourOf(this.cluster[k]);
        pen.fillRect(x, y, Math.max(right - x, 1), Math.max(low - y, 1));
      }
    }
    if (this.frame) this.set(this.frame);
  }

  /** Marks the posture of a frame, and where the keys are. */
  set(frame) {
    this.frame = frame;
    if (!frame) return;
    const ink = getComputedStyle(document.documentElement).getPropertyValue("--ink");
    for (const { i, j, canvas, boxes, mark } of this.panels) {
      if (!boxes) continue;
      const pen = canvas.getContext("2d");
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.drawImage(boxes, 0, 0);
      pen.strokeStyle = ink;
      pen.lineWidth = 2.5;
      const [x, y] = [this.across(i, frame.theta_r[i]), this.up(j, frame.theta_r[j ?? i])];
      pen.beginPath();
      pen.arc(x, y, 8, 0, 2 * Math.PI);
      pen.stroke();
      if (!mark || document.activeElement !== canvas) continue;
      pen.lineWidth = 1.5;
      pen.beginPath();
      const [a, b] = [this.across(i, mark[0]), this.up(j, mark[1])];
      pen.moveTo(a, 0);
      pen.lineTo(a, canvas.height);
      if (j !== null) pen.moveTo(0, b);
      if (j !== null) pen.lineTo(kWidth, b);
      pen.stroke();
    }
  }

  key(panel, event) {
    const { i, j } = panel;
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if ((!steps[event.key] && event.key !== "Enter") || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    panel.mark ??= [this.frame.theta_r[i], j === null ? 0 : this.frame.theta_r[j]];
    if (event.key === "Enter") return this.pick(panel);
    const moved = (k, value, step) => (k === null ? 0 : this.valueAt(k, (value - this.range[k][0]) / (this.range[k][1] - this.range[k][0]) + step * kStep));
    const [right, up] = steps[event.key];
    panel.mark = [moved(i, panel.mark[0], right), moved(j, panel.mark[1], up)];
    this.set(this.frame);
    const at = [i, ...(j === null ? [] : [j])].map((k, n) => `${words(this.coordinates[k].name)} ${withUnit(panel.mark[n], this.coordinates[k].unit, 3)}`).join(", ");
    byId("said").textContent = `${at}: ${this.boxesAt(panel).length ? "good postures may be here" : "no good posture"}`;
  }

  /** The boxes under the mark of a panel, or those that are a few pixels away; those with the largest bounds first. */
  boxesAt({ i, j, mark: [x, y] }) {
    const apart = (k, at, value) => Math.max(this.lower[this.d * k + at] - value, value - this.upper[this.d * k + at], 0);
    const pixels = (k) => Math.hypot((apart(k, i, x) / (this.range[i][1] - this.range[i][0])) * kWidth, j === null ? 0 : (apart(k, j, y) / (this.range[j][1] - this.range[j][0])) * kHeight);
    const near = Array.from(this.cluster.keys()).map((k) => ({ k, pixels: pixels(k) })).filter((each) => each.pixels <= kNear);
    const under = near.filter((each) => each.pixels === 0);
    return (under.length ? under : near.sort((a, b) => a.pixels - b.pixels)).slice(0, kMostTried).map((each) => each.k);
  }

  /** Shows the best of the postures in the middles of the boxes under the mark, as far as the mark leaves them. */
  pick(panel) {
    const { i, j, mark } = panel;
    const boxes = this.boxesAt(panel);
    if (!boxes.length) {
      this.set(this.frame);
      byId("said").textContent = "No good posture is here.";
      return;
    }
    if (!this.engine) {
      byId("said").textContent = "This task cannot be evaluated in a page.";
      return;
    }
    let best = null;
    for (const k of boxes) {
      const within = (at, value) => Math.min(Math.max(value, this.lower[this.d * k + at]), this.upper[this.d * k + at]);
      const theta = this.coordinates.map((_, at) => (at === i ? within(i, mark[0]) : at === j ? within(j, mark[1]) : (this.lower[this.d * k + at] + this.upper[this.d * k + at]) / 2));
      const { beta, status } = this.engine.evaluate(theta, Array.from(this.frame.theta));
      if (!best || (status === "optimal" && !(beta <= best.beta))) best = { theta, beta: status === "optimal" ? beta : -Infinity, cluster: this.cluster[k] };
    }
    const name = best.cluster < this.within.clusters.length ? `cluster ${best.cluster + 1}` : "another cluster";
    this.show(best.theta, `${name}${best.beta >= this.within.least ? "" : "; not itself within the share"}`);
  }

  show(theta, what) {
    this.act.move(Array.from(theta), Array.from(this.frame.theta));
    this.act.rested();
    byId("said").textContent = `${withUnit(this.frame.beta, this.unit, 5)}, ${what}`;
  }
}
