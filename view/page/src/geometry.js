// Bodies of links as geometries.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CapsuleGeometry, CylinderGeometry, Matrix4, Quaternion, SphereGeometry, Vector3,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import { RoundedBoxGeometry } from "three/addons/geometries/RoundedBoxGeometry.js";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import { bytesOf } from "./bytes.js";
import { matrixAt } from "./format.js";

const kCrease = 0.6; // rad: sharper edges stay visible
const kUp = new Vector3(0, 1, 0);

const pointsOf = (flat) => Array.from({ length: flat.length / 3 }, (_, i) => new Vector3(...flat.slice(3 * i, 3 * i + 3)));

/** A capsule between two points. */
export function capsule(a, b, radius) {
  const along = b.clone().sub(a);
  const length = along.length();
  if (length < 1e-9) return new SphereGeometry(radius, 32, 20).translate(a.x, a.y, a.z);
  return new CapsuleGeometry(radius, length, 10, 28)
    .applyQuaternion(new Quaternion().setFromUnitVectors(kUp, along.divideScalar(length)))
    .translate((a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2);
}

/** A box with rounded edges, if the points are the corners of a box in the order of the command. */
function roundedBox(points) {
  if (points.length !== 8) return null;
  const [x, y, z] = [2, 1, 4].map((i) => points[i].clone().sub(points[0]));
  const far = points[0].clone().add(x).add(y).add(z);
  const sizes = [x.length(), y.length(), z.length()];
  const small = 1e-6 * Math.max(...sizes) ** 2;
  if (Math.abs(x.dot(y)) > small || Math.abs(y.dot(z)) > small || Math.abs(z.dot(x)) > small) return null;
  if (far.distanceToSquared(points[7]) > small) return null;
  const centre = points[0].clone().add(points[7]).multiplyScalar(0.5);
  const basis = new Matrix4().makeBasis(x.normalize(), y.normalize(), z.normalize()).setPosition(centre);
  if (basis.determinant() < 0) return null;
  return new RoundedBoxGeometry(...sizes, 4, 0.08 * Math.min(...sizes)).applyMatrix4(basis);
}

/** All points within `radius` of the points, as the hull of many. */
function grown(points, radius) {
  const around = new SphereGeometry(radius, 16, 10).getAttribute("position");
  const all = [];
  for (const point of points) {
    for (let i = 0; i < around.count; ++i) all.push(new Vector3().fromBufferAttribute(around, i).add(point));
  }
  return all;
}

function hull(body) {
  const points = pointsOf(body.points);
  if (points.length <= 2) return capsule(points[0], points[points.length - 1], body.radius || 0.005);
  const box = body.radius > 0 ? null : roundedBox(points);
  if (box) return box;
  return toCreasedNormals(new ConvexGeometry(body.radius > 0 ? grown(points, body.radius) : points), kCrease);
}

/** A mesh: vertices as 16-bit numbers between two corners, and triangles. */
function mesh(body) { // its size is in its points
  const steps = new Uint16Array(bytesOf(body.vertices).buffer);
  const positions = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; ++i) positions[i] = body.low[i % 3] + (steps[i] / 65535) * body.extent[i % 3];
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(bytesOf(body.triangles).buffer), 1));
  return toCreasedNormals(geometry, kCrease);
}

const unit = {
  box: () => new BoxGeometry(1, 1, 1),
  cylinder: () => toCreasedNormals(new CylinderGeometry(0.5, 0.5, 1, 40).rotateX(Math.PI / 2), kCrease),
  sphere: () => new SphereGeometry(0.5, 36, 24),
};

/** The geometry of a body in axes of its link; null if it cannot be drawn. */
export function geometryOf(body) {
  if (body.kind === "hull") return hull(body);
  if (body.kind === "mesh") return mesh(body).applyMatrix4(matrixAt(body.pose));
  return unit[body.kind]().scale(...body.size).applyMatrix4(matrixAt(body.pose));
}
