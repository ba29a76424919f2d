// The round-off exhibit: the sum of both forms in one matrix against the split form, P1 on the structured mesh.
"use strict";
antilock.figures.roundoff = (box) => antilock.pointwise(box, {
  title: "Try it: one matrix for both forms, or the split form", label: "round-off, both forms summed against the split form",
  min: -16, step: 0.5, stride: 1, choices: { cells: [8, 16, 32] }, start: { cells: 16 }, keys: ["both forms summed", "split form"], refused: 1,
  axes: { title: "Largest error at the unknowns against epsilon, P1 on the structured mesh",
    x: { log: true, range: [4e-17, 2.5], ticks: [1e-16, 1e-12, 1e-8, 1e-4, 1], name: "ε" },
    y: { log: true, range: [1e-4, 1], ticks: [1e-4, 1e-3, 1e-2, 1e-1, 1], name: "largest error" } },
  async ask(epsilon, { cells }) {
    const { split, summed } = (await antilock.shared()).roundOff(Number(cells), epsilon);
    return [summed, split];
  },
});
