// Arrows and arcs whose length or angle changes without new geometries.
import {
  BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, Quaternion, Vector3,
} from "three";

const kZ = new Vector3(0, 0, 1);
const shaft = new CylinderGeometry(1, 1, 1, 20).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const cone = new ConeGeometry(1, 1, 28).rotateX(Math.PI / 2).translate(0, 0, 0.5);

export const paint = (colour, options = {}) => new MeshStandardMaterial({ color: colour, roughness: 0.45, metalness: 0, ...options });

/** Shows the parts of a mark faintly where a link is in front of them. */
export function shineThrough(mark) {
  const faint = new MeshBasicMaterial({ transparent: true, opacity: 0.3, depthTest: false, depthWrite: false });
  const parts = [];
  mark.traverse((part) => part.isMesh && parts.push(part));
  for (const part of parts) {
    part.castShadow = true;
    part.add(new Mesh(part.geometry, faint));
  }
  return faint;
}

/** A straight arrow along z of its group. */
export class Arrow extends Group {
  constructor(radius, material) {
    super();
    this.radius = radius;
    this.shaft = new Mesh(shaft, material);
    this.head = new Mesh(cone, material);
    this.add(this.shaft, this.head);
  }

  /** From `at` along `vector`, with its length. */
  set(at, vector) {
    const length = vector.length();
    this.visible = length > 1e-6;
    if (!this.visible) return;
    const head = Math.min(5 * this.radius, 0.6 * length);
    const thin = Math.min(this.radius, 0.25 * length);
    this.position.copy(at);
    this.quaternion.setFromUnitVectors(kZ, vector.clone().divideScalar(length));
    this.shaft.scale.set(thin, thin, Math.max(length - 0.9 * head, 1e-6));
    this.head.scale.set(head * 0.44, head * 0.44, head);
    this.head.position.z = length - head;
  }
}

const kSteps = 96;
const kSides = 10;

/** A tube around a circle about z, whose triangles are in the order of the angle. */
function ring(radius, tube) {
  const positions = [];
  const normals = [];
  const triangles = [];
  for (let i = 0; i <= kSteps; ++i) {
    const a = (2 * Math.PI * i) / kSteps;
    for (let j = 0; j <= kSides; ++j) {
      const b = (2 * Math.PI * j) / kSides;
      const normal = [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)];
      positions.push(radius * Math.cos(a) + tube * normal[0], radius * Math.sin(a) + tube * normal[1], tube * normal[2]);
      normals.push(...normal);
    }
  }
  for (let i = 0; i < kSteps; ++i) {
    for (let j = 0; j < kSides; ++j) {
      const a = i * (kSides + 1) + j;
      const b = a + kSides + 1;
      triangles.push(a, b, a + 1, b, b + 1, a + 1);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(triangles);
  return geometry;
}

/** Part of a circle with a head, about z of its group. */
export class Arc extends Group {
  constructor(radius, tube, material) {
    super();
    this.radius = radius;
    this.tube = tube;
    this.ring = new Mesh(ring(radius, tube), material);
    this.head = new Mesh(cone, material);
    this.head.scale.set(2.3 * tube, 2.3 * tube, 5 * tube);
    this.add(this.ring, this.head);
  }

  /** About `axis` at `at` by `angle` [rad], in either direction. */
  set(at, axis, angle) {
    this.visible = Math.abs(angle) > 1e-3;
    if (!this.visible) return;
    const steps = Math.max(1, Math.min(kSteps, Math.round((Math.abs(angle) / (2 * Math.PI)) * kSteps)));
    this.ring.geometry.setDrawRange(0, steps * kSides * 6);
    this.position.copy(at);
    const about = axis.clone().normalize().multiplyScalar(Math.sign(angle));
    this.quaternion.copy(new Quaternion().setFromUnitVectors(kZ, about));
    const end = (2 * Math.PI * steps) / kSteps;
    this.head.position.set(this.radius * Math.cos(end), this.radius * Math.sin(end), 0);
    this.head.quaternion.setFromUnitVectors(kZ, new Vector3(-Math.sin(end), Math.cos(end), 0));
  }
}
