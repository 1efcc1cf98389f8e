// One of several figures of the same kind; which one, a reader chooses.

widgets.choice = (box) => {
  const holder = element("div", {});
  const select = element("select", {});
  const label = element("span", {});
  const chooser = element("label", { class: "chooser" }, label, select);
  const state = { inner: null, data: null, ghosts: [] };
  tools(box, chooser);
  box.append(holder);

  const part = (data) => data.parts[data.names.indexOf(select.value)];
  const give = () => {
    const ghosts = state.ghosts.map((one) => ({ ...one, data: part(one.data) }));
    state.inner.take(part(state.data), ghosts.filter((one) => one.data));
  };
  const make = () => {
    holder.replaceChildren();
    state.inner = widgets[state.data.widget](holder);
    give();
  };
  select.addEventListener("change", () => {
    make();
    state.inner.paint();
    if (clock.frames) state.inner.show?.(clock.frame);
  });
  const take = (data, ghosts) => {
    Object.assign(state, { data, ghosts });
    const names = data.names.join("\n");
    if (names === state.named) return give();
    state.named = names;
    label.textContent = data.label[0].toUpperCase() + data.label.slice(1);
    const before = select.value;
    select.replaceChildren(...data.names.map((name) => element("option", { value: name }, name)));
    select.value = data.names.includes(before) ? before : data.names[0];
    select.disabled = data.names.length < 2;
    return make();
  };
  return { take, paint: () => state.inner.paint(), show: (frame) => state.inner.show?.(frame) };
};
