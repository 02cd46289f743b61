// Where a file lies that a model file names.
#pragma once

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string>

namespace lekalo::render {

// The path as it is, if a file lies there; else with %20 and its like as the characters that they mean (glTF 2.0, 2.8),
// else with / for \ (files from Windows); the path as it is where none of these is there either.
inline std::string stored_path(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error)) return path;
  std::string plain;
  for (size_t i = 0; i < path.size(); ++i) {
    unsigned char value = 0;
    const char* digits = path.data() + i + 1;
    if (path[i] == '%' && i + 2 < path.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      plain += static_cast<char>(value);
      i += 2;
    } else {
      plain += path[i];
    }
  }
  if (std::filesystem::exists(plain, error)) return plain;
  std::string turned = path;
  std::replace(turned.begin(), turned.end(), '\\', '/');
  return std::filesystem::exists(turned, error) ? turned : path;
}

}  // namespace lekalo::render
