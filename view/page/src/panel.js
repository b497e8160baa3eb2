// The panel beside the picture: value, postures, redundant coordinates, efforts, what is shown.
import { byId, make } from "./dom.js";
import { colourOf, kAtLimit, shareOf } from "./efforts.js";
import { shown, withUnit, words } from "./format.js";

const css = (colour) => `#${colour.getHexString()}`;
const titles = { best: "Best", default: "Default", given: "Given", own: "Yours" };

export class Panel {
  /** `act` has the functions that the controls call. */
  constructor(scene, act, live) {
    this.scene = scene;
    this.act = act;
    byId("name").textContent = scene.task.name;
    byId("about").textContent = `${scene.robot.name} \u00b7 ${scene.measure}, wrench ${scene.wrench}`;
    this.addPostures(live);
    this.addCoordinates(live);
    this.addEfforts();
  }

  addPostures(live) {
    const names = this.scene.shown.map((each) => each.name);
    if (live) names.push("own");
    this.postures = names.map((name, i) => {
      const input = make("input", { type: "radio", name: "posture", id: `posture-${name}`, value: name, onchange: () => this.act.showPosture(name), disabled: name === "own" });
      const value = make("small", {}, name === "own" ? "move a slider" : withUnit(this.scene.shown[i].beta, this.scene.shown[i].unit, 4));
      byId("postures").append(input, make("label", { for: input.id }, titles[name], value));
      return { name, input, value };
    });
  }

  addCoordinates(live) {
    this.sliders = this.scene.task.theta_r.map((coordinate, i) => {
      const id = `theta-${i}`;
      const output = make("output", { for: id });
      const input = make("input", {
        type: "range", id, min: coordinate.min, max: coordinate.max, step: "any", disabled: !live,
        oninput: () => this.act.move(this.sliders.map((slider) => Number(slider.input.value))),
      });
      byId("coordinates").append(make("div", { class: "coordinate" }, make("label", { for: id }, words(coordinate.name)), output, input));
      return { input, output, unit: coordinate.unit };
    });
    byId("coordinates-note").textContent = live ? "Each keeps the task and moves the robot." : this.scene.task.type === "static" ? "This task cannot be evaluated in a page." : "They follow the time below the picture.";
  }

  addEfforts() {
    this.efforts = this.scene.robot.actuators.map((actuator, i) => {
      const bar = make("span", { class: "bar" });
      const value = make("span", { class: "value" });
      const light = () => this.act.highlight(i);
      const item = make("li", { tabindex: 0, onpointerenter: light, onfocus: light, onpointerleave: () => this.act.highlight(-1), onblur: () => this.act.highlight(-1) },
        make("span", { class: "actuator" }, words(actuator.name)), value, make("span", { class: "track" }, bar));
      byId("efforts").append(item);
      return { item, bar, value, actuator };
    });
  }

  /** Writes a frame's numbers. */
  set(frame, name) {
    const beta = byId("beta");
    beta.textContent = shown(frame.beta, 5);
    beta.dataset.value = frame.beta ?? "";
    byId("unit").textContent = frame.unit;
    const status = byId("status");
    status.textContent = frame.status.replaceAll("_", " ") + (frame.reason ? `: ${frame.reason}` : "");
    status.classList.toggle("bad", !frame.u.length && !Number.isFinite(frame.beta ?? NaN));
    for (const posture of this.postures) {
      posture.input.checked = posture.name === name;
      if (posture.name !== "own" || name !== "own") continue;
      posture.input.disabled = false;
      posture.value.textContent = withUnit(frame.beta, frame.unit, 4);
    }
    this.sliders.forEach((slider, i) => {
      slider.input.value = frame.theta_r[i];
      slider.output.textContent = withUnit(frame.theta_r[i], slider.unit, 4);
    });
    this.efforts.forEach((effort, i) => this.setEffort(effort, frame.u[i]));
  }

  setEffort({ item, bar, value, actuator }, u) {
    const given = u !== undefined;
    const share = given ? shareOf(actuator, u) : 0;
    value.textContent = given ? withUnit(u, actuator.unit, 4) : "\u2013";
    const limit = u < 0 ? actuator.min : actuator.max;
    item.title = limit === null ? "no limit" : `${(100 * share).toFixed(1)} % of ${withUnit(limit, actuator.unit)}`;
    item.classList.toggle("limit", share >= kAtLimit);
    bar.style.cssText = `width: ${50 * share}%; ${u < 0 ? "right" : "left"}: 50%; background: ${css(colourOf(share))}`;
  }

  highlight(i) {
    this.efforts.forEach((effort, k) => effort.item.classList.toggle("lit", k === i));
  }

  /** Buttons for the IK solutions of a posture; none if there is only one. */
  setSolutions(frames, chosen) {
    const several = frames.length > 1 ? frames : [];
    byId("solutions-section").hidden = !several.length;
    byId("solutions").replaceChildren(...several.map((frame, i) =>
      make("button", { type: "button", "aria-pressed": String(i === chosen), onclick: () => this.act.choose(i) }, `${i + 1}: ${withUnit(frame.beta, frame.unit, 4)}`)));
  }
}
