// Everything in the picture, drawn from a frame.
import { Box3, Group, Raycaster, Vector2, Vector3 } from "three";
import { Efforts } from "./efforts.js";
import { matrixAt } from "./format.js";
import { RobotModel } from "./robot.js";
import { extentOf, WrenchSets } from "./sets.js";
import { Surroundings } from "./surroundings.js";
import { Wrenches } from "./wrench.js";

const norm = (h, first) => (h?.length ? Math.hypot(...h.slice(first, first + 3)) : 0);

/** The length of 1 N so that the largest value has a length; 0 values give 1. */
const scaleFor = (length, most) => (most > 0 ? length / most : 1);

export class World extends Group {
  constructor(scene, frames) {
    super();
    this.scene = scene;
    this.model = new RobotModel(scene.robot);
    this.add(this.model);
    const box = new Box3();
    for (const frame of frames) {
      this.model.set(frame);
      box.union(this.model.box()).expandByPoint(new Vector3().setFromMatrixPosition(matrixAt(frame.end_effector)));
      if (frame.contact) box.expandByPoint(new Vector3().setFromMatrixPosition(matrixAt(frame.contact)));
    }
    this.model.set(frames[0]);
    this.bounds = box;
    const floor = box.min.z;
    this.size = 0.8 * this.model.box().getSize(new Vector3()).length();
    this.model.addJoints(this.size);
    const most = (value) => Math.max(0, ...frames.map(value));
    this.sets = new WrenchSets(this.size);
    this.setMetres = scaleFor(0.62 * this.size, most((f) => extentOf(f.sets)));
    this.forceMetres = frames.some((f) => f.sets?.of === "force") ? this.setMetres
      : scaleFor(0.5 * this.size, most((f) => Math.max(norm(f.h, 0), norm(f.h_2, 0))));
    this.wrenches = new Wrenches(this.size, most((f) => Math.max(norm(f.h, 3), norm(f.h_2, 3))));
    this.efforts = new Efforts(scene.robot, this.size);
    for (const frame of frames) box.expandByPoint(this.tipOf(frame));
    this.surroundings = new Surroundings(scene, this.size, box, floor);
    this.add(this.sets, this.wrenches, this.efforts, this.surroundings);
    this.caster = new Raycaster();
  }

  /** Where the arrow of the wrench ends, or the point of the set. */
  tipOf(frame) {
    const at = new Vector3().setFromMatrixPosition(matrixAt(frame.end_effector));
    if (!frame.h.length) return at.addScaledVector(new Vector3(...frame.c.slice(0, 3)), 0.3 * this.size);
    if (frame.sets?.of === "torque") return at.addScaledVector(new Vector3(...frame.h.slice(3, 6)), this.setMetres);
    return at.addScaledVector(new Vector3(...frame.h.slice(0, 3)), this.forceMetres);
  }

  /** Draws a frame; returns the labels. `show` has what is visible, `scale` enlarges wrenches. */
  set(frame, show, scale) {
    this.model.set(frame);
    this.model.showAxes(show.axes);
    this.efforts.visible = show.efforts;
    this.efforts.set(frame);
    this.surroundings.visible = show.surroundings;
    const labels = this.sets.set(frame, this.setMetres * scale, show);
    this.wrenches.visible = show.wrench;
    const marks = this.wrenches.set(frame, this.forceMetres * scale);
    if (show.axes) labels.push(...this.jointLabels(frame));
    return show.wrench ? [...marks, ...labels] : labels;
  }

  jointLabels(frame) {
    return this.scene.robot.joints.map((joint, i) => ({ text: joint.name.replaceAll("_", " "), at: new Vector3().setFromMatrixPosition(matrixAt(frame.links, i + 1)), kind: "soft" }));
  }

  /** From where the whole is seen best: flat robots rather from above. */
  from() {
    const size = this.bounds.getSize(new Vector3());
    const flat = size.z < 0.2 * Math.max(size.x, size.y);
    return new Vector3(0.75, -1, flat ? 1.9 : 0.62);
  }

  /** The actuator at a place of the view that was drawn last, in -1 .. 1; -1 if there is none. */
  actuatorAt(x, y, camera) {
    if (!this.efforts.visible) return -1;
    this.caster.setFromCamera(new Vector2(x, y), camera);
    for (const hit of this.caster.intersectObjects([...this.efforts.children, ...this.model.links], true)) {
      for (let at = hit.object; at; at = at.parent) {
        if (at.userData.actuator !== undefined && at.visible) return at.userData.actuator;
      }
      if (hit.object.castShadow) return -1; // a link is in front
    }
    return -1;
  }
}
