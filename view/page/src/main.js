import { App } from "./app.js";
import { addControls } from "./controls.js";
import { byId } from "./dom.js";
import { engineOf } from "./engine.js";

async function start() {
  const scene = JSON.parse(byId("scene").textContent);
  const app = new App(scene, await engineOf(scene));
  globalThis.app = app; // for tests and the console
  addControls(app);
  app.restore(location.hash);
  document.documentElement.dataset.ready = "yes";
}

start().catch((error) => {
  byId("failed").hidden = false;
  const needed = error.message.includes("WebGL") ? ". It needs a browser with WebGL 2." : "";
  byId("failed").textContent = `The page cannot be shown: ${error.message}${needed}`;
  throw error;
});
