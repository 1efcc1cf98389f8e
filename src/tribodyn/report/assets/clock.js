// The one time slider: every figure that follows time hears of it.

const FRAME_MS = 40;
const MOST_LEFT_OUT = 6;
/** Share of the longest step between frames below which the picture runs slower than elsewhere. */
const SLOW = 0.25;

const clock = {
  frame: 0,
  frames: 0,
  playing: false,
  due: false,
  longest: 0,
  speed: 1,

  /** Return the simulated time now [s]. */
  now() {
    return page.clock.time[clock.frame];
  },

  /** Go to a frame; the figures follow with the next picture of the screen. */
  go(frame) {
    clock.frame = Math.max(0, Math.min(clock.frames - 1, frame));
    clock.write();
    if (clock.due) return;
    clock.due = true;
    requestAnimationFrame(() => {
      clock.due = false;
      figures.forEach((figure) => figure.show(clock.frame));
    });
  },

  /** Return the frame nearest to a time [s]. */
  nearest(time) {
    let best = 0;
    page.clock.time.forEach((t, k) => {
      if (Math.abs(t - time) < Math.abs(page.clock.time[best] - time)) best = k;
    });
    return best;
  },

  /** Go to the frame nearest to a time [s]. */
  goTo(time) {
    clock.go(clock.nearest(time));
  },

  /** Say on the slider what moment it is. */
  write() {
    const { time, notes } = page.clock;
    const text = `t = ${(clock.now() * page.clock.scale).toFixed(3)} ${page.clock.unit}`;
    const step = time[Math.min(clock.frame + 1, clock.frames - 1)] - clock.now();
    const slow = step > 0 && step < SLOW * clock.longest ? "slow motion" : "";
    const parts = [notes[clock.frame], slow].filter(Boolean);
    clock.shownAt = clock.now();
    clock.slider.value = clock.frame;
    clock.slider.setAttribute("aria-valuetext", [text, ...parts].join(", "));
    clock.output.replaceChildren(
      element("strong", {}, text),
      element("span", {}, parts.join(" · ")),
    );
  },

  /** Stop at a frame that a reader chose. */
  put(frame) {
    if (clock.playing) clock.toggle();
    clock.go(frame);
  },

  /** Start or stop playing. */
  toggle() {
    clock.playing = !clock.playing;
    clock.button.textContent = clock.playing ? "Pause" : "Play";
    if (clock.playing) clock.step(performance.now());
  },

  /** Show the next frame when it is time for it; a slow machine leaves frames out. */
  step(last) {
    requestAnimationFrame((now) => {
      if (!clock.playing) return;
      const passed = Math.min(Math.floor((clock.speed * (now - last)) / FRAME_MS), MOST_LEFT_OUT);
      if (passed > 0) clock.go((clock.frame + passed) % clock.frames);
      clock.step(passed > 0 ? now : last);
    });
  },

  /** Take the moments of a run; the moment shown stays, or the nearest one. */
  take() {
    const before = clock.frames ? clock.shownAt : 0;
    clock.frames = page.clock ? page.clock.time.length : 0;
    clock.bar.hidden = !clock.frames;
    if (!clock.frames) return;
    clock.slider.max = clock.frames - 1;
    clock.longest = 0;
    page.clock.time.forEach((t, k) => {
      clock.longest = Math.max(clock.longest, k ? t - page.clock.time[k - 1] : 0);
    });
    clock.frame = clock.nearest(before);
    clock.write();
  },

  /** Connect the controls of the page, where there are any. */
  start() {
    const bar = document.querySelector(".clock");
    if (!bar) return;
    clock.bar = bar;
    clock.slider = bar.querySelector("input");
    clock.output = bar.querySelector("output");
    clock.button = bar.querySelector("button[data-play]");
    clock.slider.addEventListener("input", () => clock.put(Number(clock.slider.value)));
    clock.button.addEventListener("click", clock.toggle);
    for (const one of bar.querySelectorAll("[data-step]")) {
      one.addEventListener("click", () => clock.put(clock.frame + Number(one.dataset.step)));
    }
    const speed = bar.querySelector("select");
    speed.addEventListener("change", () => (clock.speed = Number(speed.value)));
    clock.take();
  },
};
