// Begin: tell the style sheet that scripts run, connect the slider, draw what is near.

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
