// The string on an obstacle, chapter 00: active set step by step, and Uzawa beside it. The two loops of the chapter,
// line by line.
"use strict";
antilock.string = {
  hang(cells) {
    const h = 1 / cells, factor = 10 * (2 - 2 * Math.cos(2 * Math.PI * h)) / (4 * Math.PI * Math.PI * h);
    return { cells, h, b: Array.from({ length: cells + 1 }, (_, i) => (i > 0 && i < cells ? factor * Math.sin(2 * Math.PI * i * h) : 0)) };
  },
  solveWithHeld({ cells, h }, force, held) {
    const pivot = Array(cells + 1).fill(1), rest = Array(cells + 1).fill(0), u = Array(cells + 1).fill(0);
    for (let i = 1; i < cells; ++i) {
      if (held[i]) continue;
      const coupled = i > 1 && !held[i - 1];
      pivot[i] = 2 / h - (coupled ? 1 / (h * h * pivot[i - 1]) : 0);
      rest[i] = force[i] + (coupled ? rest[i - 1] / (h * pivot[i - 1]) : 0);
    }
    for (let i = cells - 1; i > 0; --i) if (!held[i]) u[i] = (rest[i] + u[i + 1] / h) / pivot[i];
    return u;
  },
  contactForce: ({ cells, h, b }, u) =>
    u.map((value, i) => (i > 0 && i < cells && value === 0 ? (-u[i - 1] + 2 * u[i] - u[i + 1]) / h - b[i] : 0)),
  /// Every guess of the active set: { u, lambda, touches }, the last one is the answer. The free string passes the floor in
  /// its middle: a node there is a round-off above or below it. Here it touches.
  activeSet(s) {
    const steps = [], onFloor = 1e-14;
    for (let touches = Array(s.cells + 1).fill(false);;) {
      const u = this.solveWithHeld(s, s.b, touches), lambda = this.contactForce(s, u);
      steps.push({ u, lambda, touches });
      const next = touches.map((held, i) => i > 0 && i < s.cells && (held ? lambda[i] > 0 : u[i] < onFloor));
      if (next.every((held, i) => held === touches[i])) return steps;
      touches = next;
    }
  },
  /// Uzawa from no force: steps until a step moves less than the tolerance; each is { u, change }.
  *uzawa(s, tolerance) {
    const rho = 1.9 * Math.PI * Math.PI * s.h, lambda = Array(s.cells + 1).fill(0), none = Array(s.cells + 1).fill(false);
    for (let change = 1; change > tolerance;) {
      const u = this.solveWithHeld(s, s.b.map((b, i) => b + lambda[i]), none);
      change = 0;
      for (let i = 1; i < s.cells; ++i) {
        const next = Math.max(0, lambda[i] - rho * u[i]);
        change = Math.max(change, Math.abs(next - lambda[i]) / rho);
        lambda[i] = next;
      }
      yield { u, change };
    }
  },
};

antilock.figures.string = async (box) => {
  const still = document.createElement("div");
  still.innerHTML = `
    <p class="live-title">Step by step: the active set, and Uzawa beside it</p>
    <div class="live-controls">
      <label for="live-string-step">step <output></output></label>
      <input id="live-string-step" type="range" min="0" max="1" step="1" value="0">
      <span class="live-choice"><label for="live-string-cells">cells</label>
      <select id="live-string-cells"><option>8</option><option>16</option><option selected>32</option><option>64</option></select>
      <button type="button">play</button></span>
    </div>
    <div class="live-drawing"></div>
    <p class="live-key-line"><span class="key cr">active set</span> <span class="key touching">guessed to touch</span> <span class="key p1">Uzawa</span> <span class="key exact">answer</span></p>
    <p class="live-said" role="status"></p>`;
  const range = still.querySelector("input"), cells = still.querySelector("select"), play = still.querySelector("button");
  const output = still.querySelector("output"), said = still.querySelector(".live-said");
  const chart = antilock.chart(still.querySelector(".live-drawing"), { title: "Height of the string over the floor",
    x: { range: [0, 1], ticks: [0, 0.25, 0.5, 0.75, 1], name: "x" }, y: { range: [-0.3, 0.45], ticks: [-0.2, 0, 0.2, 0.4], name: "height" } });
  let s, steps, uzawa;
  function begin() {
    s = antilock.string.hang(Number(cells.value));
    steps = antilock.string.activeSet(s);
    uzawa = [...antilock.string.uzawa(s, 1e-10)];
    range.max = steps.length - 1;
    range.value = 0;
    show();
  }
  function show() {
    const k = Number(range.value), now = steps[k], along = (u) => u.map((value, i) => [i * s.h, value]);
    const other = uzawa[Math.min(k, uzawa.length - 1)];
    chart.curve("exact", along(steps.at(-1).u));
    chart.curve("p1", along(other.u));
    chart.curve("cr", along(now.u), { markers: s.cells <= 32 });
    chart.curve("touching", along(now.u).filter((_, i) => now.touches[i]), { joined: false, markers: true });
    output.textContent = `${k} of ${steps.length - 1}`;
    const wrong = now.u.filter((u) => u < 0).length + now.lambda.filter((force) => force < 0).length;
    const text = `Step ${k}: ${now.touches.filter(Boolean).length} nodes held, ${wrong} wrong signs. ` +
      (wrong === 0 ? `The active set is done after ${steps.length} linear solves; ` : "") + `Uzawa needs ${uzawa.length} in all, and still moves by ${antilock.digits(other.change)}.`;
    said.textContent = text;
    chart.said(text);
    Object.assign(box.dataset, { state: "ready", steps: steps.length, uzawa: uzawa.length });
  }
  range.addEventListener("input", show);
  cells.addEventListener("input", begin);
  let player = 0;  // a second press ends what the first one plays
  play.addEventListener("click", async () => {
    const own = ++player;
    const wait = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 700;
    for (let k = 0; k < steps.length; ++k) {
      range.value = wait ? k : steps.length - 1;
      show();
      if (!wait) return;
      await new Promise((done) => setTimeout(done, wait));
      if (own !== player) return;
    }
  });
  box.setAttribute("aria-label", "Live figure: a string on an obstacle, step by step");
  box.replaceChildren(...still.children);
  begin();
};
