// bundle.js OUT: writes the page in one file, with what it needs of three.js.
import { build, transform } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";

const { outputFiles } = await build({
  entryPoints: ["src/main.js"], bundle: true, minify: true, format: "iife", target: "es2020", charset: "ascii", legalComments: "none", write: false,
});
const { code } = await transform(readFileSync("page.css", "utf8"), { loader: "css", minify: true });
const licence = readFileSync("node_modules/three/LICENSE", "utf8").trim();
// Functions: in a text, $& would stand for what is replaced.
const page = readFileSync("page.template.html", "utf8")
  .replace("/*style*/", () => code.trim())
  .replace("/*script*/", () => `/*! three.js\n${licence}\n*/\n${outputFiles[0].text.trim()}`);
writeFileSync(process.argv[2], page);
console.log(`${process.argv[2]}: ${(page.length / 1e6).toFixed(2)} MB`);
