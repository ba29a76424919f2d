// The figure of the book: epsilon, the mesh and 1/h against P1 and Crouzeix-Raviart.
"use strict";
antilock.figures.locking = async (box) => {
  const settings = box.dataset, names = ["P1", "Crouzeix–Raviart"], short = ["p1", "cr"], range = 0.25;
  const meshes = { structured: "structured", unstructured: "unstructured", moved: "moved by t h", layered: "layered" }, sizes = [8, 16, 24, 32];
  let library = await antilock.library();
  const option = (value, text, chosen) => `<option value="${value}"${value === chosen ? " selected" : ""}>${text}</option>`;
  const colours = Array.from({ length: 21 }, (_, i) => `rgb(${antilock.viridis(i / 20).join(",")})`).join(",");
  const still = document.createElement("div");
  still.innerHTML = `
    <p class="live-title">Try it: the library, solving in this page</p>
    <div class="live-controls">
      <label for="live-epsilon">ε = <output id="live-epsilon-said" for="live-epsilon"></output></label>
      <input id="live-epsilon" type="range" min="-8" max="0" step="0.25" value="${settings.epsilon ?? -2}">
      <span class="live-choice"><label for="live-mesh">mesh</label>
      <select id="live-mesh">${Object.entries(meshes).map(([value, text]) => option(value, text, settings.mesh ?? "unstructured")).join("")}</select></span>
      <span id="live-moved-box" hidden><label for="live-moved">t = <output id="live-moved-said"></output></label>
      <input id="live-moved" type="range" min="0" max="0.2" step="0.01" value="${settings.moved ?? 0.02}"></span>
      <span class="live-choice"><label for="live-cells">1/h</label>
      <select id="live-cells">${sizes.map((n) => option(n, n, Number(settings.cells ?? 16))).join("")}</select></span>
    </div>
    <div class="live-pictures">${names.map((name, i) => `
      <figure><figcaption><b>${name}</b><br><span class="live-number" id="live-kept-${short[i]}"></span> % of the layer’s displacement kept</figcaption>
      <div class="live-canvas">
        <canvas tabindex="0" role="img" aria-label="Surface of u with ${name}"></canvas>
      <span class="live-label" aria-hidden="true">x = 0</span><span class="live-label" aria-hidden="true">x = 1</span>
      <span class="live-label" aria-hidden="true">y = 1</span><span class="live-label" aria-hidden="true">Σ</span>
      <span class="live-label" aria-hidden="true">Γ<sub>C</sub></span><span class="live-label" aria-hidden="true"></span></div></figure>`).join("")}
    </div>
    <div class="live-bar" role="img" aria-label="Colours of u, from minus ${range} to ${range}"><span>u = −${range}</span>
      <i style="background:linear-gradient(to right,${colours})"></i><span>${range}</span>
      <span class="live-key">exact u on Γ<sub>C</sub></span></div>
    <table class="live-table"><thead><tr><td></td><th>unknowns</th><th>error</th><th>corrections</th><th>in contact</th><th>from x</th><th>ms</th></tr></thead>
    <tbody>${names.map((name) => `<tr><th scope="row">${name}</th>${"<td></td>".repeat(6)}</tr>`).join("")}</tbody></table>
    <p class="live-warning" role="status"></p>
    <p class="live-note">Both solved in <span id="live-ms"></span> ms. Error: the largest at the unknowns. Drag a picture to turn it, or use its arrow keys.
      Crouzeix–Raviart jumps between triangles: the white specks are its jumps.</p>
    <p class="live-said" role="status"></p>`;
  const parts = Object.fromEntries([...still.querySelectorAll("[id]")].map((part) => [part.id.slice(5), part]));
  const at = (id) => parts[id], said = still.querySelector(".live-said"), warning = still.querySelector(".live-warning");
  const canvases = [...still.querySelectorAll("canvas")], rows = [...still.querySelectorAll("tbody tr")];
  const paint = [];
  for (const canvas of canvases) {
    await antilock.breath();
    const places = [() => [0, -1.14, 0], () => [1, -1.14, 0], () => [1.13, 1, 0], () => [-0.05, 0, 0], () => [0.5, -1.14, 0], (r) => [0, -1, r + 0.03]];
    const spans = [...canvas.parentNode.querySelectorAll("span")];
    spans[5].textContent = "u";
    paint.push(antilock.surface(canvas, { at: spans.map((span, i) => [span, places[i]]),
      lost: (lost) => { said.textContent = lost ? "The graphics card was lost; the numbers go on, and the pictures come back with it." : ""; } }));
  }
  const solved = [null, null], turn = [-0.6, 0.6];
  let ridge = [];
  const drawOne = (i) => solved[i] && paint[i](solved[i].corners, ridge, range, turn), draw = () => [0, 1].forEach(drawOne);

  const asked = () => ({ epsilon: antilock.epsilonOf(at("epsilon")), mesh: at("mesh").value, cells: Number(at("cells").value), moved: Number(at("moved").value) });

  // The meshes that may be asked for next are made while the reader reads, one element of one mesh at a time.
  let ahead = [], waiting = false;
  function next(deadline) {
    waiting = false;
    const now = asked(), one = ahead.shift();
    if (!one || !library) return;
    if (deadline?.timeRemaining() < 5) ahead.unshift(one);
    else {
      try { library.prepare(...one, now.moved, now.epsilon); } catch { library = null; }  // what it says is said when it is asked for
    }
    later();
  }
  function later() {
    box.dataset.ahead = ahead.length;
    if (waiting || ahead.length === 0) return;
    waiting = true;
    antilock.whenIdle(next);
  }
  function prepare({ mesh, cells }) {
    const beside = [...sizes.map((size) => [mesh, size]), ...Object.keys(meshes).map((kind) => [kind, cells])];
    ahead = beside.filter(([kind, size]) => kind !== mesh || size !== cells).flatMap((one) => [[0, ...one], [1, ...one]]);
    later();
  }

  async function update() {
    const { epsilon, mesh, cells, moved } = asked();
    at("epsilon-said").innerHTML = antilock.epsilonShown(at("epsilon"), epsilon);
    at("epsilon").setAttribute("aria-valuetext", `epsilon is ${antilock.epsilonSaid(at("epsilon"), epsilon)}`);
    at("moved-said").textContent = moved;
    at("moved-box").hidden = mesh !== "moved";
    const began = performance.now(), pause = solved[1] ? () => {} : antilock.breath;  // while the page is being loaded
    try {
      library ??= await antilock.library();
      for (const i of [0, 1]) {
        await pause();
        library.discretise(i, mesh, cells, moved);
        await pause();
        solved[i] = library.solve(i, epsilon);
        solved[i].corners = library.surface(i);
        solved[i].warning = library.warning(i);
      }
      ridge = library.ridge(epsilon, 65);
      for (const i of [0, 1]) {
        await pause();
        drawOne(i);
      }
      solved.forEach((s, i) => {
        at(`kept-${short[i]}`).textContent = Math.abs(s.kept) < 0.005 ? "0.00" : antilock.digits(s.kept);
        at(`kept-${short[i]}`).dataset.value = s.kept;
        canvases[i].setAttribute("aria-label", `Surface of u with ${names[i]}: the layer keeps ${antilock.digits(s.kept)} percent of its displacement`);
        [s.unknowns, antilock.digits(s.error), s.corrections, `${s.touching} of ${s.contact}`, s.touching ? s.from.toFixed(3) : "–",
         s.ms.toFixed(1)].forEach((text, k) => { rows[i].children[k + 1].textContent = text; });
        rows[i].dataset.error = s.error;
        rows[i].dataset.touching = s.touching;
      });
      at("ms").textContent = (solved[0].ms + solved[1].ms).toFixed(1);
      warning.textContent = solved.map((s) => s.warning).filter(Boolean).join(" ");
      said.textContent = "";
      box.dataset.state = "ready";
      box.dataset.step = (performance.now() - began).toFixed(2);
      prepare({ mesh, cells });
    } catch (error) {
      library = null;
      said.textContent = antilock.refusal(error);
      box.dataset.state = "failed";
    }
  }
  const ask = antilock.soon(update);
  for (const name of ["epsilon", "mesh", "cells", "moved"]) at(name).addEventListener("input", ask);
  for (const canvas of canvases) antilock.turns(canvas, turn, draw);
  window.addEventListener("resize", draw);
  box.setAttribute("aria-label", "Live figure: epsilon and the mesh against P1 and Crouzeix-Raviart");
  box.replaceChildren(...still.children);
  await update();
};
