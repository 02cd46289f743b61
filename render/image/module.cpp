#include "render/image/module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

namespace lekalo::render {
namespace fs = std::filesystem;

namespace {

// Where the module may be, best first.
std::vector<fs::path> module_files(const char* name) {
  std::vector<fs::path> files;
  if (const char* folder = std::getenv("LEKALO_MODULE_PATH")) files.push_back(fs::path(folder) / name);
  std::error_code error;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error) {
    files.push_back(program.parent_path() / name);
    files.push_back(program.parent_path().parent_path() / "lib" / "lekalo" / name);
  }
  return files;
}

}  // namespace

void* module_function(const char* file_name, const char* name, std::string& tried) {
  for (const fs::path& file : module_files(file_name)) {
    std::error_code error;
    if (!fs::exists(file, error)) {
      tried += "; no " + file.string();
      continue;
    }
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = library == nullptr ? nullptr : ::dlsym(library, name);
    if (symbol != nullptr) return symbol;
    const char* reason = ::dlerror();
    tried += std::string("; ") + (reason != nullptr ? reason : file.c_str());
  }
  return nullptr;
}

}  // namespace lekalo::render
