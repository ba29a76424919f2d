#pragma once
#include <string>
#include <vector>

namespace antilock {

/// The part of a .geo script that draws, in the words of a language without side effects: gmsh
/// reads it in place of the file. A .geo script is a program: it may run commands of the machine,
/// and read and write files. Nobody expects that of a drawing, so that gmsh never sees the text
/// itself.
///
/// What is returned consists of numbers, of signs, of words from a list of commands that draw, and
/// of variables, which are called v_1, v_2, ... in place of their names. The only texts in quotation
/// marks are "OpenCASCADE" and "Built-in". So no word of the file's own choice reaches gmsh, and
/// whatever the order of its words, it can name no file and start no program. Tokens keep their lines, so that gmsh's own messages name the
/// right one.
///
/// An index outside of 0 to 1e6 becomes a division by zero, which gmsh reports: gmsh itself would
/// write before its list.
///
/// Left out are comments and the statements that concern the mesh alone: Mesh, Physical, Field,
/// Characteristic Length, Transfinite and the like, and Printf without a file; in them nothing is accepted that
/// draws or assigns, and no number is accepted that counts them. Accepted beyond
/// that: variables, lists, For, DefineConstant, arithmetic, points, curves, surfaces, solids,
/// transformations, Boolean operations and numbers of Geometry. Throws Error, `line N: NAME: ...`,
/// for anything else.
std::string geometry_script(const std::string& text);

/// The words that geometry_script may write beside numbers, signs, kernels and variables.
std::vector<std::string> geometry_script_commands();

}  // namespace antilock
