#include "render/step/step_writer.h"

#include <fmt/format.h>

#include "render/scene/values/characters.h"

namespace lekalo::render {

std::string step_real(double x) {
  std::string text = fmt::format("{}", x == 0 ? 0.0 : x);
  const size_t exponent = text.find('e');
  std::string digits = text.substr(0, exponent);
  if (digits.find('.') == std::string::npos) digits += '.';
  return exponent == std::string::npos ? digits : digits + 'E' + text.substr(exponent + 1);
}

std::string step_string(std::string_view text) {
  std::string result = "'";
  for (size_t at = 0; at < text.size();) {
    const CodePoint letter = decode_utf8(text, at);
    at += letter.length;
    const auto code = static_cast<uint32_t>(letter.code);
    if (code == '\'' || code == '\\')
      result += std::string(2, static_cast<char>(code));
    else if (code >= 0x20 && code < 0x7f)
      result += static_cast<char>(code);
    else if (code <= 0xffff)
      result += fmt::format("\\X2\\{:04X}\\X0\\", code);
    else
      result += fmt::format("\\X4\\{:08X}\\X0\\", code);
  }
  return result + "'";
}

std::string step_list(std::span<const std::string> items) { return fmt::format("({})", fmt::join(items, ",")); }

std::string StepWriter::add(const std::string& entity) {
  lines_ += fmt::format("#{}={};\n", ++count_, entity);
  return fmt::format("#{}", count_);
}

std::string StepWriter::shared(const std::string& entity) {
  std::string& name = shared_[entity];
  if (name.empty()) name = add(entity);
  return name;
}

std::string StepWriter::point(const geometry::Vec3& p) {
  return shared(fmt::format("CARTESIAN_POINT('',({},{},{}))", step_real(p.x), step_real(p.y), step_real(p.z)));
}

std::string StepWriter::direction(const geometry::Vec3& d) {
  return shared(fmt::format("DIRECTION('',({},{},{}))", step_real(d.x), step_real(d.y), step_real(d.z)));
}

std::string StepWriter::placement(const geometry::Vec3& origin, const geometry::Vec3& z, const geometry::Vec3& x) {
  const std::string place = point(origin), axis = direction(z), reference = direction(x);
  return shared(fmt::format("AXIS2_PLACEMENT_3D('',{},{},{})", place, axis, reference));
}

}  // namespace lekalo::render
