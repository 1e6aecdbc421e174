// SPDX-License-Identifier: MIT
// What a reader does with a page, for the tests: it runs beside a frame that holds the page, and sends what came of it.
when((page) => page.querySelector(".view[data-ready]") && page.querySelector("#stripes-error-strain .plot"), (page, their) => {
  const found = { faults: [] };
  their.onerror = (message) => { found.faults.push(message); };
  const event = (target, kind, more = {}) => target.dispatchEvent(Object.assign(new their.Event(kind, { bubbles: true }), more));
  try {
    const view = page.querySelector(".view");
    for (const select of view.querySelectorAll("select"))
      for (const option of [...select.options].reverse()) { select.value = option.value; event(select, "change"); }
    for (const box of view.querySelectorAll("input[type=checkbox]")) box.click();
    found.sliders = [...view.querySelectorAll("input[type=range]")].map((slider) => {
      slider.value = 1;
      event(slider, "input");
      return slider.nextSibling.textContent;
    });
    for (const key of ["ArrowUp", "ArrowLeft", "+"]) event(view.querySelector("canvas"), "keydown", { key });

    const plot = page.querySelector("#stripes-error-strain .plot"), canvas = plot.querySelectorAll("canvas")[1];
    const keys = () => [...plot.querySelectorAll(".keys button")], chart = () => their.Chart.getChart(canvas);
    keys()[0].click();
    keys().at(-1).click();
    found.hidden = chart().data.datasets.filter((one) => one.hidden).map((one) => one.label);
    found.axis = chart().scales.y.type;
    keys().at(-1).click();
    keys()[0].click();
    const box = canvas.getBoundingClientRect(), index = chart().data.datasets.findIndex((one) => one.label.startsWith("localized"));
    const point = chart().getDatasetMeta(index).data[1];
    canvas.dispatchEvent(new their.MouseEvent("mousemove", { bubbles: true, clientX: box.left + point.x, clientY: box.top + point.y }));
    const has_tooltip = () => chart().tooltip.body?.length > 0;
    when(has_tooltip, () => {
      found.beside_the_pointer = chart().tooltip.body.flatMap((part) => part.lines);
      const link = page.querySelector('#stripes-error-strain .downloads a[href$=".csv"]');
      link.addEventListener("click", (click) => click.preventDefault());
      link.click();
      their.fetch(link.href).then((answer) => answer.text()).then((text) => { found.csv = text; send(found); });
    });
  } catch (error) {
    found.faults.push(error.stack);
    send(found);
  }
});
