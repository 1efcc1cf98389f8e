// The model: start from a template, add and remove parts, save it as a file.

const model = {
  /** The edit that is waited for: its request, and the values before it. */
  pending: null,

  /** Open the dialog. */
  open() {
    if (!pageState.hello) return;
    model.fill();
    document.getElementById("edit").showModal();
  },

  /** Write what can be edited of the model that the page is made for. */
  fill() {
    const { templates, removable, addable } = pageState.hello;
    const named = Object.entries(templates).map(([name, title]) => [name, `${name}: ${title}`]);
    fillList("template", [["", "the case that the workbench was started with"], ...named]);
    document.getElementById("template").value = model.edit().template;
    fillList("removed", removable.map((table) => [table, `[${table}]`]));
    fillList("kind", addable.map(({ table }) => [table, `[${table.replace("*", "NAME")}]`]));
    document.getElementById("remove-part").hidden = !removable.length;
    document.getElementById("add-part").hidden = !addable.length;
    model.ask();
    model.fault("");
    model.offer();
  },

  /** Offer the file of the run that is shown, or of the model before it is run. */
  offer() {
    const run = pageState.shown?.run ?? pageState.hello.run;
    document.getElementById("save-model").href = `/download/case.toml?run=${run}&secret=${secret.now()}`;
  },

  /** Return the edit that is requested. */
  edit() {
    return parted(pageState.values).edit;
  },

  /** Make the form of the kind of part that is chosen. */
  ask() {
    const chosen = model.chosen();
    const form = document.getElementById("fields");
    form.replaceChildren(...(chosen ? [nameField(chosen), ...chosen.fields.map(partField)] : []));
  },

  chosen() {
    const table = document.getElementById("kind").value;
    return pageState.hello.addable.find((one) => one.table === table);
  },

  /** Start from a template, or from the case of the workbench. */
  start() {
    model.request({}, { ...NO_EDIT, template: document.getElementById("template").value });
  },

  /** Leave out a part. */
  remove() {
    const table = document.getElementById("removed").value;
    const inside = (path) => `${path}.`.startsWith(`${table}.`);
    const { template, removed, added } = model.edit();
    const { values } = parted(pageState.values);
    model.request(without(values, inside), { template, removed: [...new Set([...removed, table])], added: without(added, inside) });
  },

  /** Add a part as the form describes it. */
  add() {
    const { table, fields } = model.chosen();
    const name = document.getElementById("part-name").value.trim();
    const path = table.replace("*", name);
    if (!name) return model.fault("A name is needed, such as wrist.");
    if (pageState.hello.removable.includes(path)) return model.fault(`[${path}] exists already; allowed: a new name.`);
    const { template, removed, added } = model.edit();
    const given = fields.map((field) => [`${path}.${field.name}`, fieldText(field)]).filter(([, text]) => text);
    return model.request(parted(pageState.values).values, { template, removed, added: { ...added, ...Object.fromEntries(given) } });
  },

  /** Request an edited model. */
  request(values, edit) {
    const before = pageState.values;
    const text = editText(edit);
    model.fault("");
    if (text === (before[EDIT] ?? "")) return document.getElementById("edit").close();
    pageState.gesture(text ? { ...values, [EDIT]: text } : values);
    model.pending = { number: requests.number, before };
    return undefined;
  },

  /** The model is accepted: the page is made for it. */
  arrived() {
    model.pending = null;
    if (document.getElementById("edit").open) document.getElementById("edit").close();
  },

  /** Take back an edit that cannot be, and say why; return whether the request was one. */
  refused(mine, faults, message) {
    if (!model.pending || model.pending.number !== mine) return false;
    const { before } = model.pending;
    model.pending = null;
    requests.forget(before);
    model.fault(faults.map(({ key, message: text }) => (key ? `${key}: ${text}` : text)).join("\n") || message);
    return true;
  },

  fault(text) {
    const place = document.getElementById("edit-fault");
    write(place, text);
    place.hidden = !text;
  },

  /** Connect the dialog. */
  connect() {
    for (const [id, act] of Object.entries({ "start-model": model.start, "remove-model": model.remove, "add-model": model.add })) {
      document.getElementById(id).addEventListener("click", act);
    }
    document.getElementById("kind").addEventListener("change", model.ask);
  },
};

/** Return values without those whose key is inside a table. */
function without(values, inside) {
  return Object.fromEntries(Object.entries(values).filter(([key]) => !inside(key)));
}

/** Fill a list with values and what they are called. */
function fillList(id, options) {
  document.getElementById(id).replaceChildren(...options.map(([value, text]) => element("option", { value }, text)));
}

/** Return the field of a part's name, or of the part that it belongs to. */
function nameField({ parents }) {
  if (!parents) return labelled("name", element("input", { id: "part-name", class: "entry", autocomplete: "off", spellcheck: "false" }));
  return labelled("of", element("select", { id: "part-name", class: "entry" }, ...parents.map((name) => element("option", {}, name))));
}

/** Return the field of a key. */
function partField({ name, label, meaning, choices, known, many, example }) {
  const options = choices.length ? choices : known;
  const about = { class: "entry", "data-field": name, "aria-label": label, title: meaning };
  const list = () => element("select", about, ...["", ...options].map((text) => element("option", {}, text)));
  const box = () => element("input", { ...about, placeholder: example, autocomplete: "off", spellcheck: "false" });
  return labelled(label, ...(options.length ? Array.from({ length: many }, list) : [box()]));
}

function labelled(label, ...entries) {
  return element("div", { class: "row" }, element("label", entries[0].id ? { for: entries[0].id } : {}, label), ...entries);
}

/** Return what was entered for a key, empty if nothing was. */
function fieldText({ name }) {
  const entries = [...document.querySelectorAll(`#fields [data-field="${name}"]`)].map((entry) => entry.value.trim());
  return entries.some(Boolean) ? entries.join(", ") : "";
}
