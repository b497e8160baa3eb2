// A PNG of the picture with its labels.
import { byId } from "./dom.js";

function drawLabel(pen, label, scale) {
  const style = getComputedStyle(label.element);
  const [x, y] = label.place.map((value) => value * scale);
  const size = parseFloat(style.fontSize) * scale;
  pen.font = `${style.fontWeight} ${size}px ${style.fontFamily}`;
  pen.lineJoin = "round";
  pen.lineWidth = 4 * scale;
  pen.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--halo");
  pen.strokeText(label.element.textContent, x, y + size);
  pen.fillStyle = style.color;
  pen.fillText(label.element.textContent, x, y + size);
}

/** The picture as a canvas. */
export function pictureOf(stage, labels) {
  const canvas = document.createElement("canvas");
  stage.render(); // its pixels are kept until this task ends
  [canvas.width, canvas.height] = [stage.canvas.width, stage.canvas.height];
  const pen = canvas.getContext("2d");
  pen.drawImage(stage.canvas, 0, 0);
  const scale = canvas.width / stage.canvas.clientWidth;
  for (const label of labels.labels) {
    if (!label.element.hidden) drawLabel(pen, label, scale);
  }
  return canvas;
}

export function save(stage, labels, name) {
  pictureOf(stage, labels).toBlob((blob) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${name.replaceAll("/", "_")}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    byId("said").textContent = "The picture is saved.";
  }, "image/png");
}
