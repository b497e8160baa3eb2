// Frames between the instants of a trajectory.
import { Quaternion, Vector3 } from "three";
import { matrixAt } from "./format.js";

const mix = (a, b, s) => a.map((value, i) => value + s * (b[i] - value));

function mixPose(a, b, i, s) {
  const p = [new Vector3(), new Vector3()];
  const q = [new Quaternion(), new Quaternion()];
  [a, b].forEach((numbers, k) => matrixAt(numbers, i).decompose(p[k], q[k], new Vector3()));
  p[0].lerp(p[1], s);
  const { x, y, z, w } = q[0].slerp(q[1], s);
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), p[0].x,
    2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), p[0].y,
    2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), p[0].z,
  ];
}

const mixPoses = (a, b, s) => Array.from({ length: a.length / 12 }, (_, i) => mixPose(a, b, i, s)).flat();

/** The frame at a time [s]: an instant, or numbers and poses between two instants. */
export function frameAt(frames, t) {
  let k = frames.findIndex((frame) => frame.t > t) - 1;
  if (k < -1) k = frames.length - 1;
  const a = frames[Math.max(k, 0)];
  const b = frames[Math.min(Math.max(k, 0) + 1, frames.length - 1)];
  const s = b.t > a.t ? Math.min(Math.max((t - a.t) / (b.t - a.t), 0), 1) : 0;
  if (s < 1e-9) return a;
  const near = s < 0.5 ? a : b;
  const between = { ...near, near, t, beta: a.beta === null ? null : a.beta + s * (b.beta - a.beta) };
  for (const key of ["theta_r", "theta", "c", "h", "u", "v"]) between[key] = mix(a[key], b[key], s);
  for (const key of ["links", "end_effector"]) between[key] = mixPoses(a[key], b[key], s);
  return between;
}

/** About `count` frames, evenly over time, the first and the last among them. */
export function someOf(frames, count) {
  const n = Math.min(count, frames.length);
  return Array.from({ length: n }, (_, i) => frames[Math.round((i * (frames.length - 1)) / Math.max(n - 1, 1))]);
}
