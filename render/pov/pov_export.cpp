// Camera, lights and objects in POV-Ray's terms (POV-Ray 3.7 documentation, "Camera", "Light Sources").
//
// POV-Ray's space is left-handed only by the default vectors of its camera; with `right` and `up` given, every
// coordinate stands as it is. Its rays go through location + x right + y up with x, y in [-1/2, 1/2] (orthographic), or
// along direction + x right + y up (perspective).
#include "render/pov/pov_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/integrators/classic.h"
#include "render/lights/lights.h"
#include "render/model/face_materials.h"
#include "render/pov/pov_parts.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// POV-Ray's decay is 2 / (1 + (d / fade_distance)^2): with a short distance an inverse square but for this squared.
constexpr double kFadeDistance = 1e-4;

// Area lights of up to this many samples become point lights: POV-Ray's own area_light multiplies the mean light of the
// samples with the share of them that is seen, which is not the mean of the light that is seen.
constexpr int kMaxPointLights = 256;

std::string camera(const Model& model) {
  const Camera& camera = *model.camera;
  const double w = camera.width(), h = camera.height();
  const auto at = [&](double x, double y) {
    const Ray ray = camera.ray(x, y);
    return camera.is_parallel() ? ray.origin : ray.direction / glm::dot(ray.direction, camera.view_direction());
  };
  const Vec3 right = at(w, 0.5 * h) - at(0, 0.5 * h), up = at(0.5 * w, 0) - at(0.5 * w, h);
  return fmt::format("camera {{ {}\n  location {}\n  direction {}\n  right {}\n  up {} }}\n",
                     camera.is_parallel() ? "orthographic" : "perspective", pov(camera.ray(0.5 * w, 0.5 * h).origin),
                     pov(camera.view_direction()), pov(right), pov(up));
}

class Writer {
 public:
  Writer(const Model& model, const PovOptions& options) : model_(model), options_(options) {
    box_ = bounds(model);
    if (box_.empty() || !box_.bounded()) box_ = {Vec3(-1), Vec3(1)};
  }

  PovScene scene() {
    if (!model_.camera) throw std::invalid_argument("the model has no camera");
    std::string text = "#version 3.7;\n" + settings() + camera(model_);
    text += fmt::format("background {{ {} }}\n", pov_rgb(model_.background));
    for (const LightPtr& light : model_.lights)
      if (light->ambient().is_zero()) text += lamp(*light);
    for (const Object& object : model_.objects) text += this->object(object);
    if (model_.film.filter != "box" || model_.film.filter_radius > 0)
      notes_.add("the picture: POV-Ray takes one ray a pixel and no filter");
    return {text, notes_.take()};
  }

 private:
  std::string settings();
  std::string lamp(const Light& light);
  std::string object(const Object& object);
  std::string name_of(const Object& object) const;
  std::string material_name(const MaterialPtr& material) const;

  const Model& model_;
  PovOptions options_;
  Box3 box_;
  PovNotes notes_;
};

std::string Writer::settings() {
  Spectrum ambient;
  for (const LightPtr& light : model_.lights) ambient += light->ambient();
  int depth = ClassicOptions{}.max_depth;
  if (model_.integrator) {
    const std::any value = model_.integrator->made_from();
    if (const auto* options = std::any_cast<ClassicOptions>(&value)) {
      depth = options->max_depth;
      if (options->depth_attenuation > 0) notes_.add("the integrator: POV-Ray has no depth term of ambient light");
      if (options->shadows == ShadowMode::opaque)
        notes_.add("the integrator: POV-Ray's shadows let clear light through");
      if (options->weight_cutoff > 0)
        notes_.add("the integrator: weight_cutoff is not written; POV-Ray follows every ray to max_depth");
    } else {
      notes_.add("the integrator: not the classic one; POV-Ray shows its model");
    }
  }
  // POV-Ray counts the ray from the eye as level 1.
  return fmt::format("global_settings {{ assumed_gamma 1 adc_bailout 0 max_trace_level {} ambient_light {} }}\n",
                     std::clamp(depth + 1, 1, 256), pov_rgb(ambient));
}

std::string Writer::lamp(const Light& light) {
  const std::any value = light.made_from();
  Lamp lamp;
  std::string cone, note;
  Vec3 from = box_.center();
  AreaSampling sampling{1, true};
  bool one_sided = false;
  if (const auto* point = std::any_cast<PointLight>(&value)) {
    lamp = point->lamp;
  } else if (const auto* spot = std::any_cast<SpotLight>(&value)) {
    lamp = spot->lamp;
    from = spot->position + spot->direction;
    cone = fmt::format(" spotlight point_at {} radius {} falloff {}", pov(from), spot->inner_angle * 180 / kPi,
                       spot->angle * 180 / kPi);
  } else if (const auto* distant = std::any_cast<DistantLight>(&value)) {
    lamp = distant->lamp;
    if (distant->angular_diameter > 0) sampling = distant->sampling;
    lamp.intensity /= RoundIrradiance(lamp, sampling).mean_cosine(1 - std::cos(0.5 * distant->angular_diameter));
  } else if (const auto* rectangle = std::any_cast<RectangleLight>(&value)) {
    lamp = rectangle->lamp, sampling = rectangle->sampling, one_sided = rectangle->one_sided;
    from = rectangle->frame.origin + rectangle->frame.z;
  } else if (const auto* disc = std::any_cast<DiscLight>(&value)) {
    lamp = disc->lamp, sampling = disc->sampling, one_sided = disc->one_sided;
    from = disc->frame.origin + disc->frame.z;
  } else if (const auto* ball = std::any_cast<SphereLight>(&value)) {
    notes_.add("a sphere light: POV-Ray's light does not turn to the lit point; a point light takes its place");
    const Vec3 to = ball->center - from;
    return fmt::format("light_source {{ {} rgb {} }}\n", pov(from + to), pov(ball->lamp.intensity * ball->lamp.color));
  } else {
    notes_.add("a light of a kind that POV-Ray does not have is left out");
    return {};
  }
  if (!sampling.grid) notes_.add("an area light: POV-Ray's samples stand in a grid, not at random");
  if (one_sided) notes_.add("an area light: POV-Ray's shines to both sides, without the cosine at the lamp");
  if (!lamp.shadows) {
    cone += " shadowless";
    notes_.add("a light without shadows: POV-Ray gives it no highlights");
  }
  const int count = light.sample_count();
  if (count > kMaxPointLights)
    notes_.add(fmt::format("an area light of {} samples: only the first {} are written", count, kMaxPointLights));
  const int used = std::min(count, kMaxPointLights);
  double brightness = lamp.intensity / used;
  if (lamp.inverse_square) {
    brightness /= 2 * kFadeDistance * kFadeDistance;
    cone += fmt::format(" fade_distance {} fade_power 2", kFadeDistance);
  }
  std::string text;
  for (int i = 0; i < used; ++i) {
    // Samples seen from any point stand at the same places of the lamp.
    const LightSample sample = light.sample(from, i, 0.5, 0.5);
    const bool parallel = std::isinf(sample.distance);
    const double distance = parallel ? 100 * box_.diameter() : sample.distance;
    text += fmt::format("light_source {{ {} rgb {}{}{} }}\n", pov(from + distance * sample.direction),
                        pov(brightness * lamp.color), cone,
                        parallel ? fmt::format(" parallel point_at {}", pov(from)) : "");
  }
  return text;
}

std::string Writer::name_of(const Object& object) const {
  if (!object.name.empty()) return object.name;
  for (const auto& [name, entity] : model_.geometry)
    if (entity == object.shape) return name;
  return "an object";
}

std::string Writer::material_name(const MaterialPtr& material) const {
  for (const auto& [name, known] : model_.materials)
    if (known == material) return name;
  return "a material";
}

std::string Writer::object(const Object& object) {
  const std::string name = name_of(object);
  std::string attributes;
  if (object.back_material && object.back_material != object.material)
    notes_.add(name + ": the look of its back is not written");
  if (face_materials(object)) notes_.add(name + ": the materials of its faces are not written");
  const MaterialPtr material = body_material(object);
  const auto close = [&](const PovShape& shape) {
    return shape.text + pov_material(*material, material_name(material), shape.parameters, notes_);
  };
  std::string text;
  if (const auto* surface = std::get_if<SurfacePtr>(&object.shape)) {
    text = close(pov_shape(*surface, name, options_, notes_));
  } else if (const auto* set = std::get_if<SurfaceSet>(&object.shape)) {
    text = "union {";
    for (const SurfacePtr& member : *set)
      text += fmt::format("\n{} }}", pov_shape(member, name, options_, notes_).text);
    text = close({text, {}});
  } else if (const auto* body = std::get_if<BodyPtr>(&object.shape)) {
    text = close(pov_shape(**body, name, options_, notes_));
  } else if (const auto* mesh = std::get_if<MeshPtr>(&object.shape)) {
    text = close(pov_shape(**mesh));
  } else if (const auto* shape = std::get_if<ShapePtr>(&object.shape)) {
    const std::optional<PovShape> written = pov_shape(*shape, name, options_, notes_);
    if (!written) {
      notes_.add(name + ": POV-Ray has no such shape; left out");
      return {};
    }
    text = close(*written);
  } else if (const auto* group = std::get_if<GroupPtr>(&object.shape)) {
    text = "union {\n";
    for (const Object& member : (*group)->objects) text += this->object(member);
  } else {
    notes_.add(name + ": points and curves have no surface; left out");
    return {};
  }
  text += pov(object.transform);
  for (const ClipPlane& clip : object.clips) {
    text += fmt::format("\n  clipped_by {{ {} }}", pov_plane(clip.normal, clip.through));
    if (clip.cap) notes_.add(name + ": cuts are left open");
  }
  const auto hidden_from = [&](RayKind kind) { return (object.visible_to & static_cast<uint32_t>(kind)) == 0; };
  if (hidden_from(RayKind::camera)) text += " no_image";
  if (hidden_from(RayKind::shadow)) text += " no_shadow";
  if (hidden_from(RayKind::reflection)) text += " no_reflection";
  return fmt::format("// {}\n{} }}\n", name, text);
}

}  // namespace

void PovNotes::add(const std::string& note) {
  if (std::find(notes_.begin(), notes_.end(), note) == notes_.end()) notes_.push_back(note);
}

std::string pov(const Vec3& v) { return fmt::format("<{}, {}, {}>", v.x, v.y, v.z); }

std::string pov_rgb(const Spectrum& s) { return fmt::format("rgb <{}, {}, {}>", s[0], s[1], s[2]); }

std::string pov(const Affine& map) {
  if (map.is_identity()) return {};
  const Mat3& m = map.linear;
  return fmt::format(" matrix <{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}>", m[0].x, m[0].y, m[0].z, m[1].x, m[1].y,
                     m[1].z, m[2].x, m[2].y, m[2].z, map.offset.x, map.offset.y, map.offset.z);
}

Affine pov_frame(const Frame& frame, const Vec3& stretch) {
  return {Mat3(stretch.x * frame.x, stretch.y * frame.y, stretch.z * frame.z), frame.origin};
}

std::string pov_plane(const Vec3& normal, const Vec3& through) {
  const Vec3 n = glm::normalize(normal);
  return fmt::format("plane {{ {}, {} }}", pov(n), glm::dot(n, through));
}

PovScene pov_scene(const Model& model, const PovOptions& options) { return Writer(model, options).scene(); }

}  // namespace lekalo::render
