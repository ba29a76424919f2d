#pragma once
#include <filesystem>

#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"

namespace antilock::tutorial {

/// What chapter 11 draws. results.csv: one row per quantity (to_k, to_k0, c_h, k_h), method and mesh, without what is 0
/// up to round-off. trace.csv: u_h on Gamma_C around the end of contact, of P1, CR (unstructured: it slopes) and P2 on
/// meshes of 1/16, beside the truth.
void write_contact_sets(const std::filesystem::path& out, const Table& results, const Exact& u);

}  // namespace antilock::tutorial
