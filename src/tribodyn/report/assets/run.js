// Begin: read the data of the page, tell the style sheet that scripts run, draw what is near.

/** Return the data of the page: a header in JSON after its length, and the arrays that it speaks of, all compressed. */
async function pageData() {
  const bytes = Uint8Array.from(atob(document.getElementById("page-data").textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(stream).arrayBuffer();
  const [length] = new Uint32Array(buffer, 0, 1);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  return unpack(header, buffer, 8 + length);
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
