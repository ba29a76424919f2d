#pragma once
#include <filesystem>
#include <string>

#include "antilock/distributed/nested.hpp"

namespace antilock::distributed {

/// The data that a run writes after each level for --restart: the contact set by x. It is fit for
/// any number of ranks.
struct Checkpoint {
  std::string question;  ///< question_of the scene of the run
  int cells = 0;         ///< cells per unit side of the level that was solved
  ContactSet set;
};

/// Returns a hash of the data on which the solution depends: the bytes of the scene file and of its
/// mesh file.
std::string question_of(const std::filesystem::path& scene, const std::filesystem::path& mesh);

/// Returns the path of the checkpoint of a folder of results OUT: OUT.checkpoint, beside the
/// folder.
std::filesystem::path checkpoint_path(const std::filesystem::path& out);
/// Writes a checkpoint, whole or not at all. Throws Error.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
/// Reads a checkpoint. Throws Error where there is none, and where it is damaged or belongs to
/// another scene.
Checkpoint read_checkpoint(const std::filesystem::path& path, const std::string& question);

}  // namespace antilock::distributed
