// Figures in their boxes: made when they come near the screen, repainted when size or theme change.

const figures = [];
/** Tells which figures are near the screen. */
let watcher = null;

/** Put a plot area into a box; it takes the keyboard, and `keys` says what each key does. */
function plotArea(box, height, keys, hint) {
  const title = box.closest("figure").querySelector("h3").textContent;
  const area = element("div", {
    class: "plot",
    tabindex: "0",
    role: "application",
    "aria-label": `${title}. ${hint}`,
    style: `height: ${height}px`,
  });
  area.addEventListener("keydown", (event) => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  });
  box.append(area);
  return area;
}

/** Drawn by the processor: where a graphics card is imitated by software, long dashed curves take it seconds. */
const ON_PROCESSOR = { willReadFrequently: true };

/** A canvas over the whole of a plot area, measured in the pixels of the style sheet. */
class Sheet {
  constructor(area) {
    this.area = area;
    this.canvas = element("canvas", { "aria-hidden": "true" });
    this.width = 0;
    this.height = 0;
    area.append(this.canvas);
  }

  /** Fit the canvas to its area and the screen; return whether there is room to draw. */
  fit() {
    const ratio = devicePixelRatio || 1;
    [this.width, this.height] = [this.area.clientWidth, this.area.clientHeight];
    const [width, height] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    if (this.canvas.width !== width || this.canvas.height !== height) {
      Object.assign(this.canvas, { width, height });
    }
    return width > 0 && height > 0;
  }

  /** Return a pen for an empty sheet. */
  fresh() {
    this.fit();
    const pen = this.canvas.getContext("2d", ON_PROCESSOR);
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    pen.scale(this.canvas.width / (this.width || 1), this.canvas.height / (this.height || 1));
    return pen;
  }
}

/** Return where a pointer is in an area [px]. */
function pointerAt(area, event) {
  const { left, top } = area.getBoundingClientRect();
  return [event.clientX - left, event.clientY - top];
}

/** Put buttons below a plot; return their row. */
function tools(box, ...parts) {
  const row = element("div", { class: "tools" }, ...parts);
  box.append(row);
  return row;
}

/** A figure of the page: draws itself when it is near, and follows time, size and theme while it is. */
class Figure {
  constructor(box) {
    Object.assign(this, { box, data: null, ghosts: [], near: false, stale: true, given: false, widget: null });
  }

  /** Take what is to be drawn, and what of other runs shows through. */
  take(data, ghosts) {
    Object.assign(this, { data, ghosts, given: false });
    this.repaint();
  }

  come() {
    this.near = true;
    if (!this.widget) this.make();
    if (this.stale) this.repaint();
    else this.show(clock.frame);
  }

  /** Make what draws; a focus that waits for it on the empty box goes to the plot. */
  make() {
    const awaited = document.activeElement === this.box;
    this.box.removeAttribute("tabindex");
    this.widget = widgets[this.box.dataset.widget](this.box);
    this.box.classList.add("drawn");
    new ResizeObserver(() => this.repaint()).observe(this.box);
    if (awaited) this.box.querySelector(".plot")?.focus();
  }

  /** Leave the page: a browser lends few drawing contexts of the graphics card. */
  leave() {
    this.near = false;
    this.box.querySelector(".plot")?.plotted?.gl?.getExtension("WEBGL_lose_context")?.loseContext();
  }

  repaint() {
    this.stale = !this.near;
    if (!this.near || !this.widget) return;
    this.data ??= page.figures[this.box.dataset.name];
    if (!this.data) return;
    if (!this.given) this.widget.take(this.data, this.ghosts);
    this.given = true;
    this.widget.paint();
    this.show(clock.frame);
  }

  show(frame) {
    if (this.near && this.given && this.widget.show && clock.frames) this.widget.show(frame);
  }
}

/** Find the figures of the page and watch which of them are near the screen; those of before are let go. */
function watchFigures() {
  watcher?.disconnect();
  figures.forEach((figure) => figure.leave());
  figures.length = 0;
  watcher = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        const figure = figures.find((one) => one.box === entry.target);
        if (entry.isIntersecting) figure.come();
        else figure.near = false;
      }
    },
    { rootMargin: "300px 0px" },
  );
  for (const box of document.querySelectorAll("[data-widget]")) {
    const figure = new Figure(box);
    figures.push(figure);
    watcher.observe(box);
    // The keyboard goes faster than the page scrolls: it must not jump over what is not yet made.
    box.tabIndex = 0;
    box.addEventListener("focus", () => figure.come());
  }
}

theme.dark.addEventListener("change", () => {
  theme.forget();
  figures.forEach((figure) => figure.repaint());
});
