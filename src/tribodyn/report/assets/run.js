// Begin: read the data of the page, tell the style sheet that scripts run, draw what is near.

Object.assign(page, unpack(JSON.parse(document.getElementById("page-data").textContent)));
document.documentElement.classList.replace("plain", "alive");
clock.start();
watchFigures();

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
