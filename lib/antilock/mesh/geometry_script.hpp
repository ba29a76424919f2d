#pragma once
#include <string>
#include <vector>

namespace antilock {

/// Returns the drawing commands of a .geo script in a language without side effects, which gmsh
/// reads in place of the file. A .geo script is a program: it may run commands of the machine, and
/// read and write files. A user does not expect this of a drawing. Therefore gmsh never reads the
/// text itself.
///
/// The returned text consists of numbers, signs, words from a list of drawing commands, and
/// variables, which are called v_1, v_2, ... in place of their names. The only texts in quotation
/// marks are "OpenCASCADE" and "Built-in". So every word that gmsh reads comes from this library.
/// In no order can these words name a file or start a program. Tokens keep their lines, so that the
/// messages of gmsh name the right line.
///
/// With an index outside of 0 to 1e6 gmsh would write outside of its list. Therefore such an index
/// is replaced by a division by zero, which gmsh reports as an error.
///
/// Comments are left out. Statements that concern the mesh alone are left out, too: Mesh, Physical,
/// Field, Characteristic Length, Transfinite and the like, and Printf without a file. They may not
/// contain a command that draws, or change a variable. Numbers that depend on a statement that was
/// left out are refused. An example is newl, the next free number of a line, after a Physical
/// group. Also accepted are variables, lists, For, DefineConstant, arithmetic, points, curves,
/// surfaces, solids, transformations, Boolean operations and numbers of Geometry. Throws Error,
/// `line N: NAME: ...`, for anything else.
std::string geometry_script(const std::string& text);

/// Returns the words that geometry_script may write, except for numbers, signs, kernels and
/// variables.
std::vector<std::string> geometry_script_commands();

/// Returns the names of the options that geometry_script may write behind `Geometry.`.
std::vector<std::string> geometry_script_options();

}  // namespace antilock
