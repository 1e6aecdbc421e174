// SPDX-License-Identifier: MIT
// How an interactive plot looks: colours on dark ground, marks, numbers at the axes and beside the pointer.
"use strict";
const plot_style = (() => {
  // The palette of Okabe and Ito, lighter where a colour would drown in a dark page; their order in lightness stays.
  const ON_DARK = { "#000000": "#eeeeee", "#222222": "#dddddd", "#444444": "#c4c4c4", "#555555": "#bbbbbb", "#666666": "#b0b0b0",
    "#6b6b6b": "#a6a6a6", "#777777": "#a6a6a6", "#888888": "#9a9a9a", "#0072b2": "#4b9fe0", "#56b4e9": "#a5daf8",
    "#009e73": "#23bd92", "#d55e00": "#f0803c", "#cc79a7": "#e29bc4", "#bdbdbd": "#6a6f75", "#332288": "#a197ee", "#882255": "#dd7fa8", "#8a3a00": "#d68a55" };
  const MARKS = { o: "circle", s: "rect", "^": "triangle", v: "triangle", D: "rectRot", P: "crossRot", X: "crossRot", "<": "triangle" };
  const TURNED = { v: 180, "<": 270, P: 45 };
  const SUPERSCRIPT = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

  const is_dark = () => getComputedStyle(document.documentElement).getPropertyValue("--ground").trim() !== "#fff";
  const colour = (value) => is_dark() ? ON_DARK[value] || value : value;
  const faint = () => is_dark() ? "#343a40" : "#d9d9d9";
  const ink = () => is_dark() ? "#d8d8d8" : "#222222";

  const power = (exponent) => "10" + [...String(exponent)].map((c) => SUPERSCRIPT[c]).join("");

  const minus = (value) => String(value).replace(/^-/, "−");

  // A number with so many digits, with a power of ten where that is shorter.
  const number = (value, digits = 4) => {
    if (value === 0) return "0";
    const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-12);
    if (exponent > -4 && exponent < 6) return minus(Number(value.toPrecision(digits)));
    const factor = Number((value / 10 ** exponent).toPrecision(digits));
    return (factor === 1 ? "" : `${minus(factor)} × `) + power(exponent);
  };

  // Ticks of a logarithmic axis: powers of ten, every other of them where there are many; 1, 2, 5 where there are few.
  const log_ticks = (low, high) => {
    const decades = Math.log10(high / low), ticks = [];
    const step = Math.max(1, Math.ceil(decades / 7));
    for (let k = Math.ceil(Math.log10(low) - 1e-9); k <= Math.log10(high) + 1e-9; k += step) ticks.push(10 ** k);
    if (ticks.length > 2) return ticks;
    const finer = [];
    for (let k = Math.floor(Math.log10(low)); k <= Math.log10(high); ++k)
      for (const factor of [1, 2, 5])
        if (factor * 10 ** k >= low * (1 - 1e-9) && factor * 10 ** k <= high * (1 + 1e-9)) finer.push(factor * 10 ** k);
    return finer.length > 1 ? finer : linear_ticks(low, high);
  };

  // Round numbers of an interval that holds less than two of 1, 2 and 5 times a power of ten.
  const linear_ticks = (low, high) => {
    const power = 10 ** Math.floor(Math.log10((high - low) / 2)), ticks = [];
    const step = [5, 2, 1].map((factor) => factor * power).find((one) => (high - low) / one >= 2) || power;
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-12); ++k) ticks.push(k * step);
    return ticks;
  };

  // A tick of a linear axis with as many digits as tell it from its neighbours; where that is more than five, all but
  // the first say what they add to it.
  const linear_tick = (value, ticks) => {
    const gaps = ticks.slice(1).map((tick, i) => Math.abs(tick - ticks[i])).filter((gap) => gap > 0);
    const largest = Math.max(...ticks.map(Math.abs)), step = Math.min(...gaps);
    if (!gaps.length || !(largest > 0)) return number(value);
    if (Math.abs(value) < 1e-6 * step) return "0";
    const digits = Math.ceil(Math.log10(largest / step)) + 1;
    if (digits <= 5) return number(value, Math.max(4, digits));
    return value === ticks[0] ? number(value, Math.min(15, digits)) : `+${number(value - ticks[0], 3)}`;
  };

  // A quantity and its unit: "strain [%]" gives ["strain", "%"].
  const quantity = (label) => {
    const parts = /^(.*?)\s*\[(.*)\]$/.exec(label);
    return parts ? [parts[1], parts[2] === "-" || parts[2] === "1" ? "" : parts[2]] : [label, ""];
  };

  // A long label in two lines, broken at the middle.
  const lines = (label) => {
    if (label.length < 36) return label;
    const gaps = [...label.matchAll(/ /g)].map((match) => match.index);
    const middle = gaps.reduce((best, at) => Math.abs(at - label.length / 2) < Math.abs(best - label.length / 2) ? at : best, 0);
    return [label.slice(0, middle), label.slice(middle + 1)];
  };

  // The sample of a curve in the legend, as a small drawing.
  const sample = (curve) => {
    const stroke = colour(curve.colour);
    if (curve.fill) return `<svg width="24" height="12"><rect width="24" height="12" fill="${stroke}" opacity=".6"/></svg>`;
    const dash = curve.dash ? `<path d="M0 6H26" stroke="${stroke}" stroke-width="2" stroke-dasharray="${curve.dash.join(" ")}"/>` : "";
    const fill = curve.hollow ? (is_dark() ? "#14171a" : "#fff") : stroke;
    const shapes = { circle: `<circle cx="13" cy="6" r="3.4"`, rect: `<rect x="9.8" y="2.8" width="6.4" height="6.4"`,
      rectRot: `<path d="M13 1.5L17.5 6L13 10.5L8.5 6Z"`, triangle: `<path d="M13 2L17 9.5H9Z"`,
      crossRot: `<path d="M10 3L16 9M16 3L10 9"` };
    const kind = MARKS[curve.marker];
    const turn = TURNED[curve.marker] ? ` transform="rotate(${TURNED[curve.marker]} 13 6)"` : "";
    const mark = kind ? `${shapes[kind]} fill="${fill}" stroke="${stroke}" stroke-width="1.3"${turn}/>` : "";
    return `<svg width="26" height="12">${dash}${mark}</svg>`;
  };

  return { MARKS, TURNED, colour, faint, ink, is_dark, lines, linear_tick, log_ticks, number, power, quantity, sample };
})();
