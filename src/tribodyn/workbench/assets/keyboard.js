// Everything by keyboard; `?` lists it.

const KEYS = [
  { keys: ["?"], does: "these keys", act: () => document.getElementById("keys").showModal() },
  { keys: ["p"], does: "pin the run, or let it go", act: () => togglePin() },
  { keys: ["u", "Ctrl+z"], does: "undo", act: () => pageState.undo() },
  { keys: ["r", "Ctrl+y", "Ctrl+Z"], does: "redo", act: () => pageState.redo() },
  { keys: ["Escape"], does: "stop the run that is waited for", act: () => requests.stop() },
  { keys: ["c"], does: "copy or save the run", act: () => openAway() },
  { keys: ["m"], does: "start from a template, add or remove parts", act: () => model.open() },
  { keys: ["/"], does: "search any key", act: () => document.getElementById("search").focus() },
  { keys: ["1"], shown: "1 … 8", does: "go to a slider", act: () => focusControl(0) },
  ...[2, 3, 4, 5, 6, 7, 8].map((n) => ({ keys: [String(n)], act: () => focusControl(n - 1) })),
  { keys: ["s"], does: "sweep the key in focus, or stop it", act: () => onFocused(toggleSweep) },
  { keys: ["["], does: "to the point of the sweep before", act: () => onFocused((key) => stepPoint(key, -1)) },
  { keys: ["]"], does: "to the next point of the sweep", act: () => onFocused((key) => stepPoint(key, 1)) },
  { keys: ["b"], does: "the key in focus back to the case's value", act: () => onFocused(giveBack) },
  { keys: ["n"], does: "go to the numbers", act: () => document.querySelector(".live-numbers button")?.focus() },
  { keys: ["v"], does: "go to the pictures", act: () => document.querySelector("#views .plot")?.focus() },
  { keys: [" "], shown: "Space", does: "play, pause", act: () => clock.frames && clock.toggle() },
  { keys: [","], does: "one step back in time", act: () => clock.frames && clock.go(clock.frame - 1) },
  { keys: ["."], does: "one step on", act: () => clock.frames && clock.go(clock.frame + 1) },
];
const ELSEWHERE = [
  ["a slider", "← →", "one step; Page Up, Page Down ten; Home, End to the ends"],
  ["a box of text", "Enter, Escape", "take what is typed, leave it"],
  ["a curve", "+ − ← → 0", "zoom, move, the whole"],
  ["the mechanism", "← → ↑ ↓ + −", "turn it, nearer, away"],
  ["a map", "← → ↑ ↓", "read it point by point"],
];

/** Put the focus on one of the first controls. */
function focusControl(n) {
  const box = document.querySelectorAll("#first .control")[n];
  if (box) bringForward(box);
  (box?.querySelector("input[type=range]") ?? box?.querySelector(".entry"))?.focus();
}

/** Do something with the key whose control has the focus. */
function onFocused(action) {
  const key = document.activeElement?.closest(".control")?.dataset.key;
  if (key) action(key);
}

/** Tell whether a place takes letters itself. */
function takesText(place) {
  return place.matches("input:not([type=range]), textarea, select");
}

/** Listen to the keys of the page, and list them. */
function startKeyboard() {
  addEventListener("keydown", (event) => {
    if (event.altKey || event.metaKey || takesText(event.target) || document.querySelector("dialog[open]")) return;
    if (event.key === " " && event.target.matches("button, summary, a")) return;
    const pressed = event.ctrlKey ? `Ctrl+${event.key}` : event.key;
    const found = KEYS.find(({ keys }) => keys.includes(pressed) || keys.includes(pressed.toLowerCase()));
    if (!found) return;
    event.preventDefault();
    found.act();
  });
  const rows = KEYS.filter(({ does }) => does).map(({ keys, shown, does }) => ["anywhere", shown ?? keys.join(", "), does]);
  const table = document.querySelector("#keys tbody");
  for (const [where, keys, does] of [...rows, ...ELSEWHERE]) {
    table.append(element("tr", {}, element("th", { scope: "row" }, where), element("td", {}, keys), element("td", {}, does)));
  }
}
