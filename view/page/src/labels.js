// Labels over the picture, at places in the world.
import { Vector3 } from "three";
import { make } from "./dom.js";

const kShifts = [0, -19, 19, -38, 38, -57, 57]; // px: where labels may move to
const kTools = 44; // px: below the buttons over the picture

export class Labels {
  constructor(layer, stage) {
    this.layer = layer;
    this.stage = stage;
    this.labels = [];
  }

  /** A list of labels for each view, each with its text, kind and place; a title has none. */
  set(views) {
    this.layer.replaceChildren();
    this.labels = views.flatMap((labels, view) =>
      labels.map((label) => ({ ...label, view, element: this.layer.appendChild(make("span", { class: `label ${label.kind}` }, label.text)) })));
    this.lines = views.slice(1).map(() => this.layer.appendChild(make("div", { class: "divider" })));
    this.place();
  }

  /** Where a place in the world is on the picture [px]; null behind the camera. */
  onPicture(at, box) {
    const p = new Vector3().copy(at).project(this.stage.camera);
    if (p.z > 1 || Math.abs(p.x) > 1.02 || Math.abs(p.y) > 1.02) return null;
    return [box.x + ((p.x + 1) / 2) * box.width, box.y + ((1 - p.y) / 2) * box.height];
  }

  place() {
    const taken = [];
    for (const label of this.labels) {
      const box = this.stage.boxOf(label.view);
      const at = label.at ? this.onPicture(label.at, box) : [box.x + 2, box.y + (box.y > 0 ? 12 : kTools + 9)];
      label.element.hidden = !at;
      if (!at) continue;
      let [x, y] = [at[0] + 10, at[1] - 9];
      const free = (v) => !taken.some(([u, w]) => Math.abs(u - x) < 60 && Math.abs(w - v) < 18);
      y += kShifts.find((shift) => free(y + shift)) ?? 0;
      const width = label.element.offsetWidth;
      x = Math.min(Math.max(x, box.x + 6), box.x + box.width - width - 6);
      taken.push([x, y]);
      label.element.style.transform = `translate(${x}px, ${y}px)`;
      label.place = [x, y];
    }
    this.lines.forEach((line, i) => {
      const { x, y, width, height } = this.stage.boxOf(i + 1);
      line.style.cssText = x > 0 ? `left: ${x}px; top: 0; width: 1px; height: ${height}px` : `left: 0; top: ${y}px; width: ${width}px; height: 1px`;
    });
  }
}
