#include "render_command.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace lekalo::command {

namespace {

constexpr int kMaxParts = 100000;

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && rest == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<render::PicturePart> parse_part(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const size_t slash = text.find('/');
  const auto number = whole_number(std::string_view(text).substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(slash + 1));
  if (!number || !count || *number < 1 || *number > *count || *count > kMaxParts)
    throw UsageError(fmt::format("--tile takes I/N, for example 3/8, with I from 1 to N, found '{}'", text));
  return render::PicturePart{*number - 1, *count};
}

std::string partial_of(const std::string& output, const std::optional<render::PicturePart>& part) {
  return part ? fmt::format("{}.{}of{}.partial", output, part->index + 1, part->count) : output + ".partial";
}

std::string job_of(const RenderCommand& command, const Frame& frame, const std::vector<std::string>& outputs,
                   const std::vector<std::string>& layers) {
  nlohmann::json job;
  job["scene"] = std::filesystem::absolute(command.scene.file).lexically_normal().string();
  std::vector<std::string> set = command.scene.set;
  if (frame.setting) set.push_back(frame.setting->name + "=" + frame.setting->value);
  job["set"] = set;
  job["allow_external"] = command.scene.allow_external;
  job["isa"] = command.engine.instruction_set;
  job["outputs"] = outputs;
  job["layers"] = layers;
  job["size"] = command.size;
  job["crop"] = command.crop;
  job["samples"] = command.samples;
  job["representation"] = command.representation;
  job["half"] = command.half;
  job["stamp"] = command.stamp;
  return job.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

RenderCommand command_of(const std::string& text) {
  try {
    const nlohmann::json job = nlohmann::json::parse(text);
    RenderCommand command;
    job.at("scene").get_to(command.scene.file);
    job.at("set").get_to(command.scene.set);
    job.at("allow_external").get_to(command.scene.allow_external);
    job.at("isa").get_to(command.engine.instruction_set);
    job.at("outputs").get_to(command.outputs);
    job.at("layers").get_to(command.layers);
    job.at("size").get_to(command.size);
    job.at("crop").get_to(command.crop);
    job.at("samples").get_to(command.samples);
    job.at("representation").get_to(command.representation);
    job.at("half").get_to(command.half);
    job.at("stamp").get_to(command.stamp);
    return command;
  } catch (const nlohmann::json::exception&) {
    throw std::invalid_argument("the partial picture does not say how it was asked for");
  }
}

}  // namespace lekalo::command
