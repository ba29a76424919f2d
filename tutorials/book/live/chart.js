// A small chart in SVG: axes, curves, markers. Its colours come from the style sheet.
"use strict";
antilock.part = (name, attributes, parent) => {
  const part = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) part.setAttribute(key, value);
  parent?.append(part);
  return part;
};

antilock.chart = (where, { x, y, title }) => {
  const make = antilock.part;
  const narrow = matchMedia("(max-width: 36em)").matches;  // its letters stay as large as those around it
  const width = narrow ? 360 : 560, height = narrow ? 280 : 300, left = 62, bottom = 44, right = 12, top = 12;
  const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": title, class: "live-chart" });
  where.append(svg);
  const map = (axis, from, to) => (v) => {
    const f = axis.log ? Math.log10 : (t) => t, [a, b] = axis.range;
    return from + (to - from) * (f(v) - f(a)) / (f(b) - f(a));
  };
  const px = map(x, left, width - right), py = map(y, height - bottom, top);
  const frame = make("g", { class: "frame" }, svg);
  const power = (v) => {
    const e = Math.round(Math.log10(v));
    if (Math.abs(Math.log10(v) - e) > 1e-9) return String(v);
    return e === 0 ? "1" : `10<tspan dy="-5" font-size="10">${String(e).replace("-", "−")}</tspan>`;
  };
  for (const v of x.ticks) {
    make("line", { x1: px(v), x2: px(v), y1: top, y2: height - bottom }, frame);
    make("text", { x: px(v), y: height - bottom + 18, "text-anchor": "middle" }, frame).innerHTML = x.names?.[v] ?? (x.log ? power(v) : v);
  }
  for (const v of y.ticks) {
    make("line", { x1: left, x2: width - right, y1: py(v), y2: py(v) }, frame);
    make("text", { x: left - 8, y: py(v) + 4, "text-anchor": "end" }, frame).innerHTML = y.log ? power(v) : String(v).replace("-", "−");
  }
  make("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, frame).textContent = x.name;
  make("text", { x: -(top + height - bottom) / 2, y: 14, "text-anchor": "middle", transform: "rotate(-90)" }, frame).textContent = y.name;
  const layers = {};
  const inside = (v, axis) => Math.min(axis.range[1], Math.max(axis.range[0], v));
  return {
    svg,
    /// Draws the curve `name` anew: points [x, y], joined or as markers.
    curve(name, points, { joined = true, markers = false } = {}) {
      layers[name] ??= make("g", { class: `curve ${name}` }, svg);
      layers[name].replaceChildren();
      const at = points.map(([a, b]) => [px(inside(a, x)), py(inside(b, y))]);
      if (joined && at.length > 1) make("path", { d: "M" + at.map((p) => p.map((v) => v.toFixed(1)).join(" ")).join("L"), fill: "none" }, layers[name]);
      if (markers) for (const [a, b] of at) make("circle", { cx: a, cy: b, r: 3.5 }, layers[name]);
    },
    said(text) { svg.setAttribute("aria-label", `${title}. ${text}`); },
  };
};

/// The numbers of a figure as tables, folded below it, for a reader who does not see its curves.
/// The answer takes `tables`: name -> rows, as objects. At most 200 rows of a table are shown.
antilock.numbers = (box) => {
  const folded = document.createElement("details");
  folded.className = "live-numbers";
  folded.innerHTML = `<summary>The numbers of this figure</summary>
    <div tabindex="0" role="group" aria-label="The numbers of this figure"></div>`;
  box.append(folded);
  let tables = {};
  const line = (cells, kind) => {
    const row = document.createElement("tr");
    for (const value of cells) {
      const text = typeof value === "number" ? Number(value.toPrecision(4)) : value;
      row.append(Object.assign(document.createElement(kind), { textContent: text }));
    }
    return row;
  };
  const table = ([name, rows]) => {
    const part = document.createElement("table"), shown = rows.slice(0, 200);
    const less = shown.length < rows.length;
    const more = less ? `, the first ${shown.length} of ${rows.length} rows` : "";
    part.createCaption().textContent = name + more;
    part.createTHead().append(line(Object.keys(rows[0]), "th"));
    part.createTBody().append(...shown.map((row) => line(Object.values(row), "td")));
    return part;
  };
  const show = () => {
    if (!folded.open) return;
    const filled = Object.entries(tables).filter(([, rows]) => rows.length > 0);
    folded.lastElementChild.replaceChildren(...filled.map(table));
  };
  folded.addEventListener("toggle", show);
  return (now) => {
    tables = now;
    show();
  };
};
