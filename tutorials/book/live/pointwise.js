// A figure that the reader makes: every epsilon that is asked for leaves its two points.
"use strict";
/// `figure`: title and label; min, step and stride of log10 epsilon; zero: where epsilon = 0 is drawn, if the lowest
/// position is 0; choices: name -> values; start: name -> the value chosen, if it is not the first; keys of the curves, five
/// at most; refused: the value that stands for no answer, if there is one; others: the key of the points of other choices,
/// if they stay; axes; ask(epsilon, chosen) -> the values; asleep: the first one is asked for when the reader comes near.
antilock.pointwise = async (box, figure) => {
  if (!figure.asleep) await antilock.shared();  // without it the still stays
  const classes = ["p1", "cr", "exact", "touching", "other"];
  const id = `live-${box.dataset.kind}`, still = document.createElement("div"), names = Object.keys(figure.choices);
  still.innerHTML = `
    <p class="live-title">${figure.title}</p>
    <div class="live-controls">
      <label for="${id}-epsilon">ε = <output></output></label>
      <input id="${id}-epsilon" type="range" min="${figure.min}" max="0" step="${figure.step}" value="0">
      ${names.map((name) => `<span class="live-choice"><label for="${id}-${name}">${name === "cells" ? "1/h" : name}</label>
        <select id="${id}-${name}">${figure.choices[name].map((value) => `<option${value === figure.start?.[name] ? " selected" : ""}>${value}</option>`).join("")}</select></span>`).join("")}
      <span class="live-choice"><button type="button">all ε</button> <button type="button">clear</button></span>
    </div>
    <div class="live-drawing"></div>
    <p class="live-key-line">${figure.keys.map((key, i) => `<span class="key ${classes[i]}">${key}</span>`).join(" ")}
      ${figure.refused ? '<span class="key touching">refused: no answer</span>' : ""}
      ${figure.others ? `<span class="key other">${figure.others}</span>` : ""}</p>
    <p class="live-said" role="status"></p>`;
  const range = still.querySelector("input"), selects = [...still.querySelectorAll("select")], [all, clear] = still.querySelectorAll("button");
  const output = still.querySelector("output"), said = still.querySelector(".live-said");
  const chart = antilock.chart(still.querySelector(".live-drawing"), figure.axes);
  let points = {};  // per choice a Map of epsilon to the two values
  const refused = (value) => value === figure.refused;
  const chosen = () => Object.fromEntries(names.map((name, i) => [name, selects[i].value]));
  const curve = (key, i) => [...(points[key] ?? [])].sort((a, b) => a[0] - b[0]).map(([e, values]) => [e || figure.zero, values[i]]);
  function draw() {
    const key = Object.values(chosen()).join(" ");
    if (figure.others) {
      const before = Object.keys(points).filter((other) => other !== key);
      chart.curve("other", before.flatMap((other) => figure.keys.flatMap((_, i) => curve(other, i))), { joined: false, markers: true });
    }
    figure.keys.forEach((_, i) => chart.curve(classes[i], curve(key, i).filter(([, value]) => !refused(value)), { markers: true }));
    if (figure.refused) chart.curve("touching", curve(key, 0).filter(([, value]) => refused(value)), { joined: false, markers: true });
    box.dataset.points = points[key]?.size ?? 0;
    const rows = [...(points[key] ?? [])].sort((a, b) => b[0] - a[0]);
    const heads = figure.keys.map((key) => key.replace(/<[^>]*>/g, ""));
    const cell = (value) => (refused(value) ? "refused" : value);
    numbers({ [figure.label]: rows.map(([epsilon, values]) =>
      Object.fromEntries([["ε", epsilon], ...heads.map((head, i) => [head, cell(values[i])])])) });
  }
  async function update() {
    const epsilon = antilock.epsilonOf(range, Boolean(figure.zero));
    output.innerHTML = antilock.epsilonShown(range, epsilon);
    range.setAttribute("aria-valuetext", `epsilon is ${antilock.epsilonSaid(range, epsilon)}`);
    try {
      const now = chosen(), values = await figure.ask(epsilon, now);
      (points[Object.values(now).join(" ")] ??= new Map()).set(epsilon, values);
      draw();
      const text = values.map((value, i) => `${figure.keys[i]} ${refused(value) ? "refused" : antilock.digits(value)}`).join(", ");
      said.textContent = `${text}; ${box.dataset.points === "1" ? "1 point" : `${box.dataset.points} points`}.`;
      chart.said(text);
      Object.assign(box.dataset, { state: "ready", p1: values[0], cr: values[1], epsilon, values: values.join(" ") });
    } catch (error) {
      antilock.sharedLibrary = null;
      said.textContent = antilock.refusal(error);
      box.dataset.state = "failed";
    }
  }
  const soon = antilock.soon(update);
  for (const part of [range, ...selects]) part.addEventListener("input", soon);
  all.addEventListener("click", async () => {
    const atOnce = matchMedia("(prefers-reduced-motion: reduce)").matches;
    for (let x = 0; x >= figure.min; x -= figure.stride) {
      range.value = x;
      await update();
      if (!atOnce) await new Promise(requestAnimationFrame);
    }
  });
  clear.addEventListener("click", () => { points = {}; draw(); said.textContent = ""; });
  box.setAttribute("aria-label", `Live figure: ${figure.label}`);
  box.replaceChildren(...still.children);
  const numbers = antilock.numbers(box);
  if (figure.asleep) antilock.whenNear(box, soon);
  else await update();
};
