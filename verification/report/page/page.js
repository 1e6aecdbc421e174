// SPDX-License-Identifier: MIT
// What the page does besides plots: light and dark, the place in the contents, downloads out of the page itself.
"use strict";
(() => {
  const root = document.documentElement;
  const asked = new URLSearchParams(location.search).get("theme");
  const dark_by_default = matchMedia("(prefers-color-scheme: dark)");
  const is_theme = (name) => name === "dark" || name === "light";
  let stored = null;
  try { stored = localStorage.getItem("theme"); } catch (error) { /* a page from a file may have no storage */ }
  if (is_theme(asked) || is_theme(stored)) root.dataset.theme = is_theme(asked) ? asked : stored;
  const is_dark = () => root.dataset.theme ? root.dataset.theme === "dark" : dark_by_default.matches;
  const announce = () => {
    button.textContent = is_dark() ? "light" : "dark";
    dispatchEvent(new Event("theme"));
  };

  const button = document.createElement("button");
  button.className = "theme";
  button.title = "colours of the page";
  button.onclick = () => {
    root.dataset.theme = is_dark() ? "light" : "dark";
    try { localStorage.setItem("theme", root.dataset.theme); } catch (error) { /* kept for this visit only */ }
    announce();
  };
  document.body.append(button);
  dark_by_default.addEventListener("change", announce);
  announce();

  // What a link leads to must not lie in a fold; a page that is printed has none.
  const unfold = () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    for (let fold = target.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
    target.scrollIntoView();
  };
  addEventListener("hashchange", unfold);
  document.addEventListener("click", (event) => {
    const link = event.target.closest('a[href^="#"]');
    if (link && link.hash === location.hash) unfold();
  });
  unfold();
  let folded = [];
  addEventListener("beforeprint", () => {
    folded = [...document.querySelectorAll("details:not([open])")];
    folded.forEach((fold) => { fold.open = true; });
  });
  addEventListener("afterprint", () => folded.forEach((fold) => { fold.open = false; }));

  // The heading that was passed last stands out in the contents.
  const links = new Map([...document.querySelectorAll("nav a")].map((a) => [a.hash.slice(1), a]));
  const headings = [...document.querySelectorAll("h2[id]")].filter((h) => links.has(h.id));
  const mark = () => {
    const passed = headings.filter((h) => h.getBoundingClientRect().top < 120);
    const here = (passed.at(-1) || headings[0] || {}).id;
    links.forEach((a, id) => a.classList.toggle("here", id === here));
  };
  addEventListener("scroll", mark, { passive: true });
  mark();

  // SVG and CSV are in the page: they can be saved where the page has been sent without its folder.
  const csv_of = (panels) => {
    const quote = (text) => /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
    const rows = [["panel", "series", "note", "x_quantity", "x", "y_quantity", "y"]];
    for (const panel of panels)
      for (const curve of panel.curves)
        for (const i of curve.label ? curve.shown || curve.points.keys() : []) {
          const [x, y] = curve.points[i];
          const value = (curve.note || "").startsWith("zero") ? 0 : y;
          if (x !== null && y !== null) rows.push([panel.title, curve.label, curve.note || "", panel.x.label, x, panel.y.label, value]);
        }
    return rows.map((row) => row.map((value) => quote(String(value))).join(",")).join("\n") + "\n";
  };
  for (const figure of document.querySelectorAll("figure")) {
    const link = (ending) => figure.querySelector(`.downloads a[href$=".${ending}"]`);
    const image = figure.querySelector("img");
    if (link("svg") && image.src.startsWith("data:image/svg+xml")) link("svg").href = image.src;
    const data = figure.querySelector("script.plot-data");
    if (link("csv") && data)
      link("csv").addEventListener("click", (event) => {
        const url = URL.createObjectURL(new Blob([csv_of(JSON.parse(data.textContent))], { type: "text/csv" }));
        event.currentTarget.href = url;
        setTimeout(() => URL.revokeObjectURL(url), 10000);
      });
  }
})();
