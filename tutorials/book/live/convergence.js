// The reader makes Figure 9: the error against epsilon, on the mesh of the reader's choice.
"use strict";
antilock.figures.convergence = (box) => {
  const zero = 1e-8;
  return antilock.pointwise(box, {
    title: "Make the figure: every ε you drag over leaves its point", label: "the error against epsilon, point by point",
    min: -8, step: 0.25, stride: 0.5, zero,
    choices: { mesh: ["unstructured", "structured", "layered"], cells: [8, 16, 24, 32] }, start: { cells: 16 },
    keys: ["P1", "Crouzeix–Raviart"], others: "points of the meshes before",
    axes: { title: "Largest error at the unknowns against epsilon",
      x: { log: true, range: [zero * 0.6, 1.6], ticks: [zero, 1e-6, 1e-4, 1e-2, 1], names: { [zero]: "0" }, name: "ε" },
      y: { log: true, range: [3e-5, 1e-1], ticks: [1e-4, 1e-3, 1e-2, 1e-1], name: "largest error" } },
    ask: async (epsilon, { mesh, cells }) => {
      const library = await antilock.shared();
      return [0, 1].map((i) => {
        library.discretise(i, mesh, Number(cells), 0);
        return library.solve(i, epsilon).error;
      });
    },
  });
};
