#pragma once
#include <filesystem>
#include <string>

#include "antilock/space/space.hpp"
#include "antilock/study/method.hpp"

namespace antilock::tutorial {

/// Two functions of G_h, the kernel of the paper's stiff form on this space: the orthogonal projections onto it of one
/// unknown in the middle of the layer (scaled to 1), and of sin(pi x). What is not in the kernel cannot survive
/// epsilon -> 0. Files NAME_local.vtu and NAME_sine.vtu, NAME in small letters with _ in place of blanks.
void draw_kernel(const std::filesystem::path& out, const Space& space, std::string name);

/// The inf-sup constant of B on the mesh of 1/n; "all displacements" are P1 on that mesh refined twice.
double inf_sup_constant(const Method& method, int n);

}  // namespace antilock::tutorial
