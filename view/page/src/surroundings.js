// What is around the robot: floor with a grid, water surface, and what the second contact touches.
import {
  BoxGeometry, CanvasTexture, CircleGeometry, CylinderGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial,
  PlaneGeometry, RepeatWrapping, ShadowMaterial, SphereGeometry, SRGBColorSpace,
} from "three";
import { matrixAt } from "./format.js";

/** The largest of 1, 2, 5 times a power of ten that does not exceed the value. */
export function roundStep(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((k) => k * power <= value * (1 + 1e-9)) * power;
}

/** A square picture that fades out towards its edge. */
function faded(draw) {
  const side = 2048;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = side;
  const pen = canvas.getContext("2d");
  draw(pen, side);
  const fade = pen.createRadialGradient(side / 2, side / 2, 0.12 * side, side / 2, side / 2, 0.5 * side);
  fade.addColorStop(0, "#000f");
  fade.addColorStop(1, "#0000");
  pen.globalCompositeOperation = "destination-in";
  pen.fillStyle = fade;
  pen.fillRect(0, 0, side, side);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 16;
  return texture;
}

function drawGrid(lines, colour) {
  return (pen, side) => {
    pen.strokeStyle = colour;
    for (let i = 0; i <= lines; ++i) {
      pen.lineWidth = 1.6;
      const x = (i * side) / lines;
      pen.beginPath();
      pen.moveTo(x, 0);
      pen.lineTo(x, side);
      pen.moveTo(0, x);
      pen.lineTo(side, x);
      pen.stroke();
    }
  };
}

function drawRipples(pen, side) {
  pen.fillStyle = "#3aa6dd55";
  pen.fillRect(0, 0, side, side);
  pen.strokeStyle = "#d8f3ff66";
  for (let k = 0; k < 420; ++k) {
    // A fixed sequence that looks random.
    const x = ((k * 0.754877666) % 1) * side;
    const y = ((k * 0.569840296) % 1) * side;
    pen.lineWidth = 1 + (k % 3);
    pen.beginPath();
    pen.ellipse(x, y, 18 + (k % 7) * 6, 5 + (k % 5) * 2, (k % 11) * 0.12, 0.2, 2.4);
    pen.stroke();
  }
}

export class Surroundings extends Group {
  constructor(scene, size, box, lowest) {
    super();
    const centre = box.getCenter(box.min.clone());
    this.step = roundStep(size / 4);
    const lines = 2 * Math.ceil((3.2 * size) / this.step);
    const width = lines * this.step;
    const shade = new Mesh(new CircleGeometry(width / 2, 64), new ShadowMaterial({ opacity: 0.22 }));
    shade.receiveShadow = true;
    this.grid = new Mesh(new PlaneGeometry(width, width), new MeshBasicMaterial({ map: faded(drawGrid(lines, "#8a98a8")), transparent: true, opacity: 0.45, depthWrite: false }));
    const drop = scene.robot.water ? 0.35 * size : 0.004 * size;
    for (const sheet of [shade, this.grid]) {
      // Lines of the grid are at multiples of its step.
      sheet.position.set(Math.round(centre.x / this.step) * this.step, Math.round(centre.y / this.step) * this.step, lowest - drop);
      this.add(sheet);
    }
    this.grid.position.z += 0.001 * size;
    if (scene.robot.water) this.add(this.surface(width, centre, box.max.z + 0.55 * size));
    if (scene.task.contact) this.add(this.touched(scene.task.contact, size));
  }

  surface(width, centre, height) {
    const map = faded(drawRipples);
    map.wrapS = map.wrapT = RepeatWrapping;
    const water = new Mesh(new PlaneGeometry(width, width), new MeshBasicMaterial({ map, transparent: true, opacity: 0.5, side: DoubleSide, depthWrite: false }));
    water.position.set(centre.x, centre.y, height);
    return water;
  }

  /** The surface of the second contact; the z axis of its frame points into it. */
  touched(contact, size) {
    const group = new Group();
    group.matrixAutoUpdate = false;
    group.matrix.copy(matrixAt(contact.frame));
    const material = new MeshStandardMaterial({ color: 0xb08968, roughness: 0.7, transparent: true, opacity: 0.85 });
    const body = this.solid(contact, size, material);
    body.castShadow = body.receiveShadow = true;
    group.add(body);
    return group;
  }

  solid(contact, size, material) {
    const thick = 0.03 * size;
    const middle = contact.min.map((low, i) => (low + contact.max[i]) / 2);
    const length = contact.min.map((low, i) => contact.max[i] - low);
    if (contact.surface === "plane") {
      material.opacity = 0.5;
      return new Mesh(new BoxGeometry(length[0] + 4 * thick, length[1] + 4 * thick, thick).translate(...middle, thick / 2), material);
    }
    if (contact.surface === "line") {
      return new Mesh(new CylinderGeometry(thick, thick, length[0] + 4 * thick, 32).rotateZ(Math.PI / 2).translate(middle[0], 0, thick), material);
    }
    if (contact.surface === "circle") return new Mesh(new CylinderGeometry(contact.radius, contact.radius, size, 48), material);
    return new Mesh(new SphereGeometry(thick, 32, 20).translate(0, 0, thick), material);
  }
}
