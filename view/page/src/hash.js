// The view in the address of the page, so that a link shows the same.

/** Writes a view as the text behind '#'. */
export function written(view) {
  const part = new URLSearchParams();
  for (const [key, value] of Object.entries(view)) {
    if (value === null || value === undefined) continue;
    part.set(key, Array.isArray(value) ? value.map((x) => (Number.isFinite(x) ? Number(x.toPrecision(7)) : x)).join(",") : value);
  }
  return part.toString().replaceAll("%2C", ",");
}

/** Finite numbers separated by commas, `count` of them if it is given; null if they are not. */
function numbers(text, count) {
  const list = (text ?? "").split(",").map(Number);
  return text && list.every(Number.isFinite) && (count === undefined || list.length === count) ? list : null;
}

/** Reads what `written` wrote. What is missing or damaged is null. */
export function read(hash, coordinates, knots) {
  const part = new URLSearchParams(hash.replace(/^#/, ""));
  return {
    posture: part.get("posture"),
    theta: numbers(part.get("theta"), coordinates),
    near: numbers(part.get("near")),
    knots: knots ? numbers(part.get("knots"), knots) : null,
    t: numbers(part.get("t"), 1)?.[0] ?? null,
    camera: numbers(part.get("camera"), 6),
    show: part.get("show")?.split(",") ?? null,
    scale: numbers(part.get("scale"), 1)?.[0] ?? null,
    theme: ["light", "dark"].includes(part.get("theme")) ? part.get("theme") : null,
  };
}
