// Shipped scenes are found relative to the program, never by a path fixed when it was built: an installed tree can be
// moved, and the program has the same bits wherever it was built. XDG Base Directory Specification 0.8.

#include "render/scene/yaml/data_path.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>

namespace lekalo::render {

std::vector<std::filesystem::path> data_folders() {
  std::vector<std::filesystem::path> candidates;
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);  // resolved by the kernel
  if (!error) candidates.push_back(program.parent_path().parent_path() / "share/lekalo/scenes");

  const auto value = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
  std::string personal = value("XDG_DATA_HOME");
  if (!personal.starts_with('/') && value("HOME").starts_with('/')) personal = value("HOME") + "/.local/share";
  if (personal.starts_with('/')) candidates.push_back(std::filesystem::path(personal) / "lekalo/scenes");

  const char* variable = std::getenv("XDG_DATA_DIRS");
  std::istringstream list(variable != nullptr && *variable != '\0' ? variable : "/usr/local/share:/usr/share");
  for (std::string folder; std::getline(list, folder, ':');)
    if (folder.starts_with('/')) candidates.push_back(std::filesystem::path(folder) / "lekalo/scenes");

  std::erase_if(candidates, [&](const auto& folder) { return !std::filesystem::is_directory(folder, error); });
  return candidates;
}

}  // namespace lekalo::render
