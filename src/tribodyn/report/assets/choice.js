// One of several figures of the same kind; which one, a reader chooses.

widgets.choice = (box, data) => {
  const holder = element("div", {});
  const options = data.names.map((name, k) => element("option", { value: k }, name));
  const select = element("select", {}, ...options);
  let inner = null;
  const make = () => {
    holder.replaceChildren();
    inner = widgets[data.widget](holder, data.parts[Number(select.value)]);
  };
  select.addEventListener("change", () => {
    make();
    inner.paint();
    if (inner.show && clock.frames) inner.show(clock.frame);
  });
  const label = data.label[0].toUpperCase() + data.label.slice(1);
  if (data.names.length > 1) tools(box, element("label", { class: "chooser" }, label, select));
  else tools(box, element("span", { class: "key" }, `${label}: ${data.names[0]}`));
  box.append(holder);
  make();
  return { paint: () => inner.paint(), show: (frame) => inner.show && inner.show(frame) };
};
