#pragma once
/// What a chapter that studies problem (23) over methods, meshes and epsilons includes: Method, SceneSweep, Table, the
/// exact solutions, the program around it.
#include <cmath>
#include <numbers>

#include "antilock/form/forms.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "common/course.hpp"
