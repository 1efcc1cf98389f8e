// Begin: unpack the plotting library, tell the style sheet that scripts run, draw what is near.

/** Unpack the plotting library and run it; the policy of the page lets nothing else run. */
async function runLibrary() {
  const packed = document.getElementById("library").textContent;
  const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  document.head.append(element("script", {}, await new Response(stream).text()));
}

// A browser that cannot unpack it keeps the still figures.
runLibrary().then(() => {
  document.documentElement.classList.replace("plain", "alive");
  clock.start();
  watchFigures();
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
