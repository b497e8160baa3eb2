// The direction c and the wrenches of the contacts, as arrows (forces) and arcs (torques).
import { Group, Vector3 } from "three";
import { Arc, Arrow, paint, shineThrough } from "./arrows.js";
import { matrixAt } from "./format.js";

const kTurn = 1.6 * Math.PI; // of the largest torque

class WrenchMark extends Group {
  constructor(size, thickness, colour, options) {
    super();
    const material = paint(colour, options);
    this.force = new Arrow(thickness * size, material);
    this.torque = new Arc(0.17 * size, thickness * size, material);
    this.add(this.force, this.torque);
  }

  set(at, force, torque, metres, mostTorque) {
    this.force.set(at, force.clone().multiplyScalar(metres));
    this.torque.set(at, torque, mostTorque > 0 ? (kTurn * torque.length()) / mostTorque : 0);
  }
}

const parts = (h) => [new Vector3(h[0], h[1], h[2]), new Vector3(h[3], h[4], h[5])];

export class Wrenches extends Group {
  /** `mostTorque` [N m] is the torque of the longest arc. */
  constructor(size, mostTorque) {
    super();
    this.size = size;
    this.mostTorque = mostTorque;
    this.c = new WrenchMark(size, 0.006, 0x7b8794, { transparent: true, opacity: 0.75 });
    this.h = new WrenchMark(size, 0.013, 0xe8590c, { roughness: 0.3 });
    this.h2 = new WrenchMark(size, 0.011, 0x8f3fd1, { roughness: 0.3 });
    this.add(this.c, this.h, this.h2);
    shineThrough(this.h).color.set(0xe8590c);
    shineThrough(this.h2).color.set(0x8f3fd1);
  }

  /** `metres` is the length of 1 N. Returns the labels: text and place. */
  set(frame, metres) {
    const at = new Vector3().setFromMatrixPosition(matrixAt(frame.end_effector));
    const labels = [];
    const [force, torque] = parts(frame.c);
    // c is a direction: its arrow has one length, its arc one angle.
    this.c.force.set(at, force.clone().multiplyScalar(0.3 * this.size));
    this.c.torque.set(at, torque, torque.length() > 1e-9 ? 1.9 * Math.PI * torque.length() : 0);
    labels.push({ text: "c", at: at.clone().addScaledVector(force, 0.32 * this.size).addScaledVector(torque, 0.19 * this.size), kind: "soft" });
    const solved = frame.h.length > 0;
    this.h.visible = solved;
    if (solved) labels.push(this.setOne(this.h, "h", at, frame.h, metres));
    this.h2.visible = Boolean(frame.h_2?.length);
    if (this.h2.visible) {
      const touch = new Vector3().setFromMatrixPosition(matrixAt(frame.contact));
      labels.push(this.setOne(this.h2, "h\u2082", touch, frame.h_2, metres));
    }
    return labels;
  }

  setOne(mark, name, at, h, metres) {
    const [force, torque] = parts(h);
    mark.set(at, force, torque, metres, this.mostTorque);
    const f = force.length();
    const t = torque.length();
    const numbers = [f > 1e-6 ? `${f.toPrecision(4)} N` : "", t > 1e-6 ? `${t.toPrecision(4)} N m` : ""].filter(Boolean);
    const tip = at.clone().addScaledVector(force, metres);
    if (t > 1e-6) tip.addScaledVector(torque, (0.1 * this.size) / t);
    return { text: `${name} ${numbers.join(", ") || "0 N"}`, at: tip, kind: mark === this.h ? "wrench" : "second" };
  }
}
