// check.mjs MAXWRENCH OUT [TASK...]: pages of `maxwrench view` in headless Chromium at 1280 and 390 px, light and dark. Every control is moved, and the values
// are those of `maxwrench eval`. Pages and screenshots stand in OUT, for people to look at.
import { execFile } from "node:child_process";
import { mkdirSync, statSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { Browser } from "./browser.mjs";

const [command, folder, ...chosen] = process.argv.slice(2);
const kListInTime = "examples/tasks/turn_along_with_a_dead_thruster.toml";
const inTime = (task) => task.includes("trajectory") || task === kListInTime;
const out = resolve(folder);
mkdirSync(out, { recursive: true });

const kTasks = chosen.length ? chosen : ["uvms/valve", "uvms/valve_trajectory", "dual_arm/two_arms", "mobile/push", "planar/force", "fixed/push", "gallery/gen3/lift",
  "examples/tasks/lift_with_a_dead_thruster.toml", kListInTime];
const kSizes = [{ width: 1280, height: 800, scheme: "light" }, { width: 390, height: 844, scheme: "dark" }];
const kBrowsers = 2; // beside each other
const kWords = { "uvms/valve": ["--within", "1%"], "planar/force": ["--within", "2%", "--resolution", "0.02"], "uvms/valve_trajectory": ["--tank"], [kListInTime]: ["--budget", "30"] };  // more options of the command
const kMostBytes = 4e6;
const kPause = 250;  // ms: the page lists the IK solutions when a slider has rested for 120 ms

let passed = 0;
const failed = [];
function check(holds, what) {
  if (holds) ++passed;
  else failed.push(what);
  if (!holds) console.log(`failed: ${what}`);
}

/** The output of the command; its status is 1 where there is no value. */
function run(...words) {
  return new Promise((resolve, reject) => execFile(command, words, { encoding: "utf8", maxBuffer: 1e8 }, (error, stdout, stderr) => {
    if (error && error.code !== 1) reject(new Error(`maxwrench ${words.join(" ")}: ${stderr || error.message}`));
    else resolve(stdout);
  }));
}
const fileOf = (task) => `${out}/${task.replace(/^.*tasks./, "").replace(".toml", "").replaceAll("/", "_")}`;
const evaluate = async (task, theta, ...words) => JSON.parse(await run("eval", task, "--json", ...words, "--theta-r", theta.join(",")));
const near = (a, b) => Math.abs(a - b) <= 1e-9 * (1 + Math.abs(b));

const beta = (page) => page.evaluate("Number(document.getElementById('beta').dataset.value)");
const click = (page, id) => page.evaluate(`document.getElementById("${id}").click()`);
const slide = (page, id, value) =>
  page.evaluate(`(() => { const input = document.getElementById("${id}"); input.value = ${value}; input.dispatchEvent(new Event("input", {bubbles: true})); })()`);

async function checkLayout(page, name, width) {
  check(await page.evaluate(`document.documentElement.scrollWidth <= ${width}`), `${name}: nothing is too wide`);
  const hidden = await page.evaluate("[...document.querySelectorAll('#binds, #ends, .wide-table')].filter((e) => e.scrollWidth > e.clientWidth).length");
  check(hidden === 0, `${name}: tables are as wide as the panel`);
  const unnamed = await page.evaluate(`[...document.querySelectorAll("button, input")].filter((e) => !(e.textContent.trim() || e.ariaLabel || e.labels?.length)).length`);
  check(unnamed === 0, `${name}: every control has a name`);
  const scene = await page.evaluate("JSON.parse(document.getElementById('scene').textContent).robot.actuators.length");
  check((await page.evaluate("document.querySelectorAll('#efforts li').length")) === scene, `${name}: all efforts are listed`);
}

async function checkPostures(page, task, name) {
  const shown = await page.evaluate("JSON.parse(document.getElementById('scene').textContent).shown.map((s) => ({name: s.name, theta: s.frames[0].theta_r, beta: s.frames[0].beta}))");
  for (const each of shown) {
    await click(page, `posture-${each.name}`);
    check(near(await beta(page), each.beta), `${name}: ${each.name} has its value`);
    if (inTime(task)) continue;
    check(near(await beta(page), (await evaluate(task, each.theta)).beta), `${name}: ${each.name} has the value of eval`);
  }
}

async function checkSwitches(page, name) {
  const ids = await page.evaluate("[...document.querySelectorAll('#show input[type=checkbox]')].map((input) => input.id)");
  for (const id of ids) {
    const before = await page.evaluate(`document.getElementById("${id}").checked`);
    await click(page, id);
    check((await page.evaluate(`document.getElementById("${id}").checked`)) !== before, `${name}: ${id} switches`);
    await click(page, id);
  }
  await slide(page, "scale", 1);
  await slide(page, "scale", 0);
  const theme = "document.documentElement.dataset.theme";
  const before = await page.evaluate(theme);
  await click(page, "theme");
  check((await page.evaluate(theme)) !== before, `${name}: the theme switches`);
  await click(page, "theme");
  for (const key of ["ArrowLeft", "ArrowUp", "+", "-", "1", "2", " ", " ", "Home"]) {
    await page.evaluate(`document.getElementById("canvas").dispatchEvent(new KeyboardEvent("keydown", {key: "${key}", bubbles: true}))`);
  }
  await page.evaluate("document.querySelector('#efforts li').dispatchEvent(new PointerEvent('pointerenter'))");
  check(await page.evaluate("document.querySelector('#efforts li').classList.contains('lit')"), `${name}: an effort lights up`);
  await page.evaluate("document.querySelector('#efforts li').dispatchEvent(new PointerEvent('pointerleave'))");
  await click(page, "png");
  await click(page, "link");
  check(await page.evaluate("location.hash.includes('camera=')"), `${name}: the link holds the view`);
}

/** With the engine: each of the first sliders moves the robot, and the value is that of the command. */
async function checkSliders(page, task, name, most) {
  const count = Math.min(most, await page.evaluate("document.querySelectorAll('#coordinates input:not(:disabled)').length"));
  for (let i = 0; i < count; ++i) {
    const [low, high, at] = await page.evaluate(`["min", "max", "value"].map((key) => Number(document.getElementById("theta-${i}")[key]))`);
    await slide(page, `theta-${i}`, at + 0.02 * (at > (low + high) / 2 ? low - at : high - at));
    const theta = await page.evaluate("[...document.querySelectorAll('#coordinates input')].map((input) => Number(input.value))");
    const expected = await evaluate(task, theta);
    const value = await beta(page);
    const right = expected.beta === null ? !Number.isFinite(value) : expected.ik_solutions.valid > 1 ? value <= expected.beta || near(value, expected.beta) : near(value, expected.beta);
    check(right, `${name}: slider ${i}: ${value}, eval has ${expected.beta}`);
    if (expected.beta !== null) await checkSolutions(page, expected, `${name}: slider ${i}`);
    if (expected.beta !== null) await checkDetails(page, task, `${name}: slider ${i}`);
  }
}

/** What stands beside the value belongs to the posture of the sliders: sets, and what binds as the command says it, or the scenarios. */
async function checkDetails(page, task, name) {
  await page.until("!app.entry.stale");
  const theta = await page.evaluate("Array.from(app.frame.theta_r)");
  const shown = await page.evaluate("({set: app.frame.sets?.polytope?.vertices ?? null, c: Array.from(app.frame.c), beta: app.frame.beta, words: document.getElementById('binds').innerText.replaceAll('\u00a0', ' ')})");
  if (shown.set) {
    const first = (await page.evaluate("app.frame.sets.of")) === "force" ? 0 : 3;
    let most = -Infinity; // beta c is in the set
    for (let i = 0; i < shown.set.length; i += 3) most = Math.max(most, [0, 1, 2].reduce((sum, k) => sum + shown.set[i + k] * shown.c[first + k], 0));
    check(most >= shown.beta * (1 - 1e-5), `${name}: the set reaches ${most}, beta is ${shown.beta}`);
    check(await page.evaluate("document.getElementById('set-note').hidden"), `${name}: the set is that of the posture`);
  }
  if (task.includes("tasks/")) {
    const { decides: scenario, scenarios } = await evaluate(task, theta, "--scenarios");
    const decides = scenario.replaceAll("_", " ");
    check((await page.evaluate("document.getElementById('decides').textContent")).startsWith(`${decides} decides`), `${name}: ${decides} decides`);
    check((await page.evaluate("document.querySelectorAll('#ends tbody tr').length")) === scenarios.length, `${name}: ${scenarios.length} scenarios are listed`);
    return;
  }
  const expected = await evaluate(task, theta, "--explain");
  if (!near(expected.beta, shown.beta)) return; // another IK solution
  const words = expected.explanation.words.split("\n")[0].replace("binds: ", "").replaceAll("_", " ");
  check(shown.words.toLowerCase().includes(words.toLowerCase()), `${name}: "${shown.words.split("\n")[0]}", eval says "${words}"`);
}

/** Pictures beside each other, and the table. */
async function checkBeside(page, name, picture) {
  await click(page, "show-beside");
  const entries = await page.evaluate("app.entries.length");
  check((await page.evaluate("document.querySelectorAll('.label.title').length")) === (entries > 1 ? entries : 0), `${name}: each picture has its title`);
  check((await page.evaluate("document.querySelectorAll('#compare thead th').length")) === entries + 1, `${name}: each posture has its column`);
  if (picture) {
    await page.evaluate("document.getElementById('canvas').scrollIntoView()");
    await page.screenshot(picture);
  }
  await click(page, "show-beside");
}

/** The page stays on one of several IK solutions, and the command takes the best one: this is among those that the page offers. */
async function checkSolutions(page, expected, name) {
  const count = expected.ik_solutions.valid > 1 ? expected.ik_solutions.valid : 0;
  const buttons = "document.querySelectorAll('#solutions button')";
  await new Promise((resolve) => setTimeout(resolve, kPause));
  await page.until(`${buttons}.length === ${count}`);
  if (count === 0) return;
  let best = -Infinity;
  for (let i = 0; i < count; ++i) {
    await page.evaluate(`${buttons}[${i}].click()`);
    check(await page.evaluate(`${buttons}[${i}].ariaPressed === "true"`), `${name}: solution ${i + 1} is chosen`);
    best = Math.max(best, await beta(page));
  }
  check(near(best, expected.beta), `${name}: the best solution has ${best}, eval has ${expected.beta}`);
}

async function checkTime(page, name) {
  const links = "JSON.parse(document.getElementById('scene').textContent).shown[0].frames.map((f) => [f.t, f.beta])";
  const frames = await page.evaluate(links);
  await click(page, "posture-best");
  for (const [t, value] of [frames[0], frames[Math.floor(frames.length / 2)], frames[frames.length - 1]]) {
    await slide(page, "instant", t);
    check(near(await beta(page), value), `${name}: the value at ${t} s`);
  }
  await slide(page, "instant", 0);
  await click(page, "play");
  await page.until("Number(document.getElementById('instant').value) > 0.05");
  await page.evaluate("app.timeline.playing && document.getElementById('play').click()"); // a slow browser may have come to the end
  check((await page.evaluate("document.getElementById('play').ariaLabel")) === "Play", `${name}: it pauses`);
  check((await page.evaluate("document.querySelectorAll('#curves svg').length")) === 4, `${name}: value, efforts, rates, and the tank or the scenarios have curves`);
  await slide(page, "instant", frames[0][0]);
}

/** Which scenario decides, and what each allows, is what the command says; the text follows the cursor, and the least at the cursor is that of the curves. */
async function checkScenariosInTime(page, task, name) {
  const expected = JSON.parse(await run("eval", task, "--scenarios", "--json"));
  const plain = (text) => text.replaceAll("_", " ");
  await click(page, "posture-default");
  await slide(page, "instant", expected.decides_at);
  const text = async () => (await page.evaluate("document.getElementById('decides').textContent")).replaceAll("\u00a0", " ");
  check((await text()).startsWith(`${plain(expected.decides)} decides at `), `${name}: "${await text()}"`);
  const shown = await page.evaluate("app.entry.scenarios");
  check(shown.ends.length === expected.scenarios.length, `${name}: ${shown.ends.length} scenarios are listed`);
  for (const each of expected.scenarios) {
    const listed = shown.ends.find((end) => end.name === each.name);
    check(listed && near(listed.high, each.high), `${name}: ${each.name}: ${listed?.high}, eval has ${each.high}`);
  }
  for (const share of [0, 0.3, 1]) {
    const t = shown.t[Math.round(share * (shown.t.length - 1))];
    await slide(page, "instant", t);
    const worst = shown.ends.reduce((a, b) => (b.values[shown.t.indexOf(t)] < a.values[shown.t.indexOf(t)] ? b : a));
    check((await text()).includes(`least is left with ${plain(worst.name)}: `), `${name}: at ${t} s: "${await text()}"`);
    check(Math.min(...worst.values) >= expected.beta * (1 - 1e-9), `${name}: rates only take away`);
  }
  check((await page.evaluate("document.querySelectorAll('#ends tbody tr').length")) === 2 * shown.ends.length, `${name}: all have a row`);
}

/** The experiment of the default trajectory is that of the command; one of the sliders has none. */
async function checkTank(page, task, name) {
  const expected = JSON.parse(await run("simulate", task, "--json"));
  await click(page, "posture-default");
  const { held, reading, curve } = await page.evaluate("app.entry.tank");
  check(held === expected.held && near(reading, expected.low), `${name}: the tank reads ${reading}, simulate has ${expected.low}`);
  const k = Math.floor(curve.t.length / 2);
  await slide(page, "instant", curve.t[k]);
  const text = await page.evaluate("document.getElementById('tank').textContent.replaceAll('\\u00a0', ' ')");
  check(text.startsWith("Virtual tank: held, reads") && text.endsWith(`${Number(curve.reading[k].toPrecision(5))} N m at the cursor.`), `${name}: "${text}"`);
  const cursors = await page.evaluate("[...document.querySelectorAll('#curves .cursor')].map((line) => line.getAttribute('x1'))");
  check(new Set(cursors).size === 1, `${name}: all curves have the same cursor: ${cursors}`);
}

/** Projections of good postures: a click and the keys show a posture, with the value of the command. */
async function checkRegions(page, task, name) {
  if (!(await page.evaluate("Boolean(app.regions)"))) return;
  const least = await page.evaluate("app.regions.within.least");
  const canvases = "document.querySelectorAll('#projections canvas')";
  const panels = await page.evaluate(`${canvases}.length`);
  const r = await page.evaluate("app.scene.task.theta_r.length");
  check(panels === (r * (r - 1)) / 2, `${name}: each pair of coordinates has a projection`);
  const same = async (what) => {
    const { theta, own } = await page.evaluate("({theta: Array.from(app.frame.theta_r), own: app.name === 'own'})");
    const value = await beta(page);
    check(own && near(value, (await evaluate(task, theta)).beta), `${name}: ${what}: ${value}`);
    return value;
  };
  const buttons = "document.querySelectorAll('#clusters button')";
  await page.evaluate(`${buttons}[0].click()`);
  check((await same("the best posture of the first cluster")) >= least, `${name}: it is good`);
  for (let i = 0; i < panels; ++i) {
    // In the middle of the box with the largest bound.
    const at = await page.evaluate(`(() => { const { regions } = app, panel = regions.panels[${i}];
      const share = (k) => ((regions.lower[k] + regions.upper[k]) / 2 - regions.range[k][0]) / (regions.range[k][1] - regions.range[k][0]);
      panel.canvas.scrollIntoView({ block: "center" });
      const box = panel.canvas.getBoundingClientRect();
      return { x: box.left + share(panel.i) * box.width, y: box.top + (1 - share(panel.j)) * box.height }; })()`);
    await click(page, "posture-default");
    for (const type of ["mousePressed", "mouseReleased"]) await page.send("Input.dispatchMouseEvent", { type, button: "left", clickCount: 1, ...at });
    check((await same(`a click on projection ${i + 1}`)) >= least * 0.9, `${name}: a click finds a nearly good posture`);
  }
  const key = (key) => page.evaluate(`${canvases}[0].dispatchEvent(new KeyboardEvent("keydown", {key: "${key}", bubbles: true}))`);
  const said = () => page.evaluate("document.getElementById('said').textContent");
  await page.evaluate(`${buttons}[0].click(), ${canvases}[0].focus()`);
  await key("ArrowRight");
  await key("ArrowLeft");
  check((await said()).endsWith("good postures may be here"), `${name}: "${await said()}"`);
  await key("Enter");
  await same("Enter");
  for (let i = 0; i < 60; ++i) await key("ArrowLeft");
  check((await said()).endsWith("no good posture"), `${name}: "${await said()}"`);
  await key("Enter");
  check((await said()) === "No good posture is here.", `${name}: "${await said()}"`);
}

/** A slider moves the knot nearest to the cursor, and the trajectory has the value of the command. */
async function checkKnots(page, task, name) {
  await click(page, "posture-default");
  await slide(page, "instant", 0);
  await click(page, "knot-behind");
  const knot = await page.evaluate("app.knot");
  check(knot === 1, `${name}: the next knot is ${knot}`);
  const [low, high, at] = await page.evaluate(`["min", "max", "value"].map((key) => Number(document.getElementById("theta-0")[key]))`);
  await slide(page, "theta-0", at + 0.01 * (high - low));
  await page.until("app.name === 'own'");
  const { knots, beta: value, reason } = await page.evaluate("({knots: app.entry.knots.map((row) => Array.from(row)), beta: app.entry.beta, reason: app.entry.reason})");
  check(Math.abs(knots[1][0] - at) > 0.009 * (high - low), `${name}: the knot moved`);
  const names = await page.evaluate("app.scene.task.theta_r.map((coordinate) => coordinate.name)");
  const knotFile = `${fileOf(task)}_knots.csv`;
  writeFileSync(knotFile, [names, ...knots].map((row) => row.join(",")).join("\n") + "\n");
  const expected = JSON.parse(await run("eval", task, "--json", "--theta-r", knotFile));
  check(expected.beta === null ? value === null : near(value, expected.beta), `${name}: knot: ${value} (${reason}), eval has ${expected.beta} (${expected.reason})`);
  await page.until("app.frame.sets !== undefined");
  check(await page.evaluate("document.getElementById('set-note').hidden"), `${name}: the set is that of the instant`);
  await click(page, "knot-before");
  check((await page.evaluate("app.t")) === 0, `${name}: back at the first knot`);
}

async function checkPage(browser, task, size) {
  const file = fileOf(task);
  const name = `${task} at ${size.width} px`;
  const wide = size.width > 1000; // the narrow page has the same values: there one slider shows that the controls work
  const start = Date.now();
  const page = await browser.open(`file://${file}.html`, size);
  console.log(`${name}: opened in ${((Date.now() - start) / 1000).toFixed(1)} s`);
  check((await page.evaluate("document.documentElement.dataset.theme")) === size.scheme, `${name}: the system's scheme`);
  await page.screenshot(`${file}_${size.width}.png`);
  await checkLayout(page, name, size.width);
  await checkPostures(page, task, name);
  if (wide) {
    const first = await page.picture();
    await page.evaluate("document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft', bubbles: true}))");
    check((await page.picture()) !== first, `${name}: the picture turns`);
  }
  await checkSwitches(page, name);
  await checkBeside(page, name, `${file}_${size.width}_beside.png`);
  if (task === kListInTime) {
    await checkTime(page, name);
    await checkScenariosInTime(page, task, name);
    await page.evaluate("document.getElementById('scenarios-section').scrollIntoView()");
    await page.screenshot(`${file}_${size.width}_scenarios.png`);
  } else if (inTime(task)) {
    await checkTime(page, name);
    if (wide) await checkTank(page, task, name);
    await checkKnots(page, task, name);
  } else {
    await checkSliders(page, task, name, wide ? Infinity : 1);
    await checkRegions(page, task, name);
  }
  await page.screenshot(`${file}_${size.width}_own.png`);
  await page.evaluate("document.getElementById('binds-section').scrollIntoView()");
  await page.screenshot(`${file}_${size.width}_binds.png`);
  if (await page.evaluate("Boolean(app.regions)")) {
    await page.evaluate("document.getElementById('regions-section').scrollIntoView()");
    await page.screenshot(`${file}_${size.width}_regions.png`);
  }
  await checkBeside(page, `${name}, with the posture of the sliders`, `${file}_${size.width}_all.png`);
  await checkOtherScheme(page, task, name, size);
  check(page.faults.length === 0, `${name}: no error: ${page.faults.join("; ")}`);
  check(page.requests.every((url) => url.startsWith(`file://${file}.html`)), `${name}: nothing is loaded: ${page.requests.join(", ")}`);
  await page.close();
}

/** The page in its other scheme: nothing too wide, a screenshot. */
async function checkOtherScheme(page, task, name, size) {
  const other = size.scheme === "light" ? "dark" : "light";
  await click(page, "theme");
  check((await page.evaluate("document.documentElement.dataset.theme")) === other, `${name}: the scheme is ${other}`);
  await page.evaluate("scrollTo(0, 0), document.querySelectorAll('*').forEach((e) => (e.scrollTop = 0))");
  await checkLayout(page, `${name}, ${other}`, size.width);
  await page.screenshot(`${fileOf(task)}_${size.width}_${other}.png`);
}

async function makePage(task) {
  const file = `${fileOf(task)}.html`;
  const start = Date.now();
  const words = kWords[task] ?? [];
  await run("view", task, "--out", file, ...(words.includes("--budget") ? [] : ["--budget", "3000"]), ...words);
  const bytes = statSync(file).size;
  check(bytes < kMostBytes, `${task}: ${bytes} bytes`);
  console.log(`${task}: ${(bytes / 1e6).toFixed(2)} MB in ${((Date.now() - start) / 1000).toFixed(1)} s`);
}

const left = [...kTasks];
async function checkTasks() {
  const browser = new Browser();
  try {
    while (left.length) {
      const task = left.shift();
      await makePage(task);
      for (const size of kSizes) await checkPage(browser, task, size);
    }
  } finally {
    await browser.close();
  }
}
await Promise.all(Array.from({ length: Math.min(kBrowsers, kTasks.length) }, checkTasks));
console.log(`${passed} checks passed, ${failed.length} failed; pages and pictures are in ${out}`);
process.exitCode = failed.length ? 1 : 0;
