// The library, compiled to WebAssembly (live_data.js), as a few calls. No network: it opens from a folder too.
"use strict";
const antilock = {};

antilock.data = (() => {
  let ready;
  return () => (ready ??= (async () => {
    const packed = window.ANTILOCK_LIVE, { Files, unpacked, putMeshes } = antilockSystem, files = new Files();
    if (!packed || !window.ANTILOCK_MESHES) throw new Error("live_data.js or meshes_data.js is missing");
    await putMeshes(files, window.ANTILOCK_MESHES.packed);
    return { module: await WebAssembly.compile(await unpacked(packed.wasm)), files };
  })());
})();

/// A fresh instance of the library.
antilock.library = async () => {
  const { module, files } = await antilock.data(), system = new antilockSystem.System({ files });
  let memory, said = "";
  const text = (at) => {
    const all = new Uint8Array(memory.buffer);
    return new TextDecoder().decode(all.slice(at, all.indexOf(0, at)));
  };
  const thrown = (at) => { said = text(at); };
  const { exports } = await WebAssembly.instantiate(module, { page: { thrown }, wasi_snapshot_preview1: system.imports() });
  memory = system.memory = exports.memory;
  exports._initialize?.();
  const call = (name, ...numbers) => {
    said = "";
    const answer = exports[name](...numbers);
    if (said) throw new Error(said);
    return answer;
  };

  // memory.buffer is another one where a call has asked for more memory: it is looked up after the call
  const doubles = (at, count) => new Float64Array(memory.buffer, at, count);
  const line = (at) => doubles(at, call("line_size")).slice();
  const kinds = ["structured", "unstructured", "moved", "layered"];
  return {
    discretise: (element, mesh, cells, moved) => call("discretise", element, kinds.indexOf(mesh), cells, moved),
    /// Makes a mesh and its factor, for a discretise to come.
    prepare: (element, mesh, cells, moved, epsilon) => call("prepare", element, kinds.indexOf(mesh), cells, moved, epsilon),
    solve(element, epsilon) {
      const [largest, ridge, error, ms, unknowns, corrections, factorisations, touching, contact, from] =
        doubles(call("solve", element, epsilon), 10);
      return { largest, ridge, error, ms, unknowns, corrections, factorisations, touching, contact, from, kept: 100 * largest / ridge };
    },
    warning: (element) => text(call("warning", element)),
    surface: (element) => {
      const at = call("surface", element), size = call("surface_size");
      return new Float32Array(memory.buffer, at, size).slice();
    },
    trace: (element) => line(call("trace", element)),
    ridge: (epsilon, points) => line(call("ridge", epsilon, points)),
    roundOff(cells, epsilon) {
      const [split, summed] = doubles(call("round_off", cells, epsilon), 2);
      return { split, summed };
    },
  };
};

/// The one that figures of a page share; a new one where it could not be made.
antilock.shared = () => (antilock.sharedLibrary ??= antilock.library().catch((error) => { antilock.sharedLibrary = null; throw error; }));

// ---- What the figures share.

/// epsilon of a range input: its value is log10 epsilon; its lowest position is exactly 0, where the figure has that.
antilock.epsilonOf = (range, zero = true) => (zero && Number(range.value) <= Number(range.min) ? 0 : Number((10 ** Number(range.value)).toPrecision(12)));  // 1e-4, not 9.9999e-5
antilock.epsilonSaid = (range, epsilon) => (epsilon === 0 ? "0, the limit" : epsilon === 1 ? "1" : `10^${range.value}`);
antilock.epsilonShown = (range, epsilon) =>
  epsilon === 0 ? "0, the limit" : epsilon === 1 ? "1" : `10<sup>${range.value.replace("-", "−")}</sup>`;
antilock.refusal = (error) => `No answer: ${error.message}. Choose something else; the page goes on.`;
/// A CSV text as rows of texts; the first one is its head.
antilock.csv = (text) => text.trim().split("\n").map((row) => row.split(","));
antilock.digits = (x, n = 2) => (x === 0 ? "0" : Math.abs(x) < 1e-3 || Math.abs(x) >= 1e4 ? x.toExponential(n - 1) : String(Number(x.toPrecision(n + 1))));

/// Calls `update` once per picture drawn, however often it is asked, and never twice at once.
antilock.soon = (update) => {
  let busy = false, again = false;
  return async () => {
    again = true;
    if (busy) return;
    for (busy = true; again;) {
      again = false;
      await new Promise(requestAnimationFrame);
      await update();
    }
    busy = false;
  };
};

/// Lets the page draw, and answer a reader, between two pieces of work.
antilock.breath = () => new Promise((go) => setTimeout(go));
antilock.whenIdle = window.requestIdleCallback?.bind(window) ?? ((task) => setTimeout(task, 100));

antilock.figures = {};
/// Fills every live figure of the page; where one cannot be, its still stays, with a sentence.
antilock.start = async () => {
  for (const box of document.querySelectorAll("div.live")) {
    const still = box.innerHTML;
    try {
      if (typeof WebAssembly === "undefined") throw new Error("this browser has no WebAssembly");
      if (typeof DecompressionStream === "undefined") throw new Error("this browser is too old: it has no DecompressionStream");
      box.setAttribute("role", "group");
      await antilock.figures[box.dataset.kind](box);
    } catch (error) {
      box.innerHTML = still;
      box.querySelector(".live-still").textContent = `This is a still: ${error.message}.`;
      box.dataset.state = "still";
    }
  }
};
