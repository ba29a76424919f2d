// The round-off exhibit: the sum of both forms in one matrix against the split form, on the structured mesh.
"use strict";
antilock.figures.roundoff = async (box) => {
  let library = await antilock.library();
  const still = document.createElement("div");
  still.innerHTML = `
    <p class="live-title">Try it: one matrix for both forms, or the split form</p>
    <div class="live-controls">
      <label for="live-roundoff-epsilon">ε = <output></output></label>
      <input id="live-roundoff-epsilon" type="range" min="-16" max="0" step="0.5" value="0">
      <label for="live-roundoff-cells">1/h</label>
      <select id="live-roundoff-cells"><option>8</option><option selected>16</option><option>32</option></select>
      <button type="button">all ε</button>
    </div>
    <div class="live-drawing"></div>
    <p class="live-key-line"><span class="key p1">both forms summed</span> <span class="key cr">split form</span></p>
    <p class="live-said" role="status"></p>`;
  const range = still.querySelector("input"), cells = still.querySelector("select"), all = still.querySelector("button");
  const output = still.querySelector("output"), said = still.querySelector(".live-said");
  const chart = antilock.chart(still.querySelector(".live-drawing"), { title: "Largest error at the unknowns against epsilon, P1 on the structured mesh",
    x: { log: true, range: [4e-17, 2.5], ticks: [1e-16, 1e-12, 1e-8, 1e-4, 1], name: "ε" },
    y: { log: true, range: [1e-4, 1], ticks: [1e-4, 1e-3, 1e-2, 1e-1, 1], name: "largest error" } });
  let points = new Map();
  async function update() {
    output.innerHTML = `10<sup>${range.value.replace("-", "−")}</sup>`;
    range.setAttribute("aria-valuetext", `epsilon is 10^${range.value}`);
    try {
      library ??= await antilock.library();
      const epsilon = 10 ** Number(range.value), answer = library.roundOff(Number(cells.value), epsilon);
      points.set(epsilon, answer);
      const sorted = [...points].sort((a, b) => a[0] - b[0]);
      chart.curve("p1", sorted.map(([e, a]) => [e, a.summed]), { markers: true });
      chart.curve("cr", sorted.map(([e, a]) => [e, a.split]), { markers: true });
      const text = `summed ${answer.summed === 1 ? "no answer" : antilock.digits(answer.summed)}, split ${antilock.digits(answer.split)}`;
      said.textContent = `Error: ${text}.`;
      chart.said(text);
      Object.assign(box.dataset, { state: "ready", split: answer.split, summed: answer.summed });
    } catch (error) {
      library = null;
      said.textContent = `No answer: ${error.message}. Choose something else; the page goes on.`;
      box.dataset.state = "failed";
    }
  }
  const soon = antilock.soon(update);
  range.addEventListener("input", soon);
  cells.addEventListener("input", () => { points = new Map(); soon(); });
  all.addEventListener("click", async () => {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    for (let x = 0; x >= -16; x -= 1) {
      range.value = x;
      await update();
      if (!still) await new Promise(requestAnimationFrame);
    }
  });
  box.setAttribute("aria-label", "Live figure: round-off, both forms summed against the split form");
  box.replaceChildren(...still.children);
  await update();
};
