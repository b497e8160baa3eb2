// Buttons, switches, keys and the pointer.
import { byId } from "./dom.js";

const kTurn = 0.09; // rad for a key

function addKeys(app) {
  const stage = app.stage;
  const keys = {
    ArrowLeft: () => stage.orbit(-kTurn, 0), ArrowRight: () => stage.orbit(kTurn, 0), ArrowUp: () => stage.orbit(0, kTurn), ArrowDown: () => stage.orbit(0, -kTurn),
    "+": () => stage.orbit(0, 0, 0.9), "=": () => stage.orbit(0, 0, 0.9), "-": () => stage.orbit(0, 0, 1.1), Home: () => stage.frame(),
    " ": () => app.timeline?.toggle(),
  };
  [...app.scene.shown.map((each) => each.name), "own"].forEach((name, i) => (keys[String(i + 1)] = () => app.showPosture(name)));
  byId("canvas").addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });
}

function addPointer(app) {
  const canvas = byId("canvas");
  let lit = -1;
  const light = (i) => {
    if (i === lit) return;
    app.highlight((lit = i));
    canvas.title = i >= 0 ? app.scene.robot.actuators[i].name : "";
  };
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons) return;
    const box = canvas.getBoundingClientRect();
    const { view, x, y } = app.stage.viewAt(event.clientX - box.left, event.clientY - box.top);
    app.stage.views[view]();
    light(app.world.actuatorAt(x, y, app.stage.camera));
  });
  canvas.addEventListener("pointerleave", () => light(-1));
  app.stage.controls.addEventListener("start", () => (app.stage.framed = false));
}

export function addControls(app) {
  for (const input of document.querySelectorAll("input[type=checkbox]")) {
    input.addEventListener("change", () => app.setShown(input.id.replace("show-", ""), input.checked));
  }
  byId("scale").addEventListener("input", () => {
    app.scale = 2 ** Number(byId("scale").value);
    app.draw();
  });
  byId("theme").addEventListener("click", () => app.setTheme(app.dark ? "light" : "dark"));
  byId("reset").addEventListener("click", () => app.stage.frame());
  byId("png").addEventListener("click", () => app.save());
  byId("link").addEventListener("click", () => app.copyLink());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => app.theme || app.setTheme(null));
  addEventListener("hashchange", () => app.restore(location.hash));
  addKeys(app);
  addPointer(app);
}
