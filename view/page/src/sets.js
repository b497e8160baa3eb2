// The sets of forces or torques at the tool, as translucent bodies to scale.
import {
  BufferAttribute, BufferGeometry, DoubleSide, Group, Line, LineBasicMaterial, LineDashedMaterial, LineSegments, Matrix4, Mesh,
  MeshStandardMaterial, SphereGeometry, Vector3,
} from "three";
import { matrixAt } from "./format.js";
import { paint } from "./arrows.js";

const translucent = (colour, opacity) =>
  new MeshStandardMaterial({ color: colour, transparent: true, opacity, side: DoubleSide, depthWrite: false, roughness: 0.6, flatShading: true });

const kKept = 64; // bodies of polytopes

export class WrenchSets extends Group {
  constructor(size) {
    super();
    this.size = size;
    this.polytope = new Group();
    this.ellipsoid = new Mesh(new SphereGeometry(1, 48, 32), translucent(0x12b886, 0.22));
    this.ellipsoid.material.flatShading = false;
    this.ellipsoid.matrixAutoUpdate = false;
    this.face = translucent(0x2f7fd6, 0.16);
    this.edge = new LineBasicMaterial({ color: 0x3d8fe8, transparent: true, opacity: 0.75 });
    this.point = new Mesh(new SphereGeometry(0.017 * size, 24, 16), paint(0xe8590c, { emissive: 0xe8590c, emissiveIntensity: 0.25 }));
    this.ray = new Line(new BufferGeometry(), new LineDashedMaterial({ color: 0xe8590c, dashSize: 0.02 * size, gapSize: 0.012 * size }));
    this.body = new Group(); // at the tool, in newtons or newton metres
    this.body.add(this.polytope, this.ellipsoid);
    this.add(this.body, this.point, this.ray);
    this.bodies = new Map(); // of polytopes
  }

  /** `metres` is the length of 1 N or 1 N m of the set. Returns the label of the point. */
  set(frame, metres, visible) {
    const sets = frame.sets;
    this.visible = Boolean(sets);
    if (!sets) return [];
    const at = new Vector3().setFromMatrixPosition(matrixAt(frame.end_effector));
    this.body.position.copy(at);
    this.body.scale.setScalar(metres);
    this.setPolytope(visible.polytope ? sets.polytope : null);
    this.setEllipsoid(visible.ellipsoid ? sets.ellipsoid : null);
    const shown = visible.polytope || visible.ellipsoid;
    this.point.visible = this.ray.visible = shown && frame.h.length > 0;
    if (!this.point.visible) return [];
    const reached = new Vector3(...frame.h.slice(...(sets.of === "force" ? [0, 3] : [3, 6])));
    this.point.position.copy(at).addScaledVector(reached, metres);
    this.ray.geometry.dispose();
    this.ray.geometry = new BufferGeometry().setFromPoints([at, this.point.position]);
    this.ray.computeLineDistances();
    // The tip of the arrow h is the point of a force.
    return sets.of === "torque" ? [{ text: "\u03b2", at: this.point.position.clone(), kind: "wrench" }] : [];
  }

  setPolytope(polytope) {
    if (polytope === this.drawn) return;
    this.drawn = polytope;
    this.polytope.clear();
    if (!polytope) return;
    if (!this.bodies.has(polytope)) this.bodies.set(polytope, this.bodyOf(polytope));
    // Those that were not drawn for long are made again.
    for (const [old, parts] of this.bodies) {
      if (this.bodies.size <= kKept) break;
      for (const part of parts) part.geometry.dispose();
      this.bodies.delete(old);
    }
    this.polytope.add(...this.bodies.get(polytope));
  }

  bodyOf(polytope) {
    const positions = new BufferAttribute(new Float32Array(polytope.vertices), 3);
    const surface = new BufferGeometry().setAttribute("position", positions);
    surface.setIndex(polytope.triangles);
    surface.computeVertexNormals();
    const edges = new BufferGeometry().setAttribute("position", positions);
    edges.setIndex(polytope.edges);
    const lines = new LineSegments(edges, this.edge);
    return polytope.triangles.length ? [new Mesh(surface, this.face), lines] : [lines];
  }

  setEllipsoid(ellipsoid) {
    this.ellipsoid.visible = Boolean(ellipsoid);
    if (!ellipsoid) return;
    const axes = ellipsoid.radii.map((radius, i) => new Vector3(...ellipsoid.axes.slice(3 * i, 3 * i + 3)).multiplyScalar(Math.max(radius, 1e-9)));
    while (axes.length < 3) axes.push(thinAcross(axes));
    const [x, y, z] = axes;
    this.ellipsoid.matrix.copy(new Matrix4().makeBasis(x, y, z).setPosition(...ellipsoid.centre));
  }
}

/** A short axis across one or two others, of a set that is flat. */
function thinAcross([x, y]) {
  const other = y ?? (Math.abs(x.z) < 0.9 * x.length() ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0));
  return new Vector3().crossVectors(x, other).setLength(1e-3 * x.length());
}

/** The largest distance of a point of the polytope from its origin. */
export function extentOf(sets) {
  const vertices = sets?.polytope?.vertices ?? [];
  let most = 0;
  for (let i = 0; i < vertices.length; i += 3) most = Math.max(most, Math.hypot(vertices[i], vertices[i + 1], vertices[i + 2]));
  const { centre, radii } = sets?.ellipsoid ?? { centre: [0, 0, 0], radii: [0] };
  return most > 0 ? most : Math.hypot(...centre) + Math.max(...radii);
}
