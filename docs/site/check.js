// Looks at the pages of `task` in frames as wide as a screen and a phone, and lists what is wrong with them.
const report = line => { document.getElementById("found").textContent += line + "\n"; };

const open_page = (frame, address) => new Promise(resolve => {
  frame.onload = () => setTimeout(() => resolve(frame.contentDocument), 30);
  frame.src = address;
});

const check_page = (page, address, width) => {
  const root = page.documentElement;
  if (root.scrollWidth > width + 1) report(`${address}: ${root.scrollWidth} px wide at ${width} px`);
  for (const formula of page.querySelectorAll(".formula")) {
    if (!formula.querySelector(".katex") || formula.querySelector(".katex-error")) report(`${address}: not typeset: ${formula.textContent}`);
  }
  for (const picture of page.images) {
    if (picture.complete && picture.naturalWidth === 0) report(`${address}: no picture ${picture.src}`);
  }
};

const check_search = async (frame, words, expected) => {
  const page = await open_page(frame, "/search.html?q=" + encodeURIComponent(words));
  const links = () => [...page.querySelectorAll("ul.search li > a")].map(link => new URL(link.href).pathname);
  for (let wait = 0; wait < 100 && !/finished|did not match/.test(page.querySelector("#search-results")?.textContent ?? ""); ++wait) {
    await new Promise(resolve => setTimeout(resolve, 50));
  }
  const first = links().slice(0, 3);
  if (!first.includes(`/${expected}.html`)) report(`search for "${words}": ${expected} is not among ${first.join(" ")}`);
};

(async () => {
  const frame = document.createElement("iframe");
  frame.height = 900;
  document.body.append(frame);
  for (const width of task.widths) {
    frame.width = width;
    for (const address of task.pages) check_page(await open_page(frame, "/" + address), address, width);
  }
  for (const [words, expected] of Object.entries(task.searches)) await check_search(frame, words, expected);
  report("the end");
})();
