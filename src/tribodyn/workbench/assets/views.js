// The figures of the run that is shown, with pinned and late runs behind them.

const PINNED = 0.5;
/** Strength of the newest run of the trail; older ones fade from there. */
const FADING = 0.22;
/** Figures in which only pinned runs show through: a trail of bodies would hide them. */
const SOLID = new Set(["scene", "linkage"]);

/** Make the figures that a mechanism has, those that follow time first. */
function makeViews() {
  const place = document.getElementById("views");
  place.replaceChildren();
  // Those of a model before have other figures of the same names.
  page.figures = {};
  for (const { name, title, lead } of pageState.hello.chapters) {
    const sections = pageState.hello.sections.filter((section) => section.chapter === name);
    const moving = sections.some((one) => one.playback);
    const about = { id: `chapter-${name}`, class: moving ? "moving" : "" };
    const chapter = element("section", about, element("h2", {}, title));
    const grid = element("div", { class: moving ? "playback" : "" });
    if (lead) chapter.append(element("p", { class: "lead" }, lead));
    grid.append(...sections.map(viewOf));
    chapter.append(grid);
    place.append(chapter);
  }
  watchFigures();
}

/** Make the frame of a figure. */
function viewOf({ name, title, caption, widget }) {
  const live = element("div", { class: "live", "data-widget": widget, "data-name": name });
  const words = element("figcaption", {}, element("h3", {}, title));
  if (caption) words.append(element("details", {}, element("summary", {}, "How to read it"), element("p", {}, caption)));
  return element("figure", { id: name }, words, live);
}

/** Return the other runs that show through, the oldest first: [{run, strength}]. */
function others() {
  const { run: shown } = pageState.shown;
  const trail = pageState.trail.filter(({ run }) => pageState.pins.every((pin) => pin.run !== run));
  const pinned = pageState.pins.map((run) => ({ run, strength: PINNED, pinned: true }));
  const late = trail.map((run, k) => ({ run, strength: (FADING * (k + 1)) / trail.length }));
  return [...late, ...pinned].filter(({ run }) => run.run !== shown);
}

/** Give the figures the run that is shown. */
function giveViews() {
  const { shown } = pageState;
  page.clock = shown.clock;
  page.figures = shown.sections;
  clock.take();
  const ghosts = others();
  for (const figure of figures) {
    const { name, widget } = figure.box.dataset;
    const data = shown.sections[name];
    figure.box.closest("figure").hidden = !data;
    if (!data) continue;
    const behind = ghosts.filter(({ run, pinned }) => run.sections[name] && (pinned || !SOLID.has(widget)));
    figure.take(data, behind.map(({ run, strength }) => ({ data: run.sections[name], strength })));
  }
  for (const chapter of document.querySelectorAll("#views > section")) {
    chapter.hidden = !chapter.querySelector("figure:not([hidden])");
  }
}
