// Labels over the picture, at places in the world.
import { Vector3 } from "three";
import { make } from "./dom.js";

export class Labels {
  constructor(layer, stage) {
    this.layer = layer;
    this.stage = stage;
    this.labels = [];
  }

  set(labels) {
    this.layer.replaceChildren();
    this.labels = labels.map((label) => ({ ...label, element: this.layer.appendChild(make("span", { class: `label ${label.kind}` }, label.text)) }));
    this.place();
  }

  /** Where a place in the world is on the picture [px]; null behind the camera. */
  onPicture(at) {
    const p = new Vector3().copy(at).project(this.stage.camera);
    if (p.z > 1) return null;
    return [((p.x + 1) / 2) * this.layer.clientWidth, ((1 - p.y) / 2) * this.layer.clientHeight];
  }

  place() {
    const taken = [];
    for (const label of this.labels) {
      const at = this.onPicture(label.at);
      label.element.hidden = !at;
      if (!at) continue;
      let [x, y] = [at[0] + 10, at[1] - 9];
      while (taken.some(([u, v]) => Math.abs(u - x) < 60 && Math.abs(v - y) < 18)) y += 19;
      const width = label.element.offsetWidth;
      x = Math.min(Math.max(x, 2), this.layer.clientWidth - width - 2);
      taken.push([x, y]);
      label.element.style.transform = `translate(${x}px, ${y}px)`;
      label.place = [x, y];
    }
  }
}
