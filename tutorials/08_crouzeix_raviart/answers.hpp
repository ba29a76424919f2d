#pragma once
// The answers to the exercises of 08_crouzeix_raviart, whose page includes this one: to be
// read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Interpolate u^0 with P1, values at the vertices of the same meshes. Is B I_h u^0 = "
     "0?",
     "no: it is of the order h |u''|, and times epsilon^-2 that is not small",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Table lemma = interpolate({8, 16, 32, 64}, p1());
       lemma.print("P1");
       report.claim(lemma.min("strain") > 1e-3, "the strain is not 0: {:.1e} at least",
                    lemma.min("strain"));
       report.claim_order(lemma, "strain", "h", 0.6, 1.2, "the largest strain");
     }},
    {"Structured: on 1/h = 32 the error is 1.03e-3. Predict that on 64 at epsilon = 1e-6. "
     "Then at 0, and at 1e-2.",
     "between 2^(3/2) and 2^2 times smaller (the end of contact, and interpolation); the "
     "same at every epsilon, to 10 "
     "%",
     [](const tutorial::Options&, tutorial::Report& report) {
       const auto error = [](int cells, double epsilon) {
         const Space space = Method{&crouzeix_raviart(), structured()}.space(cells);
         const Solution solution =
             active_set(assemble(tutorial::paper_scene(epsilon), space));
         return tutorial::Exact(tutorial::paper_scene(epsilon))
             .errors(space, solution)
             .max_at_unknowns;
       };
       const double on_32 = error(32, 1e-6), on_64 = error(64, 1e-6);
       report.claim_within(on_32 / on_64, 2.7, 4.2,
                           fmt::format("error on 1/32, {:.3g}, / error on 1/64:", on_32));
       for (const double epsilon : {1e-2, 0.0})
         report.claim_within(error(64, epsilon) / on_64, 0.9, 1.1,
                             fmt::format("epsilon = {} / 1e-6:", epsilon));
     }}};

// ## Answers on paper
//
// **3.** P1 takes over values at vertices, and the mean of $I_h v$ over an edge is the mean
// of its two ends. That is in general not the mean of $v$: for a parabola in $x$ on an edge
// from $x_1$ to $x_2$ the two differ by $(x_2 - x_1)^2 v''/12$. On a vertical edge they
// agree, and on all three edges where $v$ is affine. So Green's formula does not give
// $∫_T ∇I_h v = ∫_T ∇v$, and $∂_y v = 0$ does not give $∂_y I_h v = 0$: on a triangle
// without a vertical edge the slope is of size $h |v''|$ (exercise 1). In (23) its square
// is multiplied by $ε^{-2}$.
