#pragma once
#include <filesystem>
#include <string>

#include "antilock/distributed/nested.hpp"

namespace antilock::distributed {

/// What a run leaves behind after each level, for --restart: the contact set by x. It serves any number of ranks.
struct Checkpoint {
  std::string question;  ///< question_of the scene that it belongs to
  int cells = 0;         ///< cells per unit side of the level that was solved
  ContactSet set;
};

/// A hash of everything that the answer depends on: the scene file and the mesh file behind it, byte by byte.
std::string question_of(const std::filesystem::path& scene, const std::filesystem::path& mesh);

/// The file beside the results folder OUT: OUT.checkpoint.
std::filesystem::path checkpoint_path(const std::filesystem::path& out);
/// Whole or not at all. Throws Error.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
/// Throws Error where there is none, where it is damaged or belongs to another question.
Checkpoint read_checkpoint(const std::filesystem::path& path, const std::string& question);

}  // namespace antilock::distributed
