// Sliders, boxes and lists for the keys of the case; those that matter most first, the others by search.

/** Time within which presses of a key on one slider are one gesture [ms]. */
const ONE_GESTURE = 1000;
/** Keys that a search shows at most. */
const MOST_FOUND = 12;

const gesture = { key: "", ended: -Infinity, before: null };

/** Make all controls anew. */
function makeControls() {
  pageState.controls = new Map(pageState.hello.controls.map((control) => [control.key, control]));
  const first = document.getElementById("first");
  first.replaceChildren(...pageState.hello.controls.filter((one) => one.first).map(controlOf));
  document.querySelector("#controls .others").replaceChildren();
  const boxes = [...first.children];
  fillList("turned", boxes.map((box) => [box.dataset.key, box.getAttribute("aria-label")]));
  if (boxes.length) bringForward(boxes[0]);
  find();
}

/** Have one of the first controls be that which a narrow page shows. */
function bringForward(box) {
  for (const one of document.querySelectorAll("#first .control")) one.classList.toggle("current", one === box);
  document.getElementById("turned").value = box.dataset.key;
}

/** Show the controls that the search asks for. */
function find() {
  findControls(document.getElementById("search").value, document.getElementById("all-keys").getAttribute("aria-pressed") === "true");
}

/** Connect the search. */
function startControls() {
  const all = document.getElementById("all-keys");
  document.getElementById("turned").addEventListener("change", (event) => bringForward(controlAt(event.target.value)));
  document.getElementById("search").addEventListener("input", find);
  all.addEventListener("click", () => {
    all.setAttribute("aria-pressed", String(all.getAttribute("aria-pressed") !== "true"));
    find();
  });
  pageState.on("requested", find);
}

/** Show the controls whose name or meaning holds some words, or all; and those that differ from the case. */
function findControls(text, all) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const others = pageState.hello.controls.filter((one) => !one.first);
  const fits = ({ key, label, meaning }) => words.every((word) => `${key} ${label} ${meaning}`.toLowerCase().includes(word));
  const found = words.length || all ? others.filter(fits) : [];
  const changed = others.filter(({ key }) => key in pageState.values);
  const shown = [...new Set([...changed, ...(all ? found : found.slice(0, MOST_FOUND))])];
  const place = document.querySelector("#controls .others");
  const there = [...place.children].map((one) => one.dataset.key).join();
  // A slider that is pressed speaks before it has the focus; anew it would not hear that it was let go.
  const used = gesture.before !== null || place.contains(document.activeElement);
  if (!used && there !== shown.map(({ key }) => key).join()) place.replaceChildren(...shown.map(controlOf));
  const more = found.length > MOST_FOUND && !all ? `, the first ${MOST_FOUND} are shown` : "";
  if (words.length && !used) place.firstElementChild?.scrollIntoView({ block: "nearest" });
  write(document.getElementById("found"), words.length ? `${found.length} of ${others.length} keys${more}` : "");
  fillControls();
}

/** Return the element of a control, none where it is not on the page. */
function controlAt(key) {
  return [...document.querySelectorAll(".control")].find((one) => one.dataset.key === key);
}

/** Make a control. */
function controlOf(control) {
  const { key, label, meaning, limits, source } = control;
  const id = `of-${key.replaceAll(".", "-")}`;
  const box = element("div", { class: "control", "data-key": key, role: "group", "aria-label": label });
  const name = element("label", { for: id, title: [meaning, limits, source].filter(Boolean).join(". ") });
  name.append(label[0].toUpperCase() + label.slice(1), " ", element("code", {}, ...breakable(key)));
  name.addEventListener("dblclick", () => giveBack(key));
  const fault = element("p", { class: "fault", id: `${id}-fault`, role: "alert", hidden: "" });
  const back = button("↺", () => giveBack(key), { class: "back", "aria-label": `${label}: back to the case's value`, title: "Back to the case's value" });
  const row = element("div", { class: "row" }, name, back, entryOf(control, id));
  const readout = element("p", { class: "readout", "aria-live": "polite", hidden: "" });
  const track = element("div", { class: "track" }, ...(control.least === null ? [] : trackOf(control)), ...sweepButton(control));
  box.append(row, track, readout, fault);
  return box;
}

/** Return a key that lines may break at its dots and underscores. */
function breakable(key) {
  return key.split(/(?<=[._])/).flatMap((part) => [part, element("wbr")]);
}

/** Return the box, list or switch of a control. */
function entryOf(control, id) {
  const { key, choices, kind } = control;
  if (choices.length || kind === "switch") {
    const texts = choices.length ? choices : ["true", "false"];
    const list = element("select", { id, class: "entry" }, ...texts.map((text) => element("option", {}, text)));
    list.addEventListener("change", () => pageState.gesture(pageState.changed(key, list.value)));
    return list;
  }
  const about = { id, class: "entry", type: "text", spellcheck: "false", autocomplete: "off" };
  const entry = element("input", { ...about, placeholder: control.example, "aria-describedby": `${id}-fault` });
  entry.addEventListener("change", () => typedIn(key, entry.value.trim()));
  // A run may have arrived while the box had the focus.
  entry.addEventListener("blur", fillControls);
  entry.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    entry.value = shownText(key);
    complain(key, "");
    entry.blur();
  });
  return entry;
}

/** Request a value as it was typed; what cannot be is refused by the server and said beside the box. */
function typedIn(key, typed) {
  complain(key, "");
  const text = typed || pageState.controls.get(key).text;
  const before = pageState.values;
  const values = pageState.changed(key, text);
  if (sameValues(values, before)) return fillControls();
  requests.typed.set(requests.number + 1, { key, text, before });
  return pageState.gesture(values);
}

/** Return the slider of a control, in a list, with room for the curve of a sweep in its track. */
function trackOf({ key, label, least, greatest, step, unit }) {
  const slider = element("input", { type: "range", min: least, max: greatest, step, "aria-label": label });
  const text = () => `${Number(Number(slider.value).toPrecision(12))} ${unit}`.trim();
  slider.addEventListener("input", () => {
    if (gesture.before === null) gesture.before = pageState.values;
    complain(key, "");
    pageState.request(pageState.changed(key, text()), false);
  });
  slider.addEventListener("change", () => {
    const now = performance.now();
    const goesOn = gesture.key === key && now - gesture.ended < ONE_GESTURE && pageState.past.length > 0;
    pageState.request(pageState.values, true);
    pageState.remember(goesOn ? pageState.past.pop() : gesture.before ?? pageState.values);
    Object.assign(gesture, { key, ended: now, before: null });
  });
  slider.addEventListener("focus", () => askSlope(key));
  const curve = element("canvas", { class: "curve", "aria-hidden": "true" });
  followSweep(curve, key);
  return [element("div", { class: "ground" }, curve, slider)];
}

/** Request the value of the case again. */
function giveBack(key) {
  complain(key, "");
  pageState.gesture(pageState.changed(key, pageState.controls.get(key).text));
  fillControls();
  // A double click on the name has put the focus into the box, which is else left as it is.
  const entry = controlAt(key)?.querySelector(".entry");
  if (entry) entry.value = shownText(key);
}

/** Write the requested values into the controls, and mark those that differ from the case. */
function fillControls() {
  for (const box of document.querySelectorAll(".control")) {
    const { key } = box.dataset;
    const control = pageState.controls.get(key);
    const changed = key in pageState.values;
    box.classList.toggle("changed", changed);
    box.querySelector(".back").disabled = !changed;
    const entry = box.querySelector(".entry");
    const kept = entry === document.activeElement || "refused" in box.dataset;
    if (!kept || entry.tagName === "SELECT") entry.value = shownText(key);
    const slider = box.querySelector("input[type=range]");
    if (slider) fillSlider(slider, control, pageState.text(key));
  }
  document.getElementById("undo").disabled = !pageState.past.length;
  document.getElementById("redo").disabled = !pageState.future.length;
}

/** Return the requested value of a key as it is shown: what follows from others as the run shown has it. */
function shownText(key) {
  return pageState.values[key] ?? pageState.shown?.follows[key] ?? pageState.controls.get(key).text;
}

/** Set a slider; a text in another unit leaves it where it is until the run says its number. */
function fillSlider(slider, control, text) {
  const [, value, unit] = /^([-+\d.eE]+)\s*(.*)$/.exec(text) ?? [];
  const own = value !== undefined && plain(unit) === plain(control.unit);
  if (own && Number(slider.value) !== Number(value)) slider.value = value;
  slider.setAttribute("aria-valuetext", shownText(control.key));
}

/** Say beside the box of a key what a request found wrong with it; return whether there is such a box. */
function complain(key, text, number = requests.number) {
  const box = key && controlAt(key);
  if (!box) return false;
  box.dataset.faultOf = number;
  delete box.dataset.refused;
  const fault = box.querySelector(".fault");
  write(fault, text);
  fault.hidden = !text;
  box.querySelector(".entry").setAttribute("aria-invalid", String(Boolean(text)));
  return true;
}

/** Leave in the box of a key what was typed there, until something is run. */
function keepText(key) {
  const box = controlAt(key);
  if (box) box.dataset.refused = "";
  fillControls();
  box?.querySelector(".entry").focus();
}

/** Take back what earlier requests found wrong, and texts that they refused: every box shows what was run. */
function forgive(number) {
  for (const box of document.querySelectorAll(".control[data-fault-of]")) {
    if (Number(box.dataset.faultOf) <= number) complain(box.dataset.key, "", number);
  }
}
