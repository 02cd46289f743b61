// Modules of the program: shared libraries that wrap what is needed seldom and costs much to load.
#pragma once

#include <string>

namespace lekalo::render {

// The function of a module, which stays loaded; null if it cannot be had, and `tried` says where it was looked for,
// each place after "; ". Looked for in the folder that the environment variable LEKALO_MODULE_PATH names, beside the
// program, and in ../lib/lekalo from there.
void* module_function(const char* file, const char* name, std::string& tried);

}  // namespace lekalo::render
