// The live figures of chapters: an entry each. What they ask is answered by the live.hpp of the chapter.
"use strict";
antilock.figures.string = (box) => antilock.asked(box, {
  title: "Step by step: the active set", stem: "00_string_on_an_obstacle",
  controls: { cells: { label: "cells", values: [8, 16, 32, 64], start: 32 } },
  keys: { cr: "active set", touching: "guessed to touch", wrong: "wrong sign", exact: "answer", other: "pressure of the floor / 25" },
  make(place) {
    place.innerHTML = `<p class="live-controls"><label for="live-string-step">step <output></output></label>
      <input id="live-string-step" type="range" min="0" max="1" step="1" value="0"> <button type="button">play</button></p>`;
    const range = place.querySelector("input"), play = place.querySelector("button"), output = place.querySelector("output");
    const chart = antilock.chart(place, { title: "Height of the string over the floor",
      x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" }, y: { range: [-0.3, 0.45], ticks: [-0.2, 0, 0.2, 0.4], name: "height" } });
    let steps = [];
    function show() {
      const k = Number(range.value), now = steps[k], along = (rows, name) => [[0, 0], ...rows.map((row) => [row.x, row[name]]), [1, 0]];
      chart.curve("exact", along(steps.at(-1), "u"));
      chart.curve("other", along(now.map(({ x, pressure }) => ({ x, pressure: pressure / 25 })), "pressure"));
      chart.curve("cr", along(now, "u"), { markers: now.length < 32 });
      chart.curve("touching", now.filter((row) => row.held).map((row) => [row.x, row.u]), { joined: false, markers: true });
      const wrong = now.filter((row) => row.u < 0 || row.pressure < 0);
      chart.curve("wrong", wrong.map((row) => [row.x, row.u]), { joined: false, markers: true });
      output.textContent = `${k} of ${steps.length - 1}: ${now.filter((row) => row.held).length} nodes held, ${wrong.length} wrong signs`;
      chart.said(output.textContent);
    }
    range.addEventListener("input", show);
    let player = 0;  // a second press ends what the first one plays
    play.addEventListener("click", async () => {
      const own = ++player, atOnce = matchMedia("(prefers-reduced-motion: reduce)").matches;
      for (let k = atOnce ? steps.length - 1 : 0; k < steps.length && own === player; ++k) {
        range.value = k;
        show();
        await new Promise((done) => setTimeout(done, 700));
      }
    });
    return ({ tables }) => {
      steps = Array.from({ length: tables.counts[0]["active set"] }, (_, k) => tables.steps.filter((row) => row.step === k));
      range.max = steps.length - 1;
      range.value = 0;
      box.dataset.steps = steps.length;
      show();
    };
  },
});

antilock.figures.move = (box) => antilock.asked(box, {
  title: "Move a vertex of the layer: which triangles are tied, and what is left of the kernel?", stem: "02_meshes",
  controls: { cells: { label: "1/h", values: [4, 6, 8], start: 6 } },
  make(place, ask) {
    const svg = antilock.part("svg", { viewBox: "-0.03 -0.03 1.06 1.06", class: "live-mesh", role: "group", "aria-label": "The layer" }, place);
    const again = place.appendChild(Object.assign(document.createElement("button"), { type: "button", textContent: "as it was" }));
    place.append(" Drag a point, or choose it with the tab key and use the arrows.");
    let moves = {}, cells = 0, held;
    const said = () => ask({ moves: Object.entries(moves).flatMap(([v, way]) => [v, ...way]).join(" ") });
    const move = (v, dx, dy) => {  // in eighths of h: what is moved up alone stays on its line
      const way = (moves[v] ??= [0, 0]), whole = (x) => Math.round(8 * cells * x) / (8 * cells);
      way[0] = whole(way[0] + dx);
      way[1] = whole(way[1] + dy);
      said();
    };
    again.addEventListener("click", () => { moves = {}; said(); });
    const at = (event) => new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    svg.addEventListener("pointermove", (event) => {
      if (!held || !event.buttons) return;
      const { x, y } = at(event), way = moves[held.v] ?? [0, 0];
      move(held.v, x - held.x - way[0], held.y - y - way[1]);
    });
    return ({ tables: { triangles, vertices } }, options) => {
      if (cells && cells !== Number(options.cells)) { moves = {}; said(); }
      cells = Number(options.cells);
      const focus = document.activeElement?.dataset?.vertex, groups = [...new Set(triangles.map((t) => t.group))];
      svg.replaceChildren();
      for (const t of triangles) {
        const corners = [t.a, t.b, t.c].map((v) => `${vertices[v].x},${-vertices[v].y}`).join(" ");
        antilock.part("polygon", { points: corners, class: "cell", fill: groups.length === 1 ? "#bbb" : `hsl(${360 * groups.indexOf(t.group) / groups.length} 60% 72%)` }, svg);
      }
      vertices.forEach(({ x, y, moves: free }, v) => {
        if (!free) return;
        const dot = antilock.part("circle", { cx: x, cy: -y, r: 0.02, tabindex: 0, "data-vertex": v, role: "button", "aria-label": `vertex at ${antilock.digits(x)}, ${antilock.digits(y)}` }, svg);
        if (String(v) === focus) dot.focus();
        dot.addEventListener("pointerdown", (event) => {
          const point = at(event), way = moves[v] ?? [0, 0];
          held = { v, x: point.x - way[0], y: point.y + way[1] };
          event.preventDefault();
        });
        dot.addEventListener("keydown", (event) => {
          const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
          if (!step) return;
          event.preventDefault();
          move(v, ...step.map((k) => k / (8 * cells)));
        });
      });
    };
  },
});

antilock.figures.kernel = (box) => antilock.asked(box, {
  title: "What the kernel leaves of a sine", stem: "07_kernel",
  controls: { element: { label: "element", values: ["P1", "P2", "P3", "CR"], start: "P1" },
    mesh: { label: "mesh", values: ["structured", "unstructured", "delaunay", "staggered", "jittered"], start: "structured" },
    cells: { label: "1/h", values: [4, 8, 16], start: 8 } },
  keys: { exact: "sin πx", cr: "its projection onto the kernel, on Γ<sub>C</sub>" },
  make(place) {
    const chart = antilock.chart(place, { title: "The projection of a sine onto the kernel",
      x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" }, y: { range: [-0.1, 1.2], ticks: [0, 0.5, 1], name: "height" } });
    chart.curve("exact", Array.from({ length: 65 }, (_, k) => [k / 64, Math.sin(Math.PI * k / 64)]));
    return ({ said, tables: { points } }) => {
      chart.curve("cr", points.map((row) => [row.x, row.left]), { markers: true });
      chart.said(said);
    };
  },
});

// Draws u along the contact boundary: a curve of each kind from a column of the table `points`, in the order given.
antilock.contactBoundary = (curves) => (place) => {
  const chart = antilock.chart(place, { title: "Displacement of the contact boundary",
    x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" },
    y: { range: [-0.02, 0.14], ticks: [0, 0.05, 0.1], name: "u" } });
  return ({ said, tables: { points } }) => {
    for (const [name, column] of curves) {
      const curve = points.map((row) => [row.x, row[column]]);
      chart.curve(name, curve, { markers: name !== "exact" });
    }
    chart.said(said);
  };
};

antilock.figures.penalty = (box) => antilock.asked(box, {
  title: "Penalise the whole jump, or its mean", stem: "35_interior_penalty",
  controls: {
    epsilon: { label: "ε", range: [-6, 0, 0.25], start: -2, power: true, zero: true },
    gamma: { label: "γ", values: [1.5, 3, 6, 12, 48], start: 3 },
    mesh: { label: "mesh", values: ["staggered", "jittered", "structured"], start: "staggered" },
    cells: { label: "1/h", values: [4, 8, 16], start: 8 },
  },
  keys: { exact: "exact", p1: "the whole jump penalised", cr: "its mean penalised" },
  make: antilock.contactBoundary([["exact", "exact"], ["p1", "whole"], ["cr", "mean"]]),
});

antilock.figures.nitsche = (box) => antilock.asked(box, {
  title: "Choose the parameters of Nitsche's method", stem: "37_nitsche",
  controls: {
    epsilon: { label: "ε", range: [-8, 0, 0.25], start: -3, power: true },
    gamma0: { label: "γ₀", values: [0.5, 1, 1.5, 2.5, 10, 100], start: 10 },
    theta: { label: "θ", values: [1, 0, -1], start: 0 },
    contains: { label: "γ contains", values: ["the stiffness", "h alone"], start: "the stiffness" },
    cells: { label: "1/h", values: [8, 16, 32], start: 16 },
  },
  keys: { exact: "exact", p1: "Nitsche", cr: "active set" },
  make: antilock.contactBoundary([["exact", "exact"], ["cr", "strong"], ["p1", "nitsche"]]),
});

antilock.figures.beam = (box) => antilock.asked(box, {
  title: "A thinner beam, integrated in full and reduced", stem: "25_beam",
  controls: { epsilon: { label: "ε", range: [-8, -1, 0.25], start: -4, power: true, zero: true }, cells: { label: "cells", values: [8, 16, 32, 64], start: 16 } },
  keys: { p1: "full integration", cr: "reduced integration", exact: "exact", touching: "where the obstacle pushes, reduced integration" },
  make(place) {
    const chart = antilock.chart(place, { title: "Deflection of the beam over the obstacle",
      x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" }, y: { range: [-1.1, 0.1], ticks: [-1, -0.5, 0], name: "w" } });
    return ({ said, tables: { beam } }) => {
      for (const [name, column] of [["exact", "exact"], ["p1", "full"], ["cr", "reduced"]]) chart.curve(name, beam.map((row) => [row.x, row[`w_${column}`]]));
      chart.curve("touching", beam.filter((row) => row.force_reduced > 0).map((row) => [row.x, row.w_reduced]), { joined: false, markers: true });
      chart.said(said);
    };
  },
});

antilock.figures.friction = (box) => antilock.asked(box, {
  title: "How much the floor rubs, and what sticks", stem: "30_friction",
  controls: { rough: { label: "g times", range: [0, 2, 0.05], start: 1 }, epsilon: { label: "ε = 1/λ", range: [-8, 0, 0.25], start: -8, power: true, zero: true } },
  keys: { cr: "T, the force of the floor to the right", touching: "sticks", exact: "g and −g" },
  make(place) {
    const chart = antilock.chart(place, { title: "Tangential force along the floor",
      x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" }, y: { range: [-0.42, 0.42], ticks: [-0.4, -0.2, 0, 0.2, 0.4], name: "force per length" } });
    return ({ said, tables: { floor } }) => {
      const at = (name) => floor.map((row) => [row.x, row[name]]).sort((a, b) => a[0] - b[0]);
      chart.curve("exact", [...at("most"), ...at("most").reverse().map(([x, most]) => [x, -most])]);
      chart.curve("cr", at("T"));
      chart.curve("touching", floor.filter((row) => row.slip === 0 && row.most > 0).map((row) => [row.x, row.T]), { joined: false, markers: true });
      chart.said(said);
    };
  },
});

antilock.figures.solvers = (box) => antilock.asked(box, {
  title: "Two ways to one answer, step by step", stem: "34_solving_the_inequality",
  controls: { step: { label: "step", range: [1, 24, 1], start: 1 }, epsilon: { label: "ε", range: [-8, -1, 0.25], start: -8, power: true, zero: true },
    cells: { label: "1/h", values: [16, 32, 64], start: 32 }, mesh: { label: "mesh", values: ["structured", "jittered"], start: "structured" } },
  keys: { p1: "active set", cr: "proximal Galerkin", exact: "answer" },
  make(place) {
    const chart = antilock.chart(place, { title: "Displacement along the boundary that may touch",
      x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" }, y: { range: [-0.045, 0.065], ticks: [-0.04, -0.02, 0, 0.02, 0.04, 0.06], name: "u" } });
    return ({ said, tables: { curves } }) => {
      const along = (name) => [[0, 0], ...curves.map((row) => [row.x, row[name]]), [1, 0]];
      chart.curve("exact", along("answer"));
      chart.curve("p1", along("guess"));
      chart.curve("cr", along("proximal"));
      chart.said(said);
    };
  },
});

antilock.figures.accuracy = (box) => antilock.asked(box, {
  title: "Ask for an accuracy", stem: "22_ask_for_an_accuracy",
  controls: { asked: { label: "relative accuracy", values: [0.2, 0.1, 0.05, 0.02], start: 0.1 }, load: { label: "load", values: ["bump", "paper"], start: "bump" },
    of: { label: "of", values: ["displacement", "stress"], start: "displacement" } },
  keys: { cr: "proved, level by level", exact: "asked", mesh: "the last mesh: bright where the bound lies" },
  make(place) {
    place.classList.add("live-beside");
    const chart = antilock.chart(place, { title: "Proved relative error against the unknowns",
      x: { log: true, range: [100, 1e5], ticks: [100, 1e3, 1e4, 1e5], name: "unknowns" }, y: { log: true, range: [0.01, 1], ticks: [0.01, 0.1, 1], name: "relative error" } });
    const mesh = place.appendChild(Object.assign(document.createElement("canvas"), { width: 480, height: 480, className: "live-triangles" }));
    mesh.setAttribute("role", "img");
    mesh.setAttribute("aria-label", "The last mesh: bright where the bound lies");
    return ({ said, tables: { levels, triangles } }, { asked }) => {
      chart.curve("exact", [[100, Number(asked)], [1e5, Number(asked)]]);
      chart.curve("cr", levels.map((level) => [level.unknowns, level.bound]), { markers: true });
      chart.said(said);
      antilock.triangles(mesh, triangles);
    };
  },
});

antilock.figures.models = (box) => antilock.asked(box, {
  title: "Three models of one layer", stem: "10_limits",
  controls: { epsilon: { label: "ε", range: [-1.5, 0, 0.125], start: -0.5, power: true }, cells: { label: "1/h", values: [16, 32], start: 16 } },
  keys: { p1: "(22), the thin layer", cr: "(23), stretched", exact: "(25), the limit" },
  make(place) {
    const chart = antilock.chart(place, { title: "u on the contact boundary, by model",
      x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" }, y: { range: [0, 0.1], ticks: [0, 0.05, 0.1], name: "u" } });
    return ({ said, tables: { models } }) => {
      for (const [name, column] of [["exact", "limit"], ["cr", "scaled"], ["p1", "thin"]]) chart.curve(name, models.map((row) => [row.x, row[column]]));
      chart.said(said);
    };
  },
});

/// Of figures that are made point by point: the column of the rows `points`.
antilock.column = (stem, name) => async (epsilon, chosen) => (await antilock.answer(stem, { epsilon, ...chosen })).tables.points.map((row) => row[name]);

antilock.figures.bound = (box) => antilock.pointwise(box, {
  title: "A proved bound, and the error that it bounds: every ε leaves its points", label: "bound and error against epsilon",
  min: -8, step: 0.25, stride: 1, zero: 1e-8, asleep: true,
  choices: { mesh: ["unstructured", "structured", "layered"], cells: [8, 16] }, keys: ["P1: bound", "Crouzeix–Raviart: bound", "P1: error", "Crouzeix–Raviart: error"],
  axes: { title: "Bound and error in the energy norm against epsilon",
    x: { log: true, range: [6e-9, 1.6], ticks: [1e-8, 1e-6, 1e-4, 1e-2, 1], names: { 1e-8: "0" }, name: "ε" },
    y: { log: true, range: [0.03, 1], ticks: [0.1, 1], name: "energy norm" } },
  async ask(epsilon, chosen) {
    const { points: [cr, p1] } = (await antilock.answer("19_certificate", { epsilon, ...chosen })).tables;
    return [p1.bound, cr.bound, p1.error, cr.error];
  },
});

antilock.figures.degree = (box) => antilock.pointwise(box, {
  title: "How much of the ridge each degree keeps: every ε leaves its points", label: "the kept part of the ridge by degree",
  min: -4, step: 0.25, stride: 0.5, asleep: true,
  choices: { mesh: ["unstructured", "delaunay", "structured"], cells: [8, 16] }, keys: ["degree 1", "degree 2", "degree 3", "degree 4"],
  axes: { title: "Part of the ridge that is kept", x: { log: true, range: [8e-5, 1.3], ticks: [1e-4, 1e-3, 1e-2, 1e-1, 1], name: "ε" },
    y: { range: [0, 1.1], ticks: [0, 0.5, 1], name: "kept" } },
  ask: antilock.column("16_degree", "kept"),
});

antilock.figures.network = (box) => antilock.pointwise(box, {
  title: "The energy that networks with random weights have: every ε leaves its points", label: "energy of three networks",
  min: -5, step: 0.25, stride: 0.5, asleep: true,
  choices: { features: [25, 50, 100], draw: [1, 2, 3, 4, 5] }, start: { features: 50 },
  keys: ["any weights", "half of the features are columns", "any weights, in the coordinate εy"],
  axes: { title: "Share of the exact energy", x: { log: true, range: [8e-6, 1.3], ticks: [1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1], name: "ε" },
    y: { range: [0, 1.1], ticks: [0, 0.5, 1], name: "energy" } },
  ask: antilock.column("36_neural_network", "energy"),
});

antilock.figures.orders = (box) => antilock.pointwise(box, {
  title: "The energy error of three elements: every ε leaves its points", label: "the energy error by element",
  min: -4, step: 0.25, stride: 0.5, asleep: true,
  choices: { mesh: ["delaunay", "jittered", "rows", "columns", "structured"], cells: [8, 16] }, keys: ["Crouzeix–Raviart", "P2", "hybrid BDM1"],
  axes: { title: "Energy error without contact", x: { log: true, range: [8e-5, 1.3], ticks: [1e-4, 1e-3, 1e-2, 1e-1, 1], name: "ε" },
    y: { log: true, range: [1e-3, 1], ticks: [1e-3, 1e-2, 1e-1, 1], name: "energy norm" } },
  ask: antilock.column("38_order_two", "energy"),
});

antilock.figures.space = (box) => antilock.pointwise(box, {
  title: "How much of the energy P1 and Crouzeix–Raviart keep on tetrahedra: every ε leaves its points", label: "the kept share by element",
  min: -4, step: 0.25, stride: 0.5, asleep: true,
  choices: { mesh: ["unstructured", "jittered", "structured"], cells: [6, 4] }, keys: ["P1", "Crouzeix–Raviart"],
  axes: { title: "Share of the energy that is kept", x: { log: true, range: [8e-5, 1.3], ticks: [1e-4, 1e-3, 1e-2, 1e-1, 1], name: "ε" },
    y: { range: [0, 1.3], ticks: [0, 0.5, 1], name: "kept" } },
  ask: antilock.column("39_three_dimensions", "kept"),
});

antilock.figures.rubber = (box) => antilock.pointwise(box, {
  title: "The contact force as rubber loses its compressibility: every ε = 1/λ leaves its points", label: "contact force by element",
  min: -8, step: 0.25, stride: 1, zero: 1e-8, asleep: true, choices: { cells: [8, 16, 32] },
  keys: ["P1, parallel triangles", "P1, arbitrary triangles", "P1, crossed triangles", "Crouzeix–Raviart", "Kouhia–Stenberg"],
  axes: { title: "Contact force against 1/lambda", x: { log: true, range: [6e-9, 1.6], ticks: [1e-8, 1e-6, 1e-4, 1e-2, 1], names: { 1e-8: "0" }, name: "ε = 1/λ" },
    y: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "force" } },
  ask: antilock.column("26_elasticity", "force"),
});
