// Begin: read the data of the page, let the style sheet know that scripts run, draw what is near.

/** Return the data of the page: a header in JSON after its length, and the arrays that it refers to, all compressed. */
async function pageData() {
  const text = atob(document.getElementById("page-data").textContent);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(stream).arrayBuffer();
  const [length] = new Uint32Array(buffer, 0, 1);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  const arrays = (node) => unpack(node, buffer, 8 + length);
  return { clock: arrays(header.clock), figures: madeWhenRead(header.figures, arrays) };
}

/** Return an object whose values are made at their first use: most figures are below the screen. */
function madeWhenRead(nodes, make) {
  const found = {};
  for (const [name, node] of Object.entries(nodes)) {
    let made = null;
    Object.defineProperty(found, name, { enumerable: true, get: () => (made ??= make(node)) });
  }
  return found;
}

pageData().then((data) => {
  Object.assign(page, data);
  document.documentElement.classList.replace("plain", "alive");
  clock.start();
  watchFigures();
  if (clock.frames && !matchMedia("(prefers-reduced-motion: reduce)").matches) clock.toggle();
});

/** Open what a link inside the page points into. */
function openTarget() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const folded = target && target.closest("details");
  if (!folded) return;
  folded.open = true;
  target.scrollIntoView();
}

addEventListener("hashchange", openTarget);

// Paper cannot be unfolded.
addEventListener("beforeprint", () => {
  for (const folded of document.querySelectorAll("#made details")) folded.open = true;
});
