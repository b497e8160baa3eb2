// Elements in few words.

/** An element with attributes, listeners (on...) and children. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElementNS(svgTags.has(tag) ? "http://www.w3.org/2000/svg" : "http://www.w3.org/1999/xhtml", tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

const svgTags = new Set(["svg", "path", "line", "text", "g", "rect"]);

export const byId = (id) => document.getElementById(id);
