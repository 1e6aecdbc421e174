// SPDX-License-Identifier: MIT
// The cloth of a figure in space: coarse, up-sampled or reference, coloured by error or phase, through time where
// frames are stored, with the difference from the reference exaggerated on request.
"use strict";
(() => {
  // The arrays of a view: 16 bits each, differences of neighbours, deflated.
  const unpack = async (view) => {
    const bytes = Uint8Array.from(atob(view.data), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    const raw = new DataView(await new Response(stream).arrayBuffer()), arrays = {};
    let at = 0;
    for (const { name, shape, offset, scale, whole } of view.arrays) {
      const parts = shape.length > 1 ? shape.at(-1) : 1, size = shape.reduce((a, b) => a * b, 1), n = size / parts;
      const values = whole ? new Uint16Array(size) : new Float32Array(size);
      let integer = 0;
      for (let part = 0; part < parts; ++part)
        for (let i = 0; i < n; ++i, at += 2) {
          integer = (integer + raw.getUint16(at, true)) & 65535;
          values[i * parts + part] = whole ? integer : offset + scale * (integer << 16 >> 16);
        }
      arrays[name] = { values, shape };
    }
    return arrays;
  };

  const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
  const PLAIN = rgb("#9db8d2"), COARSE = rgb("#e3c18a");
  const element = (name, text, attributes = {}) => {
    const one = Object.assign(document.createElement(name), attributes);
    if (text) one.append(text);
    return one;
  };

  class View {
    constructor(description, arrays) {
      Object.assign(this, { description, arrays });
      const [frames, n, parts] = arrays.upsampled.shape;
      Object.assign(this, { frames, n, parts, frame: frames - 1, factor: 1, height: false, shown: "upsampled",
        colour: description.error ? "error" : "phase", mesh: false });
    }

    frame_of(name) {
      const { values, shape } = this.arrays[name], size = shape[1] * shape[2];
      return values.subarray(this.frame * size, (this.frame + 1) * size);
    }

    // Length of up-sampled minus reference at each vertex [m].
    errors() {
      if (!this.arrays.difference) return null;
      const d = this.frame_of("difference"), parts = this.parts;
      return Float32Array.from({ length: this.n }, (_, i) => Math.hypot(...d.subarray(i * parts, (i + 1) * parts)));
    }

    in_space(values, n, lift) {
      const points = new Float32Array(3 * n), parts = this.parts;
      for (let i = 0; i < n; ++i) {
        for (let k = 0; k < parts; ++k) points[3 * i + k] = values[i * parts + k];
        if (lift) points[3 * i + 2] += lift(i);
      }
      return points;
    }

    // Fine vertices as shown: reference + factor * (up-sampled - reference), or the reference alone.
    fine_points(errors) {
      const up = this.frame_of("upsampled"), d = this.arrays.difference && this.frame_of("difference");
      const more = !d ? 0 : this.shown === "reference" ? -1 : this.factor - 1;
      const values = more ? up.map((value, i) => value + more * d[i]) : up;
      const top = this.height && errors ? 0.15 * this.extent / (this.description.error.largest || 1) : 0;
      return this.in_space(values, this.n, top ? (i) => top * Math.min(errors[i], 1.5 * this.description.error.largest) : null);
    }

    error_colour(errors) {
      const { largest, colours } = this.description.error, scale = colours.map(rgb);
      return (vertex) => {
        const place = Math.min(1, errors[vertex] / (largest || 1)) * (scale.length - 1), i = Math.min(scale.length - 2, Math.floor(place));
        return scale[i].map((value, k) => value + (place - i) * (scale[i + 1][k] - value));
      };
    }

    show(scene) {
      const errors = this.errors(), has_coarse = !!this.arrays.coarse;
      const coarse = has_coarse && this.in_space(this.frame_of("coarse"), this.arrays.coarse.shape[1], null);
      if (this.shown === "coarse") {
        scene.surface(coarse, this.arrays.coarse_triangles.values, () => COARSE);
      } else {
        const by_error = this.colour === "error" && errors && this.error_colour(errors);
        const palette = this.description.phases.map(rgb), phase = this.arrays.phase?.values;
        const colour = by_error ? (_, vertex) => by_error(vertex)
          : this.colour === "phase" && phase ? (triangle) => palette[phase[triangle]] : () => PLAIN;
        scene.surface(this.fine_points(errors), this.arrays.triangles.values, colour);
      }
      scene.contrast = this.colour === "error" && this.shown !== "coarse" ? 0.45 : 1;
      const lines = has_coarse && (this.mesh || this.shown === "coarse");
      scene.edges(lines ? coarse : null, lines ? this.arrays.coarse_triangles.values : []);
      scene.draw();
    }

    // The camera sees all frames.
    bounds() {
      const low = [0, 0, 0], high = [0, 0, 0], { values } = this.arrays.upsampled, parts = this.parts;
      for (let k = 0; k < parts; ++k) {
        low[k] = Infinity; high[k] = -Infinity;
        for (let i = k; i < values.length; i += parts) { low[k] = Math.min(low[k], values[i]); high[k] = Math.max(high[k], values[i]); }
      }
      this.extent = Math.max(...low.map((value, k) => high[k] - value));
      return [low, high];
    }
  }

  const choices = (label, options, value, act) => {
    const select = element("select");
    for (const [key, text] of options) select.append(element("option", text, { value: key, selected: key === value }));
    select.onchange = () => act(select.value);
    const box = element("label", label);
    box.append(select);
    return box;
  };

  const slider = (low, high, step, value, words, act) => {
    const input = element("input", "", { type: "range", min: low, max: high, step, value }), text = element("span", words(value));
    input.value = value;
    input.oninput = () => { act(Number(input.value)); text.textContent = words(Number(input.value)); };
    const box = element("label");
    box.append(input, text);
    input.setAttribute("aria-label", words(value));
    return box;
  };

  const box_of = (text, act) => {
    const input = element("input", "", { type: "checkbox" });
    input.onchange = () => act(input.checked);
    const box = element("label");
    box.append(input, text);
    return box;
  };

  const controls = (view, redraw, reset) => {
    const keys = element("div", "", { className: "keys" }), { description, arrays } = view;
    const set = (name) => (value) => { view[name] = value; redraw(); };
    const surfaces = [["upsampled", "up-sampled"]];
    if (arrays.difference) surfaces.push(["reference", "reference"]);
    if (arrays.coarse) surfaces.push(["coarse", "coarse cloth"]);
    keys.append(choices("show", surfaces, view.shown, set("shown")));
    const colours = [];
    if (description.error) colours.push(["error", "error"]);
    if (description.phases.length) colours.push(["phase", "phases"]);
    colours.push(["plain", "none"]);
    keys.append(choices("colours", colours, view.colour, set("colour")));
    if (view.frames > 1)
      keys.append(slider(0, view.frames - 1, 1, view.frame, (i) => `time ${Number(description.times[i].toPrecision(4))} s`, set("frame")));
    if (arrays.difference) {
      const most = Math.min(6, Math.max(1, Math.log10(0.1 * view.extent / (description.error.largest || 1)))); // a tenth of the cloth
      const words = (x) => `up-sampled − reference × ${Number((10 ** x).toPrecision(2))}${x > 0 ? " (exaggerated)" : " (true)"}`;
      keys.append(slider(0, most, "any", 0, words, (x) => set("factor")(10 ** x)));
    }
    if (arrays.coarse) keys.append(box_of("coarse mesh", set("mesh")));
    if (view.parts === 2 && description.error) keys.append(box_of("error as height (not to scale)", set("height")));
    const home = element("button", "reset view", { type: "button", onclick: reset });
    keys.append(home);
    if (description.error) {
      const { largest, factor, unit, colours: hues } = description.error;
      const bar = element("span", "", { className: "bar" });
      bar.style.background = `linear-gradient(to right, ${hues.join(",")})`;
      const legend = element("label", "error 0");
      legend.append(bar, `${Number((factor * largest).toPrecision(3))} ${unit} (99.5th percentile)`);
      keys.append(legend);
    }
    return keys;
  };

  // A bar of 1, 2 or 5 times a power of ten, some hundred pixels long; the projection is parallel, it holds everywhere.
  const scale_bar = (bar, pixels) => {
    const most = 140 / pixels, power = 10 ** Math.floor(Math.log10(most));
    const length = power * [5, 2, 1].find((factor) => factor * power <= most);
    const [factor, unit] = length >= 1 ? [1, "m"] : length >= 0.01 ? [100, "cm"] : length >= 1e-3 ? [1e3, "mm"] : [1e6, "µm"];
    bar.style.width = `${length * pixels}px`;
    bar.textContent = `${Number((factor * length).toPrecision(3))} ${unit}`;
  };

  let open = null; // browsers hold a few drawing contexts only: one view at a time
  const show = async (figure, button) => {
    open?.();
    const description = JSON.parse(figure.querySelector("script.view-data").textContent);
    const box = element("div", "", { className: "view" });
    figure.insertBefore(box, figure.querySelector("figcaption"));
    open = () => { box.remove(); button.hidden = false; open = null; };
    try {
      const view = new View(description, await unpack(description)), canvas = element("canvas");
      canvas.setAttribute("aria-label", "cloth in space: drag to turn, two fingers or wheel to zoom, shift and drag to move");
      const scene_box = element("div", "", { className: "stage" }), scale = element("span", "", { className: "scale" });
      scene_box.append(canvas, scale);
      box.append(scene_box);
      const scene = new ViewScene(canvas);
      scene.on_draw = (pixels) => scale_bar(scale, pixels);
      scene.look_at(...view.bounds());
      scene.home = { yaw: 0, pitch: view.parts === 2 ? -0.35 : -1.22, zoom: view.parts === 2 ? 1.2 : 1, shift: [0, 0] };
      scene.reset();
      const redraw = () => view.show(scene);
      box.prepend(controls(view, redraw, () => { scene.reset(); scene.draw(); }));
      box.append(element("p", `${view.n.toLocaleString("en")} of ${description.of.toLocaleString("en")} vertices, each at its own place. `
        + "Drag to turn; wheel or two fingers to zoom; shift and drag to move.", { className: "subtitle" }));
      redraw();
      button.hidden = true;
      box.dataset.ready = String(scene.corners);
    } catch (error) { // the picture is still there
      box.replaceChildren(element("p", `Not shown in space: ${error.message}.`, { className: "left-out" }));
    }
  };

  const figures = [...document.querySelectorAll("script.view-data")].map((data) => data.closest("figure"));
  const buttons = figures.map((figure) => {
    const button = element("button", "View in 3D", { type: "button" });
    button.onclick = () => show(figure, button);
    figure.insertBefore(button, figure.querySelector("figcaption"));
    return button;
  });
  const asked = Number(new URLSearchParams(location.search).get("view")); // ?view=1 opens the first
  if (figures[asked - 1]) {
    for (let fold = figures[asked - 1].closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
    show(figures[asked - 1], buttons[asked - 1]);
  }
})();
