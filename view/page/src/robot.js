// The robot: its links, joints, and copies of it as ghosts.
import { Box3, Color, CylinderGeometry, Group, Line, LineBasicMaterial, BufferGeometry, Mesh, MeshPhysicalMaterial, MeshStandardMaterial, Quaternion, Vector3 } from "three";
import { geometryOf } from "./geometry.js";
import { matrixAt } from "./format.js";

const kBase = 0x3f6c9c;
const kArm = [0xe9ecef, 0xcfd6dd];
const kHub = 0x4f5d69;
const kGhost = new MeshStandardMaterial({ color: 0x7b93ab, transparent: true, opacity: 0.13, depthWrite: false, roughness: 1 });

function materialOf(body, link) {
  const given = body.colour ? new Color(...body.colour).convertSRGBToLinear() : null;
  const opacity = body.opacity ?? 1;
  return new MeshPhysicalMaterial({
    color: given ?? (link === 0 ? kBase : kArm[link % 2]), roughness: 0.42, metalness: 0.05, clearcoat: 0.35, clearcoatRoughness: 0.35,
    transparent: opacity < 1, opacity,
    // Ends of neighbours may coincide; one of them is in front.
    polygonOffset: true, polygonOffsetFactor: link % 4, polygonOffsetUnits: 4 * (link % 4),
  });
}

export class RobotModel extends Group {
  constructor(robot) {
    super();
    this.robot = robot;
    this.links = robot.links.map((link, i) => {
      const group = new Group();
      group.matrixAutoUpdate = false;
      group.userData.link = link.name;
      for (const body of link.bodies) {
        const mesh = new Mesh(geometryOf(body), materialOf(body, i));
        mesh.castShadow = mesh.receiveShadow = true;
        group.add(mesh);
      }
      return group;
    });
    this.add(...this.links);
    this.ghosts = new Group();
    this.add(this.ghosts);
  }

  /** Moves the links to the poses of a frame. */
  set(frame) {
    this.links.forEach((link, i) => link.matrix.copy(matrixAt(frame.links, i)));
    this.updateMatrixWorld(true);
  }

  /** The box around the robot in its present pose. */
  box() {
    const box = new Box3();
    for (const link of this.links) box.expandByObject(link, true);
    for (const link of this.links) box.expandByPoint(new Vector3().setFromMatrixPosition(link.matrix));
    return box;
  }

  /** Discs at the joints, and their axes, of a size that suits the robot. */
  addJoints(size) {
    this.axes = new Group();
    const material = new MeshStandardMaterial({ color: kHub, roughness: 0.5, metalness: 0.3 });
    const hub = new CylinderGeometry(0.028 * size, 0.028 * size, 0.05 * size, 36);
    const line = new LineBasicMaterial({ color: 0x8a5cf6 });
    this.axisLines = [];
    this.robot.joints.forEach((joint, i) => {
      const along = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...joint.axis));
      const disc = new Mesh(hub, material);
      disc.quaternion.copy(along);
      disc.castShadow = true;
      if (joint.unit === "rad") this.links[i + 1].add(disc);
      const end = new Vector3(...joint.axis).multiplyScalar(0.2 * size);
      const axis = new Line(new BufferGeometry().setFromPoints([end.clone().negate(), end]), line);
      axis.visible = false;
      this.axisLines.push(axis);
      this.links[i + 1].add(axis);
    });
  }

  showAxes(visible) {
    for (const axis of this.axisLines) axis.visible = visible;
  }

  /** Translucent copies at other frames. */
  setGhosts(frames) {
    if (frames.length === this.ghostFrames?.length && frames.every((frame, i) => frame === this.ghostFrames[i])) return;
    this.ghostFrames = frames;
    this.ghosts.clear();
    for (const frame of frames) {
      this.links.forEach((link, i) => {
        const copy = new Group();
        copy.matrixAutoUpdate = false;
        copy.matrix.copy(matrixAt(frame.links, i));
        for (const mesh of link.children) {
          if (!mesh.isMesh) continue;
          const ghost = new Mesh(mesh.geometry, kGhost);
          ghost.quaternion.copy(mesh.quaternion);
          copy.add(ghost);
        }
        this.ghosts.add(copy);
      });
    }
    this.updateMatrixWorld(true);
  }
}
