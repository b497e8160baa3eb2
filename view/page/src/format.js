// Numbers and poses as text and matrices.
import { Matrix4 } from "three";

/** The number with up to four significant digits and a true minus sign; a dash for none. */
export function shown(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const rounded = Number(value.toPrecision(digits));
  const text = Math.abs(rounded) < 1e-9 ? "0" : String(Math.abs(rounded) < 1e-4 ? rounded.toExponential(2) : rounded);
  return text.replace(/-/g, "\u2212");
}

/** The text with units that do not break at the end of a line. */
export const unbroken = (text) => text.replaceAll("N m", "N\u00a0m").replace(/(\d) (N|kg|rad|m|s|%)(?![a-z])/g, "$1\u00a0$2");

/** A value with its unit, on one line. */
export const withUnit = (value, unit, digits) => unbroken(`${shown(value, digits)} ${unit}`);

/** The value of an answer, which may have none. */
export const valueText = (value, unit, digits) => (Number.isFinite(value ?? NaN) ? withUnit(value, unit, digits) : "no value");

/** The matrix of the i-th pose in a list of poses, 12 numbers each, by rows. */
export function matrixAt(numbers, i = 0) {
  const m = numbers.slice(12 * i, 12 * i + 12);
  return new Matrix4().set(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 0, 0, 0, 1);
}

/** A name of a file as words: q1_shoulder_yaw -> q1 shoulder yaw. */
export const words = (name) => name.replaceAll("_", " ");
