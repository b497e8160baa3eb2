// The panel beside the picture: value, postures, redundant coordinates, efforts, what is shown.
import { byId, make } from "./dom.js";
import { kTitles } from "./compare.js";
import { colourOf, kAtLimit, shareOf } from "./efforts.js";
import { shown, valueText, withUnit, words } from "./format.js";

const css = (colour) => `#${colour.getHexString()}`;

export class Panel {
  /** `act` has the functions that the controls call. */
  constructor(scene, act, live) {
    this.scene = scene;
    this.act = act;
    byId("name").append(...scene.task.name.split(/(?<=[/_.])/).flatMap((part) => [part, make("wbr")]));
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
      const value = make("small", {}, name === "own" ? "move a slider" : valueText(this.scene.shown[i].beta, this.scene.shown[i].unit, 4));
      byId("postures").append(input, make("label", { for: input.id }, kTitles[name], value));
      return { name, input, value };
    });
  }

  addCoordinates(live) {
    this.sliders = this.scene.task.theta_r.map((coordinate, i) => {
      const id = `theta-${i}`;
      const output = make("output", { for: id });
      const input = make("input", {
        type: "range", id, min: coordinate.min, max: coordinate.max, step: "any", disabled: !live,
        oninput: () => this.act.slide(i, Number(input.value)),
      });
      byId("coordinates").append(make("div", { class: "coordinate" }, make("label", { for: id }, words(coordinate.name)), output, input));
      return { input, output, unit: coordinate.unit };
    });
    const times = this.scene.task.knot_times ?? [];
    this.note = !live ? () => "This task cannot be evaluated in a page."
      : !times.length ? () => "Each keeps the task and moves the robot."
      : (knot) => `They move knot ${knot + 1} of ${times.length}, at ${shown(times[knot], 4)} s, the one nearest to the cursor. The whole trajectory is evaluated at its instants.`;
    byId("knots").hidden = !live || !times.length;
    byId("knot-before").addEventListener("click", () => this.act.stepKnot(-1));
    byId("knot-behind").addEventListener("click", () => this.act.stepKnot(1));
  }

  addEfforts() {
    this.efforts = this.scene.robot.actuators.map((actuator, i) => {
      const bar = make("span", { class: "bar" });
      const value = make("span", { class: "value" });
      const least = make("span", { class: "least", hidden: true });
      const light = () => this.act.highlight(i);
      const item = make("li", { tabindex: 0, onpointerenter: light, onfocus: light, onpointerleave: () => this.act.highlight(-1), onblur: () => this.act.highlight(-1) },
        make("span", { class: "actuator" }, words(actuator.name)), value, make("span", { class: "track" }, bar, least));
      byId("efforts").append(item);
      return { item, bar, value, least, actuator };
    });
  }

  /** Writes the numbers of a frame of an entry; of a trajectory with the knot that sliders move. */
  set(frame, entry, knot) {
    const name = entry.name;
    const beta = byId("beta");
    beta.textContent = shown(frame.beta, 5);
    beta.dataset.value = frame.beta ?? "";
    byId("unit").textContent = frame.unit;
    const status = byId("status");
    status.textContent = frame.status.replaceAll("_", " ") + (frame.reason ? `: ${frame.reason}` : "") + (entry.collision ? `; collides: ${entry.collision}` : "");
    status.classList.toggle("bad", Boolean(entry.collision) || (!frame.u.length && !Number.isFinite(frame.beta ?? NaN)));
    byId("whole").textContent = knot !== null && Number.isFinite(entry.beta ?? NaN) ? `${withUnit(entry.beta, entry.unit, 5)} over the whole trajectory` : "";
    byId("coordinates-note").textContent = this.note(knot);
    for (const posture of this.postures) {
      posture.input.checked = posture.name === name;
      if (posture.name !== "own" || name !== "own") continue;
      posture.input.disabled = false;
      posture.value.textContent = valueText(entry.beta, entry.unit, 4);
    }
    this.sliders.forEach((slider, i) => {
      slider.input.value = frame.theta_r[i];
      slider.output.textContent = withUnit(frame.theta_r[i], slider.unit, 4);
    });
    const least = entry.explanation?.least_efforts?.u;
    this.efforts.forEach((effort, i) => this.setEffort(effort, frame.u[i], frame.limits[i], entry.stale ? undefined : least?.[i]));
  }

  setEffort({ item, bar, value, least: mark }, u, actuator, least) {
    const given = u !== undefined;
    const share = given ? shareOf(actuator, u) : 0;
    value.textContent = given ? withUnit(u, actuator.unit, 4) : "\u2013";
    const limit = u < 0 ? actuator.min : actuator.max;
    item.title = limit === null ? "no limit" : `${(100 * share).toFixed(1)} % of ${withUnit(limit, actuator.unit)}`;
    mark.hidden = least === undefined;
    if (least !== undefined) {
      item.title += `; least effort ${withUnit(least, actuator.unit, 4)}`;
      mark.style.left = `${50 + 50 * Math.sign(least) * shareOf(actuator, least)}%`;
    }
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
      make("button", { type: "button", "aria-pressed": String(i === chosen), onclick: () => this.act.choose(i) }, `${i + 1}: ${valueText(frame.beta, frame.unit, 4)}`)));
  }
}
