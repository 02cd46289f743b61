// What belongs to drawings: styles, the sections drawing, panels and layout.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/cameras/cameras.h"
#include "render/model/detail.h"
#include "render/model/objects.h"
#include "render/model/placed_annotations.h"
#include "render/model/section.h"
#include "render/scene/build/builder.h"
#include "render/scene/types/panels.h"
#include "render/scene/types/sections.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

// The built-in styles with the scene's own: a built-in name given under `styles` changes it field by field, unless it
// says what it is like. The same in included files, for what they hold.
void Builder::merge_styles() {
  Diagnostics own;
  styles_ = read_document(make_source("(built-in styles)", std::string(built_in_styles())), own);
  if (own.has_errors()) throw SceneError(own);
  const Value* given = scene_.root.find("styles");
  if (!given) return;
  if (!given->is_map()) {
    if (!given->invalid)
      diagnostics_.error(given->place, "'styles' is a map of named things", "write name: { like: thin, ... }");
    return;
  }
  styles_.place = given->place;
  // A style of a file included as `left` is called left.thin: it changes the `thin` of the file that includes, which
  // therefore comes first.
  std::vector<const Entry*> outside_in;
  for (const Entry& entry : given->entries) outside_in.push_back(&entry);
  const auto depth = [](const Entry* e) { return std::count(e->key.name.begin(), e->key.name.end(), '.'); };
  std::stable_sort(outside_in.begin(), outside_in.end(),
                   [&](const Entry* a, const Entry* b) { return depth(a) < depth(b); });
  for (const Entry* entry : outside_in) {
    const size_t dot = entry->key.name.rfind('.');
    const std::string scope = dot == std::string::npos ? "" : entry->key.name.substr(0, dot);
    const std::string own = entry->key.name.substr(dot + 1);  // npos + 1 is 0
    Entry changed = *entry;
    if (is_built_in_style(own) && changed.value.is_map() && !changed.value.find("like"))
      for (const Entry& field : find_named(styles_, own, scope).entry->value.entries)
        if (!changed.value.find(field.key.name)) changed.value.entries.push_back(field);
    std::erase_if(styles_.entries, [&](const Entry& e) { return e.key.name == changed.key.name; });
    styles_.entries.push_back(std::move(changed));
  }
}

// Of what an annotation's points, directions and things are, so that drawings place them as the object that shows it.
void Builder::note_shapes_spoken_of(const Value& map, const Counters& counters, Fields& values) {
  for (const Entry& entry : map.entries) {
    const std::string& field = entry.key.name;
    const bool is_point = values.holds<geometry::Anchor>(field) && !values.get<geometry::Anchor>(field).on_page,
               is_way = values.holds<Vec3>(field), is_thing = values.holds<std::vector<std::any>>(field),
               is_frame = values.holds<Frame>(field);
    if (!is_point && !is_way && !is_thing && !is_frame) continue;
    const Value& value = with_counters(entry.value, counters);
    std::set<const void*> shapes, as_operands;
    const auto look = [&](const auto& self, const Value& written, const Counters& around) -> void {
      const Value& item = with_counters(written, around);
      const Value* of = item.is_map() ? item.find("of") : &item;
      if (!of || !of->is_scalar() || !thing_named(*of, around)) return;
      const auto parts = parts_named(with_counters(*of, around), geometry_categories());
      if (!parts) return;
      for (const NamedPart& one : *parts) {
        const Scoped& scoped = one.member->scoped;
        // A place with a name is one of what it is on; a point by itself is on nothing.
        if (one.member->built.category == Category::point && scoped.value->is_map())
          self(self, *scoped.value, scoped.counters);
        else
          shapes.insert(identity(entity_of(one.member->built.value)));
        if (one.member->as_operand) as_operands.insert(identity(entity_of(one.member->as_operand->value)));
      }
    };
    if (is_thing && value.is_sequence())
      for (const Value& item : value.items) look(look, item, counters);
    else if (is_frame)
      for (const Entry& part : value.entries) look(look, part.value, counters);
    else
      look(look, value, counters);
    if (shapes.size() != 1 || !*shapes.begin()) continue;  // points are no shapes of objects that could be told apart
    const Value* way = is_frame ? value.find("z") : &value;
    const Value* vector = (is_way || is_frame) && way && way->is_map() ? way->find("vector") : nullptr;
    values.set(shape_field(field),
               ShapeSpokenOf{*shapes.begin(), as_operands.empty() ? *shapes.begin() : *as_operands.begin(),
                             vector && vector->text == "normal"});
  }
}

namespace {

// The sections that marks of other panels speak of. Of panels that are `wrong` enough has been said.
void give_sections(std::vector<Annotation>& annotations, const std::vector<Panel>& panels,
                   const std::set<std::string>& wrong, Diagnostics& diagnostics) {
  for (Annotation& annotation : annotations) {
    if (annotation.type != "cutting_plane") continue;
    const std::string& name = annotation.values.text("of");
    const auto panel =
        std::find_if(panels.begin(), panels.end(), [&](const Panel& one) { return one.name == name && one.section; });
    if (panel != panels.end())
      annotation.values.set("section", panel->section);
    else if (!wrong.contains(name))
      diagnostics.error(annotation.place, fmt::format("there is no panel '{}' with a section", name),
                        "panels: { aa: { section: { planes: { normal: -y }, title: A } } }");
  }
}

// The details that marks of other panels speak of, and the way in which they are seen.
void give_details(std::vector<Annotation>& annotations, const std::vector<Panel>& panels,
                  const std::set<std::string>& wrong, Diagnostics& diagnostics) {
  for (Annotation& annotation : annotations) {
    if (annotation.type != "detail_circle") continue;
    const std::string& name = annotation.values.text("of");
    const auto panel = std::find_if(panels.begin(), panels.end(), [&](const Panel& one) {
      return one.name == name && one.camera && detail_of(one.drawing);
    });
    if (panel == panels.end()) {
      if (wrong.contains(name)) continue;
      diagnostics.error(
          annotation.place, fmt::format("there is no panel '{}' with a detail", name),
          "panels: { b: { camera: { view: front }, detail: { around: [0, 0, 0], radius: 2, title: B } } }");
      continue;
    }
    annotation.values.set("detail", detail_of(panel->drawing));
    annotation.values.set("sight", panel->camera->view_direction());
  }
}

// A detail shows what its circle holds, and of annotations its own: those of the whole drawing speak of other places.
void make_detail(const DetailPtr& detail, bool own_annotations, const std::map<std::string, Style>& styles,
                 Panel& panel) {
  if (!panel.camera->is_parallel() || panel.camera->is_graph())
    throw geometry::FieldError("camera", "a detail is a view by a parallel camera", "camera: { view: front }");
  panel.camera_frames = true;
  if (!own_annotations) panel.drawing.annotations.clear();
  panel.drawing.legend.reset();
  panel.drawing.annotations.push_back(border_of(detail, styles.at("thin")));
}

}  // namespace

void Builder::build_drawing(Model& model) {
  const Value* given = section("drawing");
  static const Value nothing = [] {
    Value map;
    map.kind = Value::Kind::map;
    return map;
  }();
  const Value& map = given && given->is_map() ? *given : nothing;
  const auto fields = read_fields(section_declaration("drawing").fields, map, {}, "'drawing'");
  if (fields)
    if (auto drawing = attempt(map, "'drawing'", [&] { return drawing_of(*fields); }))
      model.drawing = *std::move(drawing);
  build_panels(fields, model);
  // Axes of the page are those of its graphs.
  if (model.camera && !section("panels")) check_axes(given, model.camera->is_graph());
  if (!model.panels.empty() &&
      std::all_of(model.panels.begin(), model.panels.end(), [](const Panel& one) { return one.camera != nullptr; }))
    check_axes(given, std::any_of(model.panels.begin(), model.panels.end(),
                                  [](const Panel& one) { return one.camera->is_graph(); }));
  build_layout(model);
  check_color_bars(model);
}

void Builder::check_color_bars(const Model& model) {
  if (!model.integrator || model.integrator->has_scale()) return;
  const auto check = [&](const DrawingChoices& drawing) {
    for (const Annotation& annotation : drawing.annotations)
      if (tells_scale_of_ground(annotation))
        diagnostics_.error(
            annotation.place,
            "a colour bar needs the 'range' of its numbers, a curve 'of', or an integrator whose colours "
            "tell numbers",
            "of: the curve that is coloured; or integrator: { type: analysis, quantity: mean_curvature }");
  };
  check(model.drawing);
  for (const Panel& panel : model.panels) check(panel.drawing);  // those of the scene again, which are said once
}

// Axes that a drawing asks for, of a view or views none of which is a graph.
void Builder::check_axes(const Value* drawing, bool graph) {
  if (graph || !drawing || !drawing->is_map()) return;
  for (const Entry& entry : drawing->entries)
    if (entry.key.name == "axes")
      diagnostics_.error(entry.key.place, "'axes' belong to a graph, and this camera shows none",
                         "camera: { type: graph }; arrows along the directions of space are an annotation: "
                         "{ type: axes, at: [0, 0, 0] }");
}

namespace {

void cut_for_panel(std::vector<Object>& objects, const Section& section) {
  const SectionEffect effect = cut(objects, section);
  if (objects.empty() && effect.taken_away > 0)
    throw geometry::FieldError("section", "this section leaves nothing of the panel's objects",
                               "what is on the normal's side is taken away");
  if (effect.cut + effect.taken_away == 0 && effect.untouched > 0)
    throw geometry::FieldError("section", "this section cuts none of the panel's objects",
                               "it cuts closed bodies and shapes; surfaces and curves are cut by 'clip'");
}

}  // namespace

void Builder::build_panels(const std::optional<Fields>& drawing, Model& model) {
  std::set<std::string> wrong;
  visit_named("panels", Category::panel, [&](const std::string& name, const Built& built) {
    auto read = std::any_cast<PanelAsRead>(built.value);
    const Value* entry = section("panels")->find(name.substr(0, name.find('.')));  // of members that of their family
    const Value& place = entry ? *entry : scene_.root;
    Panel panel;
    panel.name = name;
    if (name == "empty") {
      diagnostics_.error(place.place, "a panel may not be called 'empty'", "in a layout this word leaves a place free");
      return;
    }
    if (read.objects) {
      fill_materials(*read.objects);
      panel.objects = std::move(read.objects);
    }
    if (read.section) {
      if (!panel.objects) panel.objects = model.objects;
      attempt(place, "'section'", [&] { return cut_for_panel(*panel.objects, *read.section), true; });
      panel.section = read.section;
    }
    panel.make_camera = model.make_camera;
    panel.camera_frames = model.camera_frames;
    // A view that frames all frames what the panel shows.
    FramedContent all(panel.objects ? *panel.objects : model.objects);
    all.objects = std::make_shared<const std::vector<Object>>(panel.objects ? *panel.objects : model.objects);
    if (panel.objects && scene_view_)
      panel.make_camera = [make = scene_view_, all](int w, int h) { return make(w, h, all); };
    panel.own_camera = read.camera.has_value();
    if (read.camera) {
      const Value* camera = place.find("camera");
      panel.camera_frames = camera && camera->is_map() && !camera->find("from");
      panel.make_camera = [make = *read.camera, all](int w, int h) { return make(w, h, all); };
    }
    if (panel.make_camera)
      attempt(place, "the panel's camera", [&] {
        panel.camera = panel.make_camera(model.film.width, model.film.height);
        return true;
      });
    if (drawing) {
      Fields merged = *drawing;
      if (read.drawing) merged.override_by(*read.drawing);
      const Value* own = place.find("drawing");
      if (auto made = attempt(own ? *own : place, "'drawing'", [&] { return drawing_of(merged); }))
        panel.drawing = *std::move(made);
      panel.drawing.title = read.title;
      if (panel.camera && !panel.camera->is_graph()) {
        check_axes(own, false);
        panel.drawing.axes.reset();  // those of the page's graphs
      }
    }
    if (read.detail && panel.camera) {
      const bool own_annotations = read.drawing && read.drawing->given("annotations");
      attempt(place, "'detail'", [&] { return make_detail(read.detail, own_annotations, model.styles, panel), true; });
    }
    if (read.detail && !detail_of(panel.drawing)) wrong.insert(name);
    model.panels.push_back(std::move(panel));
  });
  // In the order in which the scene names them.
  const auto number_of = [&](const Panel& panel) {
    return section("panels")->find_entry(panel.name.substr(0, panel.name.find('.')));
  };
  std::stable_sort(model.panels.begin(), model.panels.end(),
                   [&](const Panel& a, const Panel& b) { return number_of(a) < number_of(b); });
  for (const auto& [name, thing] : sections_["panels"])
    for (const NamedThing::Member& one : thing.members)
      if (one.state == NamedThing::Member::State::wrong) wrong.insert(one.name.empty() ? name : name + "." + one.name);
  const std::vector<Panel> known = model.panels;
  for (Panel& panel : model.panels) {
    give_sections(panel.drawing.annotations, known, wrong, diagnostics_);
    give_details(panel.drawing.annotations, known, wrong, diagnostics_);
  }
  give_sections(model.drawing.annotations, known, wrong, diagnostics_);
  give_details(model.drawing.annotations, known, wrong, diagnostics_);
}

bool Builder::check_panel(const Value& name) {
  std::vector<std::string> known;
  for (const auto& [panel, thing] : sections_["panels"])
    for (const NamedThing::Member& one : thing.members)
      known.push_back(one.name.empty() ? panel : panel + "." + one.name);
  if (std::find(known.begin(), known.end(), name.text) != known.end()) return true;
  diagnostics_.error(name.place,
                     fmt::format("there is no panel called '{}'{}", name.text, suggestion(name.text, known)),
                     known.empty() ? "the scene has no panels" : "there are " + listed(known, 20));
  return false;
}

void Builder::build_layout(Model& model) {
  const Value* given = section("layout");
  if (!given) {
    if (!model.panels.empty()) {
      model.layout.rows.emplace_back();
      for (const Panel& panel : model.panels) model.layout.rows.back().push_back(panel.name);
    }
    return;
  }
  if (!given->is_map()) return;  // check_sections() speaks of it
  const auto fields = read_fields(section_declaration("layout").fields, *given, {}, "'layout'");
  if (!fields) return;
  const auto layout = attempt(*given, "'layout'", [&] { return layout_of(*fields); });
  if (!layout) return;
  model.layout = *layout;
  if (const Value* scale = given->find("scale")) model.layout.scale_place = scale->place;
  if (const Value* gap = given->find("gap")) model.layout.gap_place = gap->place;
  const Value& rows = *given->find("rows");
  std::set<std::string> seen;
  for (const Value& row : rows.items)
    for (const Value& item : row.items) {
      if (item.text == "empty") continue;
      if (check_panel(item) && !seen.insert(item.text).second)
        diagnostics_.error(item.place, fmt::format("the panel '{}' stands here twice", item.text));
    }
}

}  // namespace lekalo::render
