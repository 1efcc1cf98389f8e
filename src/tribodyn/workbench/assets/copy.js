// A run to take away: as a command, as Python, as files.

/** Open what can be taken away of the run that is shown. */
function openAway() {
  const { shown } = pageState;
  if (!shown) return;
  const dialog = document.getElementById("away");
  const links = pageState.hello.downloads.map((name) =>
    element("a", { href: `/download/${name}?run=${shown.run}&secret=${secret.now()}`, download: name }, name),
  );
  dialog.querySelector("div").replaceChildren(
    element("p", { class: "lead" }, valuesInWords(shown.values)),
    copyPart("As a command", shown.command),
    copyPart("In Python", shown.python),
    copyPart("Address of this page with these values", location.href),
    element("h3", {}, "Save"),
    element("p", { class: "facts" }, ...links),
  );
  dialog.showModal();
}

/** Return a text with a button that copies it. */
function copyPart(title, text) {
  const code = element("pre", { tabindex: "0" }, element("code", {}, text));
  const copy = button("Copy", async () => {
    copy.textContent = (await copied(text)) ? "Copied" : "Selected: press Ctrl+C";
    if (copy.textContent !== "Copied") getSelection().selectAllChildren(code);
  });
  return element("div", {}, element("h3", {}, title), code, copy);
}

/** Copy a text; return whether the browser let it be. */
async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
