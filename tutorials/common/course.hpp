#pragma once
// What almost every chapter uses: methods and meshes, the paper's problem, the solver, tables, the report.
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"
