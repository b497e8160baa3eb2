// Renderer, camera and light. A picture is drawn when something has changed.
import {
  CanvasTexture, DirectionalLight, HemisphereLight, NeutralToneMapping, PCFShadowMap, PerspectiveCamera, PMREMGenerator, Scene,
  SRGBColorSpace, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";

const kSky = {
  light: { air: ["#f7f9fb", "#dde4ea"], water: ["#eaf6fb", "#b9d7e6"] },
  dark: { air: ["#232a31", "#0f1317"], water: ["#17384a", "#07141d"] },
};

const kFill = 0.9; // of the picture that the subject fills
const kButtons = 44; // px at the top of the canvas that buttons cover

function gradient([top, bottom]) {
  const canvas = document.createElement("canvas");
  canvas.width = 2;
  canvas.height = 256;
  const pen = canvas.getContext("2d");
  const fill = pen.createLinearGradient(0, 0, 0, 256);
  fill.addColorStop(0, top);
  fill.addColorStop(1, bottom);
  pen.fillStyle = fill;
  pen.fillRect(0, 0, 2, 256);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

export class Stage {
  constructor(canvas, water) {
    this.canvas = canvas;
    this.water = water;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene = new Scene();
    const generator = new PMREMGenerator(this.renderer);
    this.scene.environment = generator.fromScene(new RoomEnvironment(), 0.04).texture;
    this.scene.environmentRotation.set(Math.PI / 2, 0, 0); // the room's up is y
    this.scene.environmentIntensity = 0.55;
    this.camera = new PerspectiveCamera(32, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.sun = new DirectionalLight(0xffffff, 2.1);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 4;
    this.sun.shadow.bias = -0.0004;
    this.scene.add(this.sun, this.sun.target, new HemisphereLight(0xffffff, 0x8899aa, 0.35));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.invalidate());
    this.drawn = () => {};
    this.views = [() => {}];
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  /** Asks for one picture. */
  invalidate() {
    this.pending ??= requestAnimationFrame(() => this.render());
  }

  render() {
    if (this.pending) cancelAnimationFrame(this.pending);
    this.pending = undefined;
    this.renderer.setScissorTest(this.views.length > 1);
    this.views.forEach((arrange, i) => {
      const { x, y, width, height } = this.boxOf(i);
      const bottom = this.canvas.clientHeight - y - height;
      this.renderer.setViewport(x, bottom, width, height);
      this.renderer.setScissor(x, bottom, width, height);
      arrange();
      this.renderer.render(this.scene, this.camera);
    });
    this.drawn();
  }

  /** What is drawn: a function for each view puts the scene in order for it. */
  setViews(views) {
    const other = views.length !== this.views.length;
    this.views = views;
    if (other) this.resize();
    this.invalidate();
  }

  get stacked() {
    return this.views.length > 1 && this.canvas.clientWidth <= this.canvas.clientHeight;
  }

  /** Where a view is on the canvas [px]: beside each other on a wide one, else one above the other. */
  boxOf(i) {
    const { clientWidth, clientHeight } = this.canvas;
    const count = this.views.length;
    if (!this.stacked) return { x: (i * clientWidth) / count, y: 0, width: clientWidth / count, height: clientHeight };
    return { x: 0, y: (i * clientHeight) / count, width: clientWidth, height: clientHeight / count };
  }

  /** The view at a place of the canvas [px], and the place in it, in -1 .. 1. */
  viewAt(x, y) {
    const within = (box) => x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;
    const view = Math.max(this.views.findIndex((_, i) => within(this.boxOf(i))), 0);
    const box = this.boxOf(view);
    return { view, x: (2 * (x - box.x)) / box.width - 1, y: 1 - (2 * (y - box.y)) / box.height };
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    const box = this.boxOf(0);
    this.camera.aspect = box.width / box.height;
    this.camera.updateProjectionMatrix();
    if (this.framed) this.frame();
    this.render();
  }

  setTheme(theme) {
    this.scene.background?.dispose();
    this.scene.background = gradient(kSky[theme][this.water ? "water" : "air"]);
    this.scene.environmentIntensity = theme === "dark" ? 0.4 : 0.55;
    this.invalidate();
  }

  /** What `frame` shows: a box, seen from a direction. */
  setSubject(box, from) {
    const centre = box.getCenter(new Vector3());
    const radius = box.getSize(new Vector3()).length() / 2;
    this.subject = { box, centre, from: from.clone().normalize() };
    const { sun, camera, controls } = this;
    sun.position.copy(centre).add(new Vector3(1.2, -0.9, 2.6).multiplyScalar(radius * 2));
    sun.target.position.copy(centre);
    const side = 2 * radius;
    Object.assign(sun.shadow.camera, { left: -side, right: side, top: side, bottom: -side, near: 0.1 * radius, far: 12 * radius });
    sun.shadow.normalBias = 0.004 * radius;
    sun.shadow.camera.updateProjectionMatrix();
    Object.assign(camera, { near: radius / 100, far: radius * 60 });
    Object.assign(controls, { minDistance: radius / 10, maxDistance: radius * 20 });
  }

  /** Puts the camera as near as the whole subject is seen. */
  frame() {
    const { box, centre, from } = this.subject;
    const slope = kFill * Math.tan((this.camera.fov * Math.PI) / 360);
    const wide = slope * this.camera.aspect;
    const high = this.stacked ? slope * Math.max(0.4, 1 - (2 * kButtons) / this.boxOf(0).height) : slope; // a wide picture has room beside the buttons
    const right = new Vector3().crossVectors(this.camera.up, from).normalize();
    const up = new Vector3().crossVectors(from, right);
    let distance = 0;
    for (let i = 0; i < 8; ++i) {
      const corner = new Vector3(...["x", "y", "z"].map((axis, k) => ((i >> k) & 1 ? box.max : box.min)[axis])).sub(centre);
      const across = Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / high);
      distance = Math.max(distance, across + corner.dot(from));
    }
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(from, distance);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.framed = true;
    this.invalidate();
  }

  /** Turns the camera about the target [rad], or moves it nearer by a factor. */
  orbit(turn, lift, factor = 1) {
    const away = this.camera.position.clone().sub(this.controls.target);
    const radius = away.length() * factor;
    const polar = Math.min(Math.PI - 0.01, Math.max(0.01, Math.acos(away.z / away.length()) - lift));
    const azimuth = Math.atan2(away.y, away.x) + turn;
    away.set(Math.sin(polar) * Math.cos(azimuth), Math.sin(polar) * Math.sin(azimuth), Math.cos(polar)).multiplyScalar(radius);
    this.camera.position.copy(this.controls.target).add(away);
    this.framed = false;
    this.controls.update();
    this.invalidate();
  }

  /** Camera and target as six numbers, and back. */
  get view() {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }

  set view(numbers) {
    this.camera.position.fromArray(numbers);
    this.controls.target.fromArray(numbers, 3);
    this.framed = false;
    this.controls.update();
    this.invalidate();
  }
}
