// The one exception of picture input and output.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace lekalo::render {

// A picture (or another output file) cannot be read, written or compared. what() is a complete sentence for the user:
// "FILE: REASON (REMEDY)". The command ends with code 4 when it sees one.
struct ImageError : std::runtime_error {
  ImageError(const std::filesystem::path& file, const std::string& reason, const std::string& remedy)
      : std::runtime_error(file.string() + ": " + reason + " (" + remedy + ")") {}
};

}  // namespace lekalo::render
