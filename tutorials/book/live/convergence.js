// The reader makes Figure 9: every epsilon that is asked for leaves its point.
"use strict";
antilock.figures.convergence = async (box) => {
  let library = await antilock.library();
  const still = document.createElement("div");
  still.innerHTML = `
    <p class="live-title">Make the figure: every ε you drag over leaves its point</p>
    <div class="live-controls">
      <label for="live-convergence-epsilon">ε = <output></output></label>
      <input id="live-convergence-epsilon" type="range" min="-8" max="0" step="0.25" value="0">
      <label for="live-convergence-mesh">mesh</label>
      <select id="live-convergence-mesh"><option selected>unstructured</option><option>structured</option><option>layered</option></select>
      <label for="live-convergence-cells">1/h</label>
      <select id="live-convergence-cells"><option selected>16</option><option>24</option><option>32</option></select>
      <button type="button">all ε</button> <button type="button">clear</button>
    </div>
    <div class="live-drawing"></div>
    <p class="live-key-line"><span class="key p1">P1</span> <span class="key cr">Crouzeix–Raviart</span> <span class="key other">points of the meshes before</span></p>
    <p class="live-said" role="status"></p>`;
  const range = still.querySelector("input"), [mesh, cells] = still.querySelectorAll("select"), [all, clear] = still.querySelectorAll("button");
  const output = still.querySelector("output"), said = still.querySelector(".live-said");
  const at0 = 10 ** -8;  // where epsilon = 0 is drawn
  const chart = antilock.chart(still.querySelector(".live-drawing"), { title: "Largest error at the unknowns against epsilon",
    x: { log: true, range: [at0 * 0.6, 1.6], ticks: [1e-8, 1e-6, 1e-4, 1e-2, 1], names: { 1e-8: "0" }, name: "ε" },
    y: { log: true, range: [3e-5, 1e-1], ticks: [1e-4, 1e-3, 1e-2, 1e-1], name: "largest error" } });
  const points = {};  // "mesh cells element" -> Map of epsilon to error
  let made = "";
  const sorted = (key) => [...(points[key] ?? new Map())].sort((a, b) => a[0] - b[0]).map(([e, error]) => [e || at0, error]);
  function draw() {
    const now = `${mesh.value} ${cells.value}`;
    const before = Object.keys(points).filter((key) => !key.startsWith(now + " "));
    chart.curve("other", before.flatMap(sorted), { joined: false, markers: true });
    ["p1", "cr"].forEach((name, i) => chart.curve(name, sorted(`${now} ${i}`), { markers: true }));
  }
  async function ask(epsilon) {
    try {
      library ??= await antilock.library();
      const wanted = `${mesh.value} ${cells.value}`, errors = [];
      for (const i of [0, 1]) {
        if (made !== wanted) library.discretise(i, mesh.value, Number(cells.value), 0);
        errors.push(library.solve(i, epsilon).error);
        (points[`${wanted} ${i}`] ??= new Map()).set(epsilon, errors[i]);
      }
      made = wanted;
      draw();
      const text = `P1 ${antilock.digits(errors[0])}, Crouzeix–Raviart ${antilock.digits(errors[1])}, ${points[`${wanted} 0`].size} points`;
      said.textContent = `Error: ${text}.`;
      chart.said(text);
      box.dataset.points = points[`${wanted} 0`].size;
      box.dataset.state = "ready";
    } catch (error) {
      library = null;
      made = "";
      said.textContent = `No answer: ${error.message}. Choose something else; the page goes on.`;
      box.dataset.state = "failed";
    }
  }
  const update = () => {
    output.innerHTML = antilock.epsilonShown(range);
    range.setAttribute("aria-valuetext", `epsilon is ${antilock.epsilonSaid(range)}`);
    return ask(antilock.epsilonOf(range));
  };
  const soon = antilock.soon(update);
  for (const part of [range, mesh, cells]) part.addEventListener("input", soon);
  all.addEventListener("click", async () => {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    for (let x = 0; x >= -8; x -= 0.5) {
      range.value = x;
      await update();
      if (!still) await new Promise(requestAnimationFrame);
    }
  });
  clear.addEventListener("click", () => { for (const key of Object.keys(points)) delete points[key]; draw(); said.textContent = ""; box.dataset.points = 0; });
  box.setAttribute("aria-label", "Live figure: the error against epsilon, point by point");
  box.replaceChildren(...still.children);
  await update();
};
