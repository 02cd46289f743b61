// Where the scenes and data that come with the program lie (studio set-ups, the teapot's patches).
#pragma once

#include <filesystem>
#include <vector>

namespace lekalo::render {

// Folders with shipped scenes and a user's own, those that exist, in the order in which a file is searched: beside the
// running program (../share/lekalo/scenes, as in the build tree and in an installed one), then lekalo/scenes of the
// user's data folder ($XDG_DATA_HOME, else ~/.local/share) and of those of the system ($XDG_DATA_DIRS, else
// /usr/local/share and /usr/share): archives of models, personal and shared (Zavyalov et al. 1985, VII.1). Every path
// is absolute. Empty if the program was copied away from its tree.
std::vector<std::filesystem::path> data_folders();

}  // namespace lekalo::render
