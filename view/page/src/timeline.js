// The time of a trajectory: play, pause, scrub, and curves with the same cursor.
import { byId, make } from "./dom.js";
import { shareOf } from "./efforts.js";
import { shown, withUnit, words } from "./format.js";

const kWidth = 300;
const kHeight = 96;

/** What the virtual tank reads along c, in a scale of its own: it differs little from what is planned. */
function tankPlot(tank, unit) {
  if (!tank?.curve.t.length) return [];
  const { t: times, planned, reading } = tank.curve;
  const [low, high] = [Math.min(...planned, ...reading), Math.max(...planned, ...reading)];
  const margin = Math.max(0.15 * (high - low), 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-9);
  return [{ title: `virtual tank [${unit}]`, digits: 5, range: [low - margin, high + margin],
    curves: [{ name: "planned", times, values: planned, soft: true }, { name: "reading of the virtual tank", times, values: reading, bold: true }] }];
}

const kMostScenarios = 12;

/** What the scenarios allow over time, those with least first; the one that decides is bold. */
function scenarioPlot(scenarios, unit) {
  if (!scenarios?.ends) return [];
  const curves = scenarios.ends.slice(0, kMostScenarios).map((each) => ({ name: words(each.name), times: scenarios.t, values: each.values.map((value) => value ?? NaN), bold: each.name === scenarios.decides }));
  return [{ title: `scenarios [${unit}]`, zero: true, curves }];
}

/** How an experiment ended. */
function verdictOf(tank, unit) {
  if (tank === null) return "The virtual tank has nothing to carry out.";
  const counts = tank.reading === null ? "" : `, reads ${withUnit(tank.reading, unit, 5)}${tank.t_h === null ? "" : ` at ${shown(tank.t_h, 4)} s`}`;
  const planned = tank.planned === null ? "" : ` (requested ${shown(tank.asked, 5)}, planned ${withUnit(tank.planned, unit, 5)})`;
  const why = tank.missed ?? tank.reason;
  return `Virtual tank: ${tank.held ? "held" : "not held"}${counts}${planned}${why ? `; ${why}` : ""}.`;
}

/** The curves of a trajectory: value, efforts and rates. */
function plotsOf(scene, frames) {
  const { actuators, joints } = scene.robot;
  const signed = (actuator, u) => Math.sign(u) * shareOf(actuator, u);
  const first = frames[0].v.length - joints.length;
  const speeds = joints.flatMap((joint, j) =>
    joint.rate ? [{ name: `speed of ${words(joint.name)}`, actuator: actuators.length - joints.length + j, values: frames.map((f) => f.v[first + j] / joint.rate) }] : []);
  const rates = actuators.flatMap((actuator, i) => {
    if (!actuator.rate || !frames[0].u.length) return [];
    const values = frames.map((f, k) => {
      const [a, b] = [frames[Math.max(k - 1, 0)], frames[Math.min(k, frames.length - 1)]];
      return b.t > a.t ? (b.u[i] - a.u[i]) / (b.t - a.t) / actuator.rate : 0;
    });
    return [{ name: `rate of ${words(actuator.name)}`, actuator: i, values, dashed: true }];
  });
  return [
    { title: `${/^N/.test(scene.task.unit) ? "wrench along c" : "value"} [${scene.task.unit}]`, zero: true, curves: [{ name: "wrench along c", values: frames.map((f) => f.beta ?? NaN), bold: true }] },
    { title: "efforts / limits", range: [-1, 1], curves: frames[0].u.length ? actuators.map((a, i) => ({ name: words(a.name), actuator: i, values: frames.map((f) => signed(a, f.u[i])) })) : [] },
    { title: "speeds, rates / limits", range: [-1, 1], curves: [...speeds, ...rates] },
  ];
}

export class Timeline {
  constructor(scene, entry, act) {
    this.act = act;
    this.scene = scene;
    byId("time").hidden = false;
    this.play = byId("play");
    this.slider = byId("instant");
    this.play.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("input", () => {
      this.pause();
      act.goTo(Number(this.slider.value));
    });
    this.setEntry(entry);
  }

  /** Draws the curves of a trajectory. One of the sliders has no experiment in the tank. */
  setEntry({ frames, tank, scenarios }) {
    this.frames = frames;
    this.tank = tank;
    this.end = frames[frames.length - 1].t;
    this.slider.max = this.end;
    const known = (curve) => curve.values.every(Number.isFinite);
    const unit = this.scene.task.unit;
    this.plots = [...plotsOf(this.scene, frames), ...scenarioPlot(scenarios, unit), ...tankPlot(tank, unit)].map((plot) => ({ ...plot, curves: plot.curves.filter(known) })).filter((plot) => plot.curves.length);
    byId("curves").replaceChildren(...this.plots.map((plot) => this.draw(plot)));
    const asked = this.scene.shown.some((each) => each.tank);
    byId("tank").hidden = !asked;
    byId("tank-verdict").textContent = !asked ? "" : tank === undefined ? "The virtual tank runs in the command only: maxwrench simulate." : verdictOf(tank, unit);
  }

  draw(plot) {
    const values = plot.curves.flatMap((curve) => curve.values).filter(Number.isFinite);
    let [low, high] = plot.range ?? [0, Math.max(...values, 1e-9) * 1.15];
    if (plot.zero) low = Math.min(0, ...values);
    const x = (t) => (t / this.end) * kWidth;
    const y = (value) => kHeight - ((value - low) / (high - low)) * kHeight;
    const grid = [low, (low + high) / 2, high].map((value) => make("line", { x1: 0, x2: kWidth, y1: y(value), y2: y(value), class: "grid" }));
    const curves = plot.curves.map((curve, i) => {
      const path = make("path", {
        d: curve.values.map((value, k) => `${k ? "L" : "M"}${x(curve.times ? curve.times[k] : this.frames[k].t).toFixed(2)} ${y(Math.min(Math.max(value, low), high)).toFixed(2)}`).join(""),
        class: `curve${curve.bold ? " bold" : ""}${curve.dashed ? " dashed" : ""}${curve.soft ? " soft dashed" : ""}`, style: curve.bold ? "" : `--hue: ${(i * 47) % 360}`,
        "data-actuator": curve.actuator,
        onpointerenter: () => curve.actuator !== undefined && this.act.highlight(curve.actuator), onpointerleave: () => this.act.highlight(-1),
      });
      path.append(Object.assign(document.createElementNS("http://www.w3.org/2000/svg", "title"), { textContent: curve.name }));
      return path;
    });
    plot.cursor = make("line", { y1: 0, y2: kHeight, class: "cursor" });
    plot.x = x;
    const svg = make("svg", {
      viewBox: `0 0 ${kWidth} ${kHeight}`, preserveAspectRatio: "none", role: "img", "aria-label": `${plot.title} over time`,
      onpointerdown: (event) => this.scrub(event), onpointermove: (event) => event.buttons && this.scrub(event),
    }, ...grid, ...curves, plot.cursor);
    const range = make("figcaption", {}, plot.title, make("small", {}, `${shown(low, plot.digits ?? 3)} \u2026 ${shown(high, plot.digits ?? 3)}`));
    return make("figure", {}, range, svg);
  }

  scrub(event) {
    const box = event.currentTarget.getBoundingClientRect();
    this.pause();
    this.act.goTo(Math.min(Math.max(((event.clientX - box.left) / box.width) * this.end, 0), this.end));
  }

  set(t) {
    this.t = t;
    this.slider.value = t;
    this.slider.setAttribute("aria-valuetext", `${shown(t, 3)} s`);
    byId("clock").textContent = `${t.toFixed(2)} / ${this.end.toFixed(2)} s`;
    byId("tank-reading").textContent = this.readingAt(t);
    for (const plot of this.plots) {
      plot.cursor.setAttribute("x1", plot.x(t));
      plot.cursor.setAttribute("x2", plot.x(t));
    }
  }

  /** What the tank reads at a time, of the sample nearest to it. */
  readingAt(t) {
    const times = this.tank?.curve.t ?? [];
    if (!times.length) return "";
    if (t > times[times.length - 1] + 0.02 * this.end) return " It has ended before the cursor.";
    const k = times.reduce((best, time, i) => (Math.abs(time - t) < Math.abs(times[best] - t) ? i : best), 0);
    return ` ${withUnit(this.tank.curve.reading[k], this.scene.task.unit, 5)} at the cursor.`;
  }

  highlight(i) {
    for (const path of byId("curves").querySelectorAll("path")) path.classList.toggle("lit", i >= 0 && path.dataset.actuator === String(i));
  }

  toggle() {
    if (this.playing) return this.pause();
    if (this.t >= this.end) this.act.goTo(0);
    this.label("Pause");
    let last = performance.now();
    const step = (now) => {
      const t = Math.min(this.t + Math.max(now - last, 0) / 1000, this.end);
      last = now;
      this.act.goTo(t);
      if (t < this.end) this.playing = requestAnimationFrame(step);
      else this.pause();
    };
    this.playing = requestAnimationFrame(step);
  }

  pause() {
    if (this.playing) cancelAnimationFrame(this.playing);
    this.playing = undefined;
    this.label("Play");
  }

  label(text) {
    this.play.textContent = text === "Play" ? "\u25b6" : "\u275a\u275a";
    this.play.setAttribute("aria-label", text);
  }
}
