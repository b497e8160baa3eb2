// What the page shows, and how the controls change it.
import { kTitles, showComparison } from "./compare.js";
import { byId } from "./dom.js";
import { showExplanation, showScenarios } from "./explain.js";
import { frameAt, someOf } from "./frames.js";
import { shown, valueText, words } from "./format.js";
import { read, written } from "./hash.js";
import { Labels } from "./labels.js";
import { Live } from "./live.js";
import { Panel } from "./panel.js";
import { save } from "./picture.js";
import { Regions } from "./regions.js";
import { Stage } from "./stage.js";
import { roundStep } from "./surroundings.js";
import { Timeline } from "./timeline.js";
import { World } from "./world.js";

const kShow = ["wrench", "polytope", "ellipsoid", "efforts", "surroundings", "axes", "ghosts", "beside"];
const kGhosts = 6; // of a trajectory

export class App {
  /** `engine` evaluates postures in the page; null: there are only the frames of the scene. */
  constructor(scene, engine) {
    this.scene = scene;
    this.engine = engine;
    this.live = new Live(scene, engine, () => this.rested());
    this.timed = scene.task.type !== "static";
    this.show = { wrench: true, polytope: true, ellipsoid: false, efforts: true, surroundings: true, axes: false, ghosts: this.timed, beside: false };
    this.scale = 1;
    this.t = 0;
    this.stage = new Stage(byId("canvas"), scene.robot.water);
    const frames = scene.shown.flatMap((each) => each.frames);
    for (const frame of frames) frame.limits = scene.robot.actuators;
    this.world = new World(scene, frames);
    this.stage.scene.add(this.world);
    this.labels = new Labels(byId("labels"), this.stage);
    this.stage.drawn = () => this.labels.place();
    this.stage.setSubject(this.world.bounds, this.world.from());
    this.panel = new Panel(scene, this, Boolean(engine));
    this.timeline = this.timed ? new Timeline(scene, scene.shown[0], this) : null;
    this.regions = scene.within ? new Regions(scene.within, scene, engine, this) : null;
    this.name = scene.shown[0].name;
  }

  /** Postures or trajectories: those of the scene, and that of the sliders. */
  get entries() {
    return this.live.own ? [...this.scene.shown, this.live.own] : this.scene.shown;
  }

  get entry() {
    return this.entries.find((each) => each.name === this.name);
  }

  /** Switches to a posture or trajectory. */
  showPosture(name) {
    if (!this.entries.some((each) => each.name === name)) return;
    this.name = name;
    this.timeline?.setEntry(this.entry);
    this.solutions = null;
    this.draw();
    this.rested();
    byId("said").textContent = `${name}: ${valueText(this.frame.beta, this.frame.unit, 5)}, ${this.frame.status.replaceAll("_", " ")}`;
  }

  goTo(t) {
    this.t = t;
    this.draw();
    clearTimeout(this.resting);
    if (!this.timeline.playing) this.resting = setTimeout(() => this.rested(), 150);
  }

  /** Moves one redundant coordinate, of a trajectory at the knot nearest to the cursor. */
  slide(i, value) {
    const replaced = (list) => Array.from(list, (x, k) => (k === i ? value : x));
    if (!this.timed) return this.move(replaced(this.frame.theta_r), this.frame.theta);
    const knot = this.knot;
    this.moveKnots(this.entry.knots.map((row, k) => (k === knot ? replaced(row) : row)), knot);
  }

  /** Evaluates a posture in the page. */
  move(theta, near) {
    this.live.move(theta, Array.from(near));
    this.name = "own";
    this.draw();
  }

  /** The knot nearest to the cursor. */
  get knot() {
    const times = this.scene.task.knot_times;
    return times.reduce((best, t, k) => (Math.abs(t - this.t) < Math.abs(times[best] - this.t) ? k : best), 0);
  }

  /** Moves the cursor to the knot before or behind. */
  stepKnot(step) {
    const times = this.scene.task.knot_times;
    this.timeline.pause();
    this.goTo(times[Math.min(Math.max(this.knot + step, 0), times.length - 1)]);
  }

  /** Evaluates a trajectory in the page. */
  moveKnots(knots, knot) {
    this.timeline.pause();
    this.live.moveKnots(knots, (own) => {
      this.name = "own";
      this.t = this.scene.task.knot_times[knot];
      this.timeline.setEntry(own);
      this.draw();
      this.rested();
    });
  }

  /** What takes longer than a frame of the picture, when nothing moves. */
  rested() {
    if (!this.engine) return;
    if (this.timed) {
      this.live.findSets(this.entry, this.frame, true);
      this.draw();
      return;
    }
    const theta = this.frame.theta;
    const distance = (f) => Math.max(...f.theta.map((q, i) => Math.abs(q - theta[i])));
    this.solutions = this.live.solutions(this.frame);
    this.panel.setSolutions(this.solutions, this.solutions.findIndex((f) => distance(f) < 1e-6));
    this.draw();
  }

  choose(i) {
    this.move(this.frame.theta_r, this.solutions[i].theta);
    this.rested();
  }

  highlight(i) {
    this.world.efforts.highlight(i);
    this.panel.highlight(i);
    this.timeline?.highlight(i);
    this.stage.invalidate();
  }

  /** What is shown of an entry: a posture, or a trajectory at the cursor. */
  frameOf(entry) {
    const at = this.timed ? frameAt(entry.frames, this.t) : entry.frames[0];
    const frame = this.timed ? { ...at, near: at.near ?? at } : at; // an instant keeps its own sets
    if (this.timed) this.live.findSets(entry, frame, false);
    const { u_min: min, u_max: max } = entry.scenarios ?? {};
    frame.limits = this.scene.robot.actuators.map((actuator, i) => (min ? { ...actuator, min: min[i], max: max[i] } : actuator));
    return frame;
  }

  /** Draws what is chosen. */
  draw() {
    const entries = this.entries;
    const frames = entries.map((entry) => this.frameOf(entry));
    this.frame = frames[entries.indexOf(this.entry)];
    const beside = this.show.beside && entries.length > 1;
    this.world.model.setGhosts(this.show.ghosts && !beside ? this.ghosts(entries, frames) : []);
    const views = beside ? frames : [this.frame];
    this.stage.setViews(views.map((frame) => () => this.world.set(frame, this.show, this.scale)));
    const title = (k) => ({ text: `${kTitles[entries[k].name]}  ${valueText(frames[k].beta, frames[k].unit, 4)}`, kind: entries[k].name === this.name ? "title chosen" : "title" });
    this.labels.set(views.map((frame, k) => [...(beside ? [title(k)] : []), ...this.world.set(frame, this.show, this.scale)]));
    this.panel.set(this.frame, this.entry, this.timed ? this.knot : null);
    showComparison(this.scene, entries, frames, this.name);
    showExplanation(this.entry.explanation, this.frame, this.frame.unit, this.entry.stale);
    showScenarios(this.entry.scenarios, this.frame.unit, this.entry.stale, this.timed ? this.t : undefined);
    this.timeline?.set(this.t);
    this.regions?.set(this.frame);
    this.describe();
  }

  ghosts(entries, frames) {
    if (this.timed) return someOf(this.entry.frames, kGhosts);
    return frames.filter((_, k) => entries[k].name !== this.name);
  }

  describe() {
    const { frame, world } = this;
    const round = (metres, unit) => {
      const value = roundStep((0.3 * world.size) / metres);
      return `${shown(value)} ${unit} is ${shown(value * metres, 3)} m`;
    };
    const scales = [`grid ${shown(world.surroundings.step)} m`];
    if (frame.sets?.of === "torque") scales.push(`set: ${round(world.setMetres * this.scale, "N m")}`);
    else scales.push(`forces: ${round(world.forceMetres * this.scale, "N")}`);
    byId("scales").textContent = scales.join(" \u00b7 ");
    byId("canvas").setAttribute("aria-label",
      `${words(this.scene.robot.name)}, ${this.name}: ${valueText(frame.beta, frame.unit, 5)}. Arrow keys turn the picture, plus and minus zoom.`);
    const note = this.show.polytope || this.show.ellipsoid ? this.setNote() : "";
    byId("set-note").hidden = !note;
    byId("set-note").textContent = note;
  }

  /** Of what the sets are, if not of exactly what is shown. */
  setNote() {
    const { frame } = this;
    if (!this.timed) return frame.sets === undefined && this.name === "own" ? "The sets follow when the slider rests." : "";
    const of = frame.setsOf;
    return frame.sets && of && Math.abs(of.t - frame.t) > 1e-9 ? `The sets are those at ${shown(of.t, 4)} s.` : "";
  }

  /** The view as an address shows it. */
  get view() {
    const own = this.name === "own" ? this.live.own : null;
    return {
      posture: this.name, theta: own && !this.timed ? Array.from(own.frames[0].theta_r) : null, near: own && !this.timed ? Array.from(own.frames[0].theta) : null,
      knots: own && this.timed ? own.knots.flat() : null,
      t: this.timed ? this.t : null, camera: this.stage.view, show: kShow.filter((key) => this.show[key]), scale: this.scale, theme: this.theme,
    };
  }

  /** Shows the view of an address; leaves out what it does not give. */
  restore(hash) {
    const coordinates = this.scene.task.theta_r.length;
    const view = read(hash, coordinates, coordinates * (this.scene.task.knot_times ?? []).length);
    if (view.show) for (const key of kShow) this.show[key] = view.show.includes(key);
    if (view.scale > 0) this.setScale(view.scale);
    if (view.t !== null && this.timed) this.t = Math.min(Math.max(view.t, 0), this.timeline.end);
    this.setTheme(view.theme);
    if (view.theta && this.engine && !this.timed) this.move(view.theta, view.near ?? this.scene.shown[0].frames[0].theta);
    if (view.knots && this.engine && this.timed) this.restoreKnots(view.knots, coordinates);
    this.showPosture(this.scene.shown[0].name);
    this.showPosture(view.posture ?? this.name);
    this.stage.resize();
    this.stage.frame();
    if (view.camera) this.stage.view = view.camera;
    for (const key of kShow) byId(`show-${key}`).checked = this.show[key];
  }

  restoreKnots(numbers, coordinates) {
    const knots = Array.from({ length: numbers.length / coordinates }, (_, k) => numbers.slice(k * coordinates, (k + 1) * coordinates));
    this.live.moveKnots(knots, () => {});
  }

  setShown(key, value) {
    this.show[key] = value;
    this.draw();
    if (key === "beside") this.stage.frame();
  }

  setScale(scale) {
    this.scale = scale;
    byId("scale").value = Math.log2(scale);
  }

  /** Light, dark, or as the system has it. */
  setTheme(theme) {
    this.theme = theme;
    const dark = theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    byId("theme").setAttribute("aria-pressed", String(dark));
    this.stage.setTheme(dark ? "dark" : "light");
    this.regions?.paint();
  }

  get dark() {
    return document.documentElement.dataset.theme === "dark";
  }

  async copyLink() {
    history.replaceState(null, "", `#${written(this.view)}`);
    try {
      await navigator.clipboard.writeText(location.href);
      byId("said").textContent = "The link is copied.";
    } catch {
      byId("said").textContent = "The link is in the address bar.";
    }
  }

  save() {
    save(this.stage, this.labels, this.scene.task.name);
  }
}
