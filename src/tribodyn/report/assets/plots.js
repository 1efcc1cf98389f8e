// Plots in their boxes: made when they come near the screen, repainted when the theme changes.

const figures = [];

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
    action();
  });
  box.append(area);
  return area;
}

/** Draw a plot, or draw it again. */
function react(area, traces, layout) {
  return Plotly.react(area, traces, { ...theme.layout(), ...layout }, {
    displayModeBar: false,
    responsive: true,
    doubleClick: "reset+autosize",
  });
}

/** Put buttons below a plot. */
function tools(box, ...parts) {
  box.append(element("div", { class: "tools" }, ...parts));
}

/** A figure of the page: draws itself when it is near, and follows time and theme while it is. */
class Figure {
  constructor(box, data) {
    this.box = box;
    this.data = data;
    this.near = false;
    this.stale = false;
    this.widget = null;
  }

  come() {
    this.near = true;
    if (!this.widget) {
      this.widget = widgets[this.box.dataset.widget](this.box, this.data);
      this.box.classList.add("drawn");
      this.stale = true;
    }
    if (this.stale) this.repaint();
    else this.show(clock.frame);
  }

  repaint() {
    this.stale = !this.near;
    if (!this.near || !this.widget) return;
    this.widget.paint();
    this.show(clock.frame);
  }

  show(frame) {
    if (this.near && this.widget && this.widget.show && clock.frames) this.widget.show(frame);
  }
}

/** Find the figures of the page and watch which of them are near the screen. */
function watchFigures() {
  const watcher = new IntersectionObserver(
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
    const figure = new Figure(box, page.figures[box.dataset.name]);
    figures.push(figure);
    watcher.observe(box);
  }
  theme.dark.addEventListener("change", () => figures.forEach((figure) => figure.repaint()));
}
