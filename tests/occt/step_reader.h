// STEP text as OCCT reads it.
#pragma once

#include <fmt/format.h>
#include <unistd.h>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Reader.hxx>
#include <TopoDS_Shape.hxx>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace lekalo::tests {

inline TopoDS_Shape read_step(const std::string& text) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("lekalo_occt_test_{}.step", getpid());
  std::ofstream(path) << text;
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  STEPControl_Reader reader;
  const bool is_read = reader.ReadFile(path.c_str()) == IFSelect_RetDone;
  std::filesystem::remove(path);
  if (!is_read) throw std::runtime_error("OCCT does not read the STEP file");
  reader.TransferRoots();
  return reader.OneShape();
}

}  // namespace lekalo::tests
