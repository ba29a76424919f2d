// The programs of the book, run in its pages: a chapter's own under its buttons (`data-run` holds the options), run_scene in
// the playground. A worker per run; the modules are asked for when the first button is pressed.
"use strict";
antilock.programs = (() => {
  const folder = document.currentScript?.src.replace(/[^/]*$/, "") ?? "";
  const script = (name) => new Promise((done, failed) => {
    const part = Object.assign(document.createElement("script"), { src: folder + name, onload: done });
    part.onerror = () => failed(new Error(`${name} is missing beside the page`));
    document.head.append(part);
  });
  let ready;
  return {
    /// Runs a program: `args` with its name first, `put` files [path, text or bytes]. `on` is told { text, isError }, { started };
    /// `job.stop` ends it. Ends in { status, trouble, seconds, memory, results: [path, bytes] }; `trouble` is not empty where
    /// there is no status.
    async run(args, put, on, job = {}) {
      const stopped = { status: null, trouble: "stopped", results: [] };
      let packed, early = false;
      job.stop = () => { early = true; };
      if (!ready) {
        await Promise.all([window.ANTILOCK_MESHES ?? script("meshes_data.js"), window.ANTILOCK_PROGRAMS ?? script("programs_data.js")]);
        packed = { wasm: ANTILOCK_PROGRAMS.wasm, meshes: [ANTILOCK_MESHES.packed, ANTILOCK_PROGRAMS.meshes] };
      }
      const source = URL.createObjectURL(new Blob([await antilockSystem.unpacked(ANTILOCK_PROGRAMS.worker)], { type: "text/javascript" }));
      if (early) return stopped;
      return new Promise((done) => {
        const end = (answer) => { own.terminate(); URL.revokeObjectURL(source); done(answer); };
        const own = new Worker(source);
        job.stop = () => end(stopped);
        own.onerror = (event) => end({ status: null, trouble: event.message, results: [] });
        own.onmessage = ({ data }) => {
          if (data.ready) ready = data.ready;
          else if (data.end) end(data);
          else on(data);
        };
        own.postMessage({ packed, ready, args, put });
      });
    },
  };
})();

// ---- What a run leaves, as pictures

/// The chart of a table: its first column of numbers against all others; nothing where this is no curve.
antilock.tableChart = (where, name, text) => {
  const [head, ...rows] = antilock.csv(text);
  const isNumber = head.map((_, k) => rows.every((row) => row[k] !== undefined && row[k] !== "" && Number.isFinite(Number(row[k]))));
  const varies = head.map((_, k) => k).filter((k) => isNumber[k] && new Set(rows.map((row) => row[k])).size > 1), [x] = varies;
  const size = (k) => Math.max(...rows.map((row) => Math.abs(Number(row[k])))), results = varies.filter((k) => k !== x && !["cells", "h", "unknowns", "seconds"].includes(head[k]));
  const curves = results.filter((k) => size(k) > 1e-9 * Math.max(...results.map(size))).slice(0, 5);  // round-off is no curve
  if (rows.length < 3 || rows.length > 2000 || curves.length === 0 || isNumber.includes(false)) return;
  const xs = rows.map((row) => Number(row[x])), rising = xs.every((v, i) => i === 0 || v > xs[i - 1]) || xs.every((v, i) => i === 0 || v < xs[i - 1]);
  if (!rising) return;
  // logarithmic where a list of parameters is closer to powers than to even steps, and where results lie far apart
  const even = (values) => Math.abs((values[1] - values[0]) / (values.at(-1) - values.at(-2)));
  const powers = Math.abs(Math.log(even(xs.map(Math.log)))) < Math.abs(Math.log(even(xs)));
  const axis = (values, title) => {
    const [low, high] = [Math.min(...values), Math.max(...values)], log = low > 0 && (values === xs ? powers : high > 30 * low);
    const decades = log ? Math.max(1, Math.ceil(Math.log10(high / low) / 6)) : 0, ticks = [];
    if (log && high > 10 * low) for (let e = Math.ceil(Math.log10(low)); e <= Math.log10(high); e += decades) ticks.push(10 ** e);
    else for (let k = 0; k < 5; ++k) ticks.push(Number((low + k * (high - low) / 4).toPrecision(2)));
    return { log, range: low < high ? [low, high] : [low - 1, high + 1], ticks, name: title };
  };
  const classes = ["p1", "cr", "exact", "touching", "other"], figure = document.createElement("figure");
  const key = curves.map((k, i) => `<span class="key ${classes[i]}"></span>`).join("");
  figure.innerHTML = `<figcaption></figcaption><p class="live-key-line">${key}</p>`;
  figure.querySelector("figcaption").textContent = name;
  figure.querySelectorAll(".key").forEach((part, i) => { part.textContent = head[curves[i]]; });
  const chart = antilock.chart(figure, { title: name, x: axis(xs, head[x]), y: axis(curves.flatMap((k) => rows.map((row) => Number(row[k]))), "") });
  curves.forEach((k, i) => chart.curve(classes[i], rows.map((row, j) => [xs[j], Number(row[k])]), { markers: rows.length < 40 }));
  where.append(figure);
};

/// The surface of u in a VTU file, which one turns with the mouse, a finger or the arrow keys.
antilock.vtuSurface = (where, name, bytes) => {
  // an array is its length in eight bytes and its numbers, in base64 (lib/antilock/io/write_vtu.cpp)
  const text = new TextDecoder().decode(bytes);
  const array = (named, Numbers) => {
    const base64 = text.match(new RegExp(`Name="${named}"[^>]*>([^<]*)<`))?.[1];
    if (base64 === undefined) return undefined;
    return new Numbers(Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer.slice(8));
  };
  const points = array("points", Float64Array), u = array("u", Float64Array), corners = array("connectivity", Int32Array);
  const types = array("types", Uint8Array);
  if (!points || !u || !corners || !types || 3 * u.length !== points.length) return;
  if (types.some((type) => type !== 5)) return;  // tetrahedra are no surface
  const figure = document.createElement("figure");
  figure.innerHTML = `<figcaption></figcaption><div class="live-canvas"><canvas tabindex="0" role="img"></canvas></div>`;
  const canvas = figure.querySelector("canvas"), turn = [-0.6, 0.6];
  const low = u.reduce((a, b) => Math.min(a, b)), high = u.reduce((a, b) => Math.max(a, b)), largest = Math.max(-low, high) || 1;
  const said = `${name}: u from ${antilock.digits(low)} to ${antilock.digits(high)}`;
  figure.querySelector("figcaption").textContent = `${said}. Drag to turn it.`;
  canvas.setAttribute("aria-label", `Surface of u, ${said}`);
  where.append(figure);
  const scale = 0.25 / largest;  // drawn as high as the figures of the book
  const triangles = new Float32Array(3 * corners.length);
  corners.forEach((v, i) => triangles.set([points[3 * v], points[3 * v + 1], scale * u[v]], 3 * i));
  const paint = antilock.surface(canvas, { at: [] }), draw = () => paint(triangles, [], 0.25, turn);
  antilock.turns(canvas, turn, draw);
  draw();
};

/// The predictions of this page that the reader typed in (book.js keeps them), as one line.
antilock.predictions = () => {
  const inputs = [...document.querySelectorAll(".predictions input")];
  const typed = inputs.filter((input) => input.value.trim());
  const letter = (input) => (input.dataset.question ? `(${input.dataset.question}) ` : "");
  return typed.map((input) => letter(input) + input.value.trim()).join("; ");
};

// ---- The console of a page

for (const box of document.querySelectorAll("#run")) {
  const program = box.dataset.program, playground = program === "run_scene";
  const console_ = document.createElement("div");
  console_.className = "run-console";
  console_.hidden = !playground;
  console_.innerHTML = `
    <div class="live-controls">${playground ? "" : `<label for="run-line"><code>${program}</code></label>
      <input id="run-line" type="text" spellcheck="false" autocapitalize="off" placeholder="options; --help names them">
      <button type="button" id="run-again">run</button>`}
      <button type="button" id="run-stop" disabled>stop</button><span id="run-state" data-state="idle" role="status">nothing has run yet</span></div>
    <div class="live-controls run-sliders"></div>
    <p class="run-predicted" hidden></p>${playground ? "" : `<p class="live-note">Computed here with Eigen’s factor in place of CHOLMOD’s:
      last digits, and counts that hang on round-off, may differ from those of the log in the page.</p>`}<ul class="run-verdicts"></ul><p id="run-warning"></p>
    <pre id="run-output" tabindex="0" hidden></pre><div class="run-pictures"></div><p class="run-files"></p>`;
  box.append(console_);
  const at = (name) => console_.querySelector(name), out = at("#run-output"), state = at("#run-state"), stop = at("#run-stop");
  const buttons = () => document.querySelectorAll("button[data-run], #run-again, #run-scene");
  let line = "", turn = 0, job = {};
  const show = (name, text) => { state.dataset.state = name; state.textContent = text; };

  /// What the program prints, as it comes; VERDICT lines stand above it as well.
  function print(text, isError) {
    out.append(isError ? Object.assign(document.createElement("b"), { textContent: text }) : text);
    out.scrollTop = out.scrollHeight;
    const lines = (line + text).split("\n");
    line = lines.pop();
    for (const [, holds, what] of lines.map((one) => one.match(/^VERDICT (\w+): (.*)/)).filter(Boolean))
      at(".run-verdicts").append(Object.assign(document.createElement("li"), { className: holds === "holds" ? "holds" : "fails", textContent: what }));
  }

  /// Files to keep, tables as charts, u as a surface.
  async function keep(results) {
    const files = at(".run-files"), pictures = at(".run-pictures"), text = (bytes) => new TextDecoder().decode(bytes);
    if (results.length) files.append("To keep: ");
    for (const [path, bytes] of results) {
      await antilock.breath();
      const name = path.split("/").pop(), size = bytes.length < 1e4 ? (bytes.length / 1e3).toFixed(1) : (bytes.length / 1e3).toFixed(0);
      files.append(Object.assign(document.createElement("a"), { href: URL.createObjectURL(new Blob([bytes])), download: name, textContent: `${name} (${size} kB)` }), " ");
      if (name === "solution.vtu") antilock.vtuSurface(pictures, name, bytes);
      else if (name.endsWith(".csv") && name !== "solution.csv" && bytes.length < 2e5) antilock.tableChart(pictures, name, text(bytes));
    }
  }

  /// The sentences of a scene's summary.
  function sum(results) {
    const bytes = results.find(([path]) => path.endsWith("/summary.json"))?.[1];
    if (!bytes) return;
    const { dofs, u_min, u_max, contact, locking, certificate, warning, seconds } = JSON.parse(new TextDecoder().decode(bytes));
    const digits = antilock.digits, said = [`${dofs} unknowns, u from ${digits(u_min)} to ${digits(u_max)}`];
    if (contact) said.push(`${contact.active} of ${contact.points} in contact` + (contact.from === null ? "" : `, from x = ${digits(contact.from)} to ${digits(contact.to)}`));
    if (locking) said.push(`the layer: ${locking.diagnosis}` + (locking.kept === null ? "" : `; at most ${digits(100 * locking.kept)} % of the energy that its motion releases is kept`));
    if (certificate) said.push(`proved relative error of the ${certificate.of}: ${digits(100 * certificate.relative)} %`);
    said.push(`${digits(seconds.total)} s`);
    at(".run-verdicts").append(...said.map((text) => Object.assign(document.createElement("li"), { textContent: text })));
    at("#run-warning").textContent = warning;
  }

  /// A program that answers at once gets a slider per option of its --help that has a range, cells and epsilon.
  async function offerSliders() {
    const place = at(".run-sliders"), chosen = {};
    if (playground || place.dataset.asked) return;
    place.dataset.asked = "";
    let help = "";
    await antilock.programs.run([program, "--help"], [], ({ text }) => { help += text ?? ""; });
    const ask = antilock.soon(() => {
      at("#run-line").value = Object.entries(chosen).map(([name, value]) => `--${name} ${value}`).join(" ");
      again();
    });
    for (const [, name, low, high, value] of help.matchAll(/--(cells|epsilon) \w+:\w+ in \[(\S+) - (\S+)\](?:=| \[)([^\s\]]+)/g)) {
      const cells = name === "cells", range = Object.assign(document.createElement("input"), { type: "range", id: `run-${name}` });
      const shown = document.createElement("output"), label = Object.assign(document.createElement("label"), { htmlFor: range.id, textContent: `${name} = ` });
      label.append(shown);
      if (cells) Object.assign(range, { min: low, max: Math.min(high, 4 * value), step: 1, value });
      else Object.assign(range, { min: Number(low) > 0 ? Math.log10(low) : -8, max: Math.log10(high), step: 0.25, value: Math.log10(value) });
      const number = () => (cells || Number(low) > 0 ? (cells ? range.value : 10 ** range.value) : antilock.epsilonOf(range));
      const say = () => { shown.textContent = antilock.digits(Number(number())); };
      say();
      range.addEventListener("input", () => { say(); chosen[name] = number(); ask(); });
      place.append(label, range);
    }
  }

  async function run(args, put) {
    job.stop?.();
    job = {};
    const own = ++turn;
    for (const name of [".run-verdicts", "#run-output", "#run-warning"]) at(name).replaceChildren();
    console_.hidden = out.hidden = false;
    line = "";
    show("loading", "loading the library");
    stop.disabled = false;
    const began = performance.now();
    const clock = setInterval(() => own === turn && show(state.dataset.state, `${state.dataset.state}, ${((performance.now() - began) / 1e3).toFixed(0)} s`), 500);
    let end;
    try {
      end = await antilock.programs.run([program, ...args], put, (said) => {
        if (own !== turn) return;
        if (said.started) show("running", "running");
        else print(said.text, said.isError);
      }, job);
    } catch (error) { end = { status: null, trouble: error.message, results: [] }; }
    clearInterval(clock);
    if (own !== turn) return;
    stop.disabled = true;
    if (line) print("\n");
    const { status, trouble, seconds, memory, results } = end;
    for (const name of [".run-pictures", ".run-files"]) at(name).replaceChildren();
    sum(results);
    await keep(results);
    if (own !== turn) return;
    if (trouble) show(trouble === "stopped" ? "stopped" : "failed", trouble === "stopped" ? "stopped" : `failed: ${trouble}`);
    else show(status === 0 ? "done" : "failed", `${status === 0 ? "done" : `ended with status ${status}`} in ${seconds.toFixed(1)} s, ${(memory / 2 ** 20).toFixed(0)} MiB`);
    if (status === 0 && seconds < 0.6) await offerSliders();
  }
  stop.addEventListener("click", () => job.stop?.());

  for (const button of document.querySelectorAll("button[data-run]")) {
    button.disabled = false;
    button.addEventListener("click", () => {
      const options = button.dataset.run, exercise = button.closest(".predict");
      const guess = exercise ? exercise.querySelector("input").value : antilock.predictions();
      at("#run-line").value = options;
      at(".run-predicted").hidden = !guess;
      at(".run-predicted").textContent = guess ? `You predicted: ${guess}` : "";
      (button.closest("#run, .predict, .table-wrapper, table") ?? box).after(console_);
      run(options.split(/\s+/).filter(Boolean), []);
    });
  }
  const again = () => run(at("#run-line").value.split(/\s+/).filter(Boolean), []);
  at("#run-again")?.addEventListener("click", again);
  at("#run-line")?.addEventListener("keydown", (event) => event.key === "Enter" && again());
  if (playground) antilock.playground(box, run);
  box.dataset.ready = "";
}
