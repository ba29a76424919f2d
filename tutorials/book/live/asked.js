// A live figure that a chapter's own functions answer: its live.hpp is that program, which runs in a worker. What
// it prints is the figure's sentence, what it writes are the tables that are drawn.
"use strict";
/// { said, tables: name -> rows, as objects } of the figure of chapter `stem`; an Error with the program's own line.
antilock.answer = async (stem, options) => {
  const args = Object.entries(options).flatMap(([name, value]) => [`--${name}`, String(value)]);
  const said = { true: "", false: "" };
  const { status, trouble, results } = await antilock.programs.run([`figure_${stem}`, ...args, "--out", "figure"], [],
    ({ text = "", isError = false }) => { said[isError] += text; });
  if (status !== 0) throw new Error(said.true.trim().replace(/^figure_\w+: /, "") || trouble);
  const tables = {};
  for (const [path, bytes] of results) {
    const [head, ...rows] = antilock.csv(new TextDecoder().decode(bytes));
    tables[path.match(/([^/]*)\.csv$/)?.[1]] = rows.map((row) => Object.fromEntries(row.map((text, k) => [head[k], Number.isNaN(Number(text)) ? text : Number(text)])));
  }
  return { said: said.false.trim().split("\n").slice(1, -1).join(" "), tables };
};

/// Calls `then` once the reader comes near: what a page holds further down is asked for when it is needed.
antilock.whenNear = (box, then) => {
  const watch = new IntersectionObserver(([one]) => {
    if (!one.isIntersecting) return;
    watch.disconnect();
    then();
  }, { rootMargin: "300px" });
  box.dataset.state = "asleep";
  watch.observe(box);
};

/// `figure`: title; stem of its chapter; controls: option -> { label, start, and values | range: [min, max, step] of a number,
/// or of its power of ten where `power`; keys: class of a curve -> what it is; make(place, ask) draws the empty figure, and
/// gives the function that draws { said, tables } into it; `more` are options besides those of the controls.
antilock.asked = (box, { title, stem, controls, keys = {}, make }) => {
  const id = `live-${box.dataset.kind}`, still = document.createElement("div"), names = Object.keys(controls);
  const control = ([name, { label, start, values, range }]) => (values
    ? `<span class="live-choice"><label for="${id}-${name}">${label}</label> <select id="${id}-${name}">
       ${values.map((value) => `<option${value === start ? " selected" : ""}>${value}</option>`).join("")}</select></span>`
    : `<label for="${id}-${name}">${label} = <output></output></label>
       <input id="${id}-${name}" type="range" min="${range[0]}" max="${range[1]}" step="${range[2]}" value="${start}">`);
  still.innerHTML = `
    <p class="live-title">${title}</p>
    <div class="live-controls">${Object.entries(controls).map(control).join("")}</div>
    <div class="live-drawing"></div>
    <p class="live-key-line">${Object.entries(keys).map(([name, text]) => `<span class="key ${name}">${text}</span>`).join(" ")}</p>
    <p class="live-said" role="status"></p>`;
  const inputs = names.map((name) => still.querySelector(`#${id}-${name}`)), said = still.querySelector(".live-said");
  const value = (name, input) => (controls[name].power ? antilock.epsilonOf(input, Boolean(controls[name].zero)) : input.value);
  const more = {};
  const ask = antilock.soon(async () => {
    const options = { ...Object.fromEntries(names.map((name, i) => [name, value(name, inputs[i])])), ...more };
    names.forEach((name, i) => {
      const shown = inputs[i].previousElementSibling?.querySelector("output");
      if (shown) shown.innerHTML = controls[name].power ? antilock.epsilonShown(inputs[i], options[name]) : options[name];
    });
    try {
      const answer = await antilock.answer(stem, options);
      draw(answer, options);
      said.textContent = answer.said;
      numbers(answer.tables);
      box.dataset.state = "ready";
    } catch (error) {
      said.textContent = antilock.refusal(error);
      box.dataset.state = "failed";
    }
    box.dataset.asked = JSON.stringify(options);
  });
  const draw = make(still.querySelector(".live-drawing"), (options) => { Object.assign(more, options); ask(); });
  for (const input of inputs) input.addEventListener("input", ask);
  box.setAttribute("aria-label", `Live figure: ${title}`);
  box.replaceChildren(...still.children);
  const numbers = antilock.numbers(box);
  antilock.whenNear(box, ask);
};
