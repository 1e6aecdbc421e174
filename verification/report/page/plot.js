// SPDX-License-Identifier: MIT
// Interactive plots: the panels of a figure drawn again by Chart.js, one legend for all panels whose entries switch
// curves off, axes that turn from logarithmic to linear, values beside the pointer.
"use strict";
(() => {
  const style = plot_style, AHEAD = 600; // pixels below the window

  // A curve without a label is a guide: not in the legend, and the pointer passes it by.
  const dataset = (curve, panel, index) => {
    const { x, y } = panel;
    const points = curve.across === "x" ? y.range.map((value) => ({ x: curve.at, y: value }))
      : curve.across === "y" ? x.range.map((value) => ({ x: value, y: curve.at }))
        : curve.points.map(([a, b]) => ({ x: a, y: b }));
    const colour = style.colour(curve.colour || "#888888");
    const shown = curve.shown ? new Set(curve.shown) : null;
    const radius = curve.label && curve.marker ? points.map((_, i) => !shown || shown.has(i) ? 4 : 0) : 0;
    return { curve, label: curve.label || "", data: points, borderColor: colour, showLine: !!(curve.dash || curve.across),
      borderDash: curve.across ? [2, 3] : curve.dash || [], borderWidth: curve.fill ? 0 : Math.max(1.2, curve.width || 1),
      backgroundColor: curve.fill ? colour + "8c" : colour, fill: curve.fill ? "start" : false,
      pointStyle: style.MARKS[curve.marker] || "circle", rotation: style.TURNED[curve.marker] || 0, pointRadius: radius,
      pointHoverRadius: curve.label ? 6 : 0, pointHitRadius: curve.label && !curve.fill ? 8 : 0,
      pointBackgroundColor: curve.hollow ? (style.is_dark() ? "#14171a" : "#ffffff") : colour,
      pointBorderColor: curve.hollow ? colour : (style.is_dark() ? "#14171a" : "#ffffff"),
      pointBorderWidth: curve.hollow ? 1.4 : 0.6, clip: 8,
      order: curve.fill ? 2 : curve.label ? -index : 1 };  // the last one on top, as in the picture
  };

  const axis = (description, is_log) => ({
    type: is_log ? "logarithmic" : "linear", min: is_log || !description.log ? description.range[0] : 0, max: description.range[1],
    title: { display: true, text: style.lines(description.label), color: style.ink(), font: { size: 12 } },
    grid: { color: style.faint(), borderColor: style.ink() },
    ticks: { includeBounds: false, color: style.ink(), font: { size: 11 }, autoSkip: !is_log, maxRotation: 0,
      callback(value) {
        const is_power = (v) => Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-9;
        const long = (this.min < 2e-3 || this.max > 2e4) && this.ticks.every((tick) => is_power(tick.value));
        if (is_log) return long ? style.power(Math.round(Math.log10(value))) : style.number(value);
        return style.linear_tick(value, this.ticks.map((tick) => tick.value));
      } },
    afterBuildTicks: (scale) => {
      const told = (description.ticks || []).filter((value) => value >= scale.min && value <= scale.max);
      if (is_log) scale.ticks = (told.length > 1 ? told : style.log_ticks(scale.min, scale.max)).map((value) => ({ value }));
    } });

  // What stands beside the pointer: the curve, then each quantity with its unit.
  const lines = (item, panel) => {
    const { curve } = item.dataset, words = [curve.note ? `${curve.label} (${curve.note})` : curve.label];
    for (const key of ["x", "y"]) {
      const [name, unit] = style.quantity(panel[key].label);
      const value = key === "y" && (curve.note || "").startsWith("zero") ? "0 to round-off" : `${style.number(item.parsed[key])} ${unit}`;
      words.push(`${name}: ${value}`);
    }
    return words;
  };

  // Words that stand at a point of the picture: the number of a slope, the size of a mesh.
  const words = (panel) => ({ id: "words", afterDatasetsDraw({ ctx, scales, chartArea }) {
    ctx.save();
    ctx.font = "11px sans-serif";
    for (const { text, at, shift, side, colour } of panel.words || []) {
      const x = scales.x.getPixelForValue(at[0]), y = scales.y.getPixelForValue(at[1]);
      if (!(x >= chartArea.left && x <= chartArea.right && y >= chartArea.top && y <= chartArea.bottom)) continue;
      ctx.fillStyle = style.colour(colour);
      ctx.textAlign = side[0];
      ctx.textBaseline = { center: "middle", baseline: "alphabetic", center_baseline: "middle" }[side[1]] || side[1];
      ctx.fillText(text, x + 1.33 * shift[0], y - 1.33 * shift[1]);
    }
    ctx.restore();
  } });

  const draw = (canvas, panel, logs, hidden) => new Chart(canvas, {
    type: "scatter", plugins: [words(panel)],
    data: { datasets: panel.curves.map((curve, i) => ({ ...dataset(curve, panel, i), hidden: !!curve.label && hidden.has(curve.label) })) },
    options: { responsive: true, maintainAspectRatio: false, animation: false, devicePixelRatio: Math.max(2, devicePixelRatio),
      interaction: { mode: "nearest", intersect: false, axis: "xy" },
      scales: { x: axis(panel.x, panel.x.log && logs.x), y: axis(panel.y, panel.y.log && logs.y) },
      plugins: { legend: { display: false },
        title: { display: !!panel.title, text: panel.title, align: "start", color: style.ink(), font: { size: 12.5 } },
        tooltip: { displayColors: false, callbacks: { title: () => "", label: (item) => lines(item, panel) },
          filter: (item, index) => index === 0 && !!item.dataset.label && !item.dataset.curve.fill
            && (!item.dataset.curve.shown || item.dataset.curve.shown.includes(item.dataIndex)) } } } });

  const make = (figure, data) => {
    const panels = JSON.parse(data.textContent), logs = { x: true, y: true }, hidden = new Set(), charts = new Map();
    const box = document.createElement("div"), keys = document.createElement("div"), grid = document.createElement("div");
    box.className = "plot"; keys.className = "keys"; grid.className = "panels";
    box.append(keys, grid);
    const canvases = panels.map((panel) => {
      const place = document.createElement("div"), canvas = document.createElement("canvas");
      place.className = "panel";
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `${panel.title}: ${panel.y.label} against ${panel.x.label}`);
      place.append(canvas);
      grid.append(place);
      return canvas;
    });
    const redraw = () => charts.forEach((chart, i) => { chart.destroy(); charts.set(i, draw(canvases[i], panels[i], logs, hidden)); });

    const legend = () => {
      keys.replaceChildren();
      const curves = new Map();
      panels.forEach((panel) => panel.curves.forEach((c) => c.label && !curves.has(c.label) && curves.set(c.label, c)));
      curves.forEach((curve, label) => {
        const key = document.createElement("button");
        key.innerHTML = style.sample(curve);
        key.append(label);
        key.setAttribute("aria-pressed", String(!hidden.has(label)));
        key.onclick = () => {
          hidden.has(label) ? hidden.delete(label) : hidden.add(label);
          key.setAttribute("aria-pressed", String(!hidden.has(label)));
          charts.forEach((chart) => {
            chart.data.datasets.forEach((one) => { if (one.label === label) one.hidden = hidden.has(label); });
            chart.update("none");
          });
        };
        keys.append(key);
      });
      for (const name of ["x", "y"]) {
        if (!panels.some((panel) => panel[name].log)) continue;
        const key = document.createElement("button");
        key.className = "axis";
        key.textContent = `${name} axis: ${logs[name] ? "log" : "linear"}`;
        key.onclick = () => { logs[name] = !logs[name]; legend(); redraw(); };
        keys.append(key);
      }
    };
    legend();
    figure.insertBefore(box, figure.querySelector("figcaption"));
    figure.classList.add("live");
    // A panel is drawn when it comes near: a page may have a hundred.
    const draw_once = (i) => { if (!charts.has(i)) charts.set(i, draw(canvases[i], panels[i], logs, hidden)); };
    const watch = new IntersectionObserver((entries) => entries.forEach((entry) => {
      if (entry.isIntersecting) draw_once(canvases.indexOf(entry.target.firstChild));
    }), { rootMargin: `${AHEAD}px` });
    addEventListener("theme", () => { legend(); redraw(); });
    return () => canvases.forEach((canvas, i) => {
      if (canvas.getBoundingClientRect().top < innerHeight + AHEAD) draw_once(i);
      watch.observe(canvas.parentNode);
    });
  };

  const start = () => {
    const begin = [];
    for (const data of document.querySelectorAll("script.plot-data")) {
      const figure = data.closest("figure");
      try {
        begin.push(make(figure, data));
      } catch (error) {  // the picture is still there
        figure.classList.remove("live");
        figure.querySelector(".plot")?.remove();
        console.error(error);
      }
    }
    begin.forEach((draw_near) => draw_near());  // when all have their places
  };
  start();
})();
