// What the page shows, and how the controls change it.
import { byId } from "./dom.js";
import { frameAt, someOf } from "./frames.js";
import { shown, withUnit, words } from "./format.js";
import { read, written } from "./hash.js";
import { Labels } from "./labels.js";
import { Panel } from "./panel.js";
import { save } from "./picture.js";
import { Stage } from "./stage.js";
import { roundStep } from "./surroundings.js";
import { Timeline } from "./timeline.js";
import { World } from "./world.js";

const kShow = ["wrench", "polytope", "ellipsoid", "efforts", "surroundings", "axes", "ghosts"];
const kGhosts = 6; // of a trajectory

export class App {
  /** `engine` evaluates postures in the page; null: there are only the frames of the scene. */
  constructor(scene, engine) {
    this.scene = scene;
    this.engine = engine;
    this.timed = scene.task.type !== "static";
    this.show = { wrench: true, polytope: true, ellipsoid: false, efforts: true, surroundings: true, axes: false, ghosts: this.timed };
    this.scale = 1;
    this.t = 0;
    this.stage = new Stage(byId("canvas"), scene.robot.water);
    this.world = new World(scene, scene.shown.flatMap((each) => each.frames));
    this.stage.scene.add(this.world);
    this.labels = new Labels(byId("labels"), this.stage);
    this.stage.drawn = () => this.labels.place();
    this.stage.setSubject(this.world.bounds, this.world.from());
    this.panel = new Panel(scene, this, Boolean(engine));
    this.timeline = this.timed ? new Timeline(scene, scene.shown[0].frames, this) : null;
    this.name = scene.shown[0].name;
  }

  get entry() {
    return this.scene.shown.find((each) => each.name === this.name);
  }

  /** Switches to a posture or trajectory of the scene. */
  showPosture(name) {
    if (name === "own" ? !this.own : !this.scene.shown.some((each) => each.name === name)) return;
    this.name = name;
    if (this.timeline) this.timeline.setFrames(this.entry.frames);
    this.solutions = null;
    this.draw();
    this.findSolutions();
    byId("said").textContent = `${name}: ${withUnit(this.frame.beta, this.frame.unit, 5)}, ${this.frame.status.replaceAll("_", " ")}`;
  }

  goTo(t) {
    this.t = t;
    this.draw();
  }

  /** Evaluates a posture in the page. */
  move(theta, near = this.frame.theta) {
    this.own = this.engine.evaluate(theta, Array.from(near));
    this.name = "own";
    this.draw();
    clearTimeout(this.later);
    this.later = setTimeout(() => this.findSolutions(), 120);
  }

  findSolutions() {
    if (!this.engine) return;
    const theta = this.frame.theta;
    const distance = (f) => Math.max(...f.theta.map((q, i) => Math.abs(q - theta[i])));
    this.solutions = this.engine.solutions(this.frame.theta_r);
    this.panel.setSolutions(this.solutions, this.solutions.findIndex((f) => distance(f) < 1e-6));
  }

  choose(i) {
    this.own = this.solutions[i];
    this.name = "own";
    this.draw();
    this.findSolutions();
  }

  highlight(i) {
    this.world.efforts.highlight(i);
    this.panel.highlight(i);
    this.timeline?.highlight(i);
    this.stage.invalidate();
  }

  /** Draws what is chosen. */
  draw() {
    this.frame = this.name === "own" ? this.own : this.timed ? frameAt(this.entry.frames, this.t) : this.entry.frames[0];
    this.world.model.setGhosts(this.show.ghosts ? this.ghosts() : []);
    this.labels.set(this.world.set(this.frame, this.show, this.scale));
    this.panel.set(this.frame, this.name);
    this.timeline?.set(this.t);
    this.describe();
    this.stage.invalidate();
  }

  ghosts() {
    if (this.timed) return someOf(this.entry.frames, kGhosts);
    return this.scene.shown.filter((each) => each.name !== this.name).map((each) => each.frames[0]);
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
      `${words(this.scene.robot.name)}, ${this.name}: ${withUnit(frame.beta, frame.unit, 5)}. Arrow keys turn the picture, plus and minus zoom.`);
    byId("set-note").hidden = Boolean(frame.sets) || !(this.show.polytope || this.show.ellipsoid);
  }

  /** The view as an address shows it. */
  get view() {
    return {
      posture: this.name, theta: this.name === "own" ? Array.from(this.own.theta_r) : null, near: this.name === "own" ? Array.from(this.own.theta) : null,
      t: this.timed ? this.t : null, camera: this.stage.view, show: kShow.filter((key) => this.show[key]), scale: this.scale, theme: this.theme,
    };
  }

  /** Shows the view of an address; leaves out what it does not give. */
  restore(hash) {
    const view = read(hash, this.scene.task.theta_r.length);
    if (view.show) for (const key of kShow) this.show[key] = view.show.includes(key);
    if (view.scale > 0) this.setScale(view.scale);
    if (view.t !== null && this.timed) this.t = Math.min(Math.max(view.t, 0), this.timeline.end);
    this.setTheme(view.theme);
    this.showPosture(this.name);
    this.showPosture(view.posture ?? this.name);
    if (view.theta && this.engine) this.move(view.theta, view.near ?? this.frame.theta);
    this.stage.resize();
    this.stage.frame();
    if (view.camera) this.stage.view = view.camera;
    for (const key of kShow) byId(`show-${key}`).checked = this.show[key];
  }

  setShown(key, value) {
    this.show[key] = value;
    this.draw();
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
