// What each actuator does: an arrow at a thruster or a sliding joint, a ring about a turning joint.
import { Color, CylinderGeometry, DoubleSide, Group, Mesh, MeshStandardMaterial, Quaternion, SphereGeometry, Vector3 } from "three";
import { Arc, Arrow, paint, shineThrough } from "./arrows.js";
import { matrixAt } from "./format.js";

const kIdle = new Color(0x16a394);
const kBusy = new Color(0xf2a93b);
const kLimit = new Color(0xe11d30);
export const kAtLimit = 1 - 1e-6; // of a share

/** The share of its limit in this direction that an effort takes; 0 without a limit. */
export function shareOf(actuator, u) {
  const limit = u < 0 ? actuator.min : actuator.max;
  return limit ? Math.min(Math.abs(u / limit), 1) : 0;
}

/** The colour of a share: red at the limit alone. */
export function colourOf(share) {
  return share >= kAtLimit ? kLimit : kIdle.clone().lerp(kBusy, share);
}

export class Efforts extends Group {
  constructor(robot, size) {
    super();
    this.robot = robot;
    this.size = size;
    const largest = (t) => Math.max(Math.abs(t.min ?? 0), Math.abs(t.max ?? 0));
    this.most = Math.max(1e-9, ...robot.actuators.slice(0, robot.thrusters.length).map(largest));
    this.marks = robot.actuators.map((actuator, i) => this.mark(actuator, i));
    this.add(...this.marks.map((mark) => mark.group));
  }

  mark(actuator, i) {
    const group = new Group();
    group.userData.actuator = i;
    const material = paint(kIdle, { roughness: 0.35 });
    const turns = actuator.unit === "N m";
    const j = i - this.robot.thrusters.length;
    const sign = turns ? new Arc(this.radiusOf(j), 0.0085 * this.size, material) : new Arrow(0.011 * this.size, material);
    const hidden = shineThrough(sign);
    group.add(sign);
    const duct = i < this.robot.thrusters.length ? this.duct() : null;
    if (duct) group.add(duct);
    return { group, sign, material, hidden, duct };
  }

  /** Of a ring around the links of a joint. */
  radiusOf(j) {
    const bodies = [this.robot.joints[j].parent, j + 1].filter((link) => link > 0).flatMap((link) => this.robot.links[link].bodies);
    const thickest = Math.max(0, ...bodies.map((body) => body.radius ?? 0));
    return Math.min(Math.max(1.5 * thickest, 0.06 * this.size), 0.14 * this.size);
  }

  /** A thruster's, or a hub where a wheel acts. */
  duct() {
    if (!this.robot.water) return new Mesh(new SphereGeometry(0.022 * this.size, 24, 16), new MeshStandardMaterial({ color: 0x46525d, roughness: 0.5 }));
    const material = new MeshStandardMaterial({ color: 0x46525d, roughness: 0.6, side: DoubleSide });
    const ring = new Mesh(new CylinderGeometry(0.045 * this.size, 0.045 * this.size, 0.045 * this.size, 36, 1, true), material);
    ring.castShadow = true;
    return ring;
  }

  /** Draws the efforts of a frame; without efforts only the thrusters. */
  set(frame) {
    const base = matrixAt(frame.links);
    this.marks.forEach((mark, i) => {
      const u = frame.u.length ? frame.u[i] : 0;
      const share = shareOf(frame.limits[i], u);
      for (const material of [mark.material, mark.hidden]) material.color.copy(colourOf(share));
      if (i < this.robot.thrusters.length) this.setThruster(mark, this.robot.thrusters[i], base, u);
      else this.setJoint(mark, i - this.robot.thrusters.length, frame, u, share);
    });
  }

  setThruster(mark, thruster, base, u) {
    const at = new Vector3(...thruster.position).applyMatrix4(base);
    const along = new Vector3(...thruster.direction).transformDirection(base);
    mark.duct.position.copy(at);
    mark.duct.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), along));
    mark.sign.set(at, along.multiplyScalar((0.32 * this.size * u) / this.most));
  }

  setJoint(mark, j, frame, u, share) {
    const link = matrixAt(frame.links, j + 1);
    const at = new Vector3().setFromMatrixPosition(link);
    const axis = new Vector3(...this.robot.joints[j].axis).transformDirection(link);
    if (mark.sign instanceof Arc) mark.sign.set(at, axis, Math.sign(u) * share * 1.7 * Math.PI);
    else mark.sign.set(at, axis.multiplyScalar(Math.sign(u) * share * 0.25 * this.size));
  }

  /** Lights up one actuator, or none. */
  highlight(i) {
    this.marks.forEach((mark, k) => {
      mark.material.emissive.set(k === i ? 0xffffff : 0x000000);
      mark.material.emissiveIntensity = 0.35;
      if (mark.duct) mark.duct.material.emissive.set(k === i ? 0x4488ff : 0x000000);
    });
  }
}
