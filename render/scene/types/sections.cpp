#include "render/scene/types/sections.h"

#include <stdexcept>

#include "render/film/filter.h"
#include "render/film/render.h"
#include "render/model/attributes.h"
#include "render/model/page.h"
#include "render/scene/types/constraint_fields.h"
#include "render/scene/types/panels.h"
#include "render/scene/values/types.h"

namespace lekalo::render {

using geometry::Category;
using geometry::Field;
using Shape = SectionDeclaration::Shape;

namespace {

std::vector<Field> info_fields() {
  using namespace geometry;
  return {{"title", text(), "what the scene shows, for the file's metadata", false, {}},
          {"figure", text(), "number of the figure it stands for, in quotes: '2.10'", false, {}},
          {"shows", texts(), "capabilities that it shows, in quotes", false, {}},
          {"source", text(), "book and section that it comes from", false, {}},
          {"unit", text(), "what one scene unit is: mm, m, ...", false, {}}};
}

std::vector<Field> image_fields() {
  using namespace geometry;
  return {
      {"size", picture_size(), "width and height: pixels, or paper (84 mm); one side may be auto", false, "[960, 720]"},
      {"dpi", number().between(10, 2400), "pixels per inch of paper", false, "300"},
      {"margin",
       page_length().non_negative().at_most(1000),
       "free border of a drawing; an automatic side of the page has it beside the content",
       false,
       {}},
      {"samples", integer().between(1, 1 << 20), "samples per pixel", false, "16"},
      {"noise", number().between(0, 0.5),
       "each part of the picture takes 16, 32, 64, ... samples, at most `samples`, until pixels are uncertain by no "
       "more "
       "(of 1 between black and white, as displayed), in place of `contrast`; 0: as `contrast` says",
       false, "0"},
      {"contrast", number().between(0, 1),
       "pixels that differ by less from their neighbours (of 1 between black and white, as displayed) take one sample; "
       "0: "
       "all pixels take all samples",
       false, "0.03"},
      {"filter", choice({"box", "gaussian", "mitchell"}), "how samples are weighted around a pixel", false, "box"},
      {"filter_radius", number().non_negative().at_most(kMaxFilterRadius),
       "in pixels, at least 0.5; 0: the filter's own", false, "0"},
      {"seed", integer().non_negative(), "of the sample positions", false, "0"},
      {"crop", numbers().non_negative().count(4, 4), "only this part: x0, y0, x1, y1 in pixels", false, {}},
      {"color_precision", choice({"half", "float"}),
       "of R G B A in OpenEXR files; half: 11 bits and much smaller files", false, "float"},
      {"layers", words(film_layers()), "layers of OpenEXR files; by default all from color to samples", false, {}},
      {"background", color().non_negative(), "behind everything", false, "white"}};
}

std::vector<Field> output_fields() {
  using namespace geometry;
  return {
      {"file", text(), "name; its ending decides: exr, png (pictures), pdf, svg, dxf, tikz (drawings)", true, {}},
      {"kind", choice({"render", "drawing"}), "of a png: the picture or the drawing", false, "render"},
      {"exposure", number().between(-30, 30), "stops, for png", false, "0"},
      {"tone", choice({"none", "filmic", "agx", "pbr_neutral"}),
       "display curve of a png: none cuts off what is brighter than white; pbr_neutral keeps colours up to 0.8 as they "
       "are",
       false, "none"},
      {"ocio",
       group({{"config", file(), "file of the configuration, usually config.ocio", true, {}},
              {"display", text(), "the first of the configuration by default", false, {}},
              {"view", text(), "the first of the display by default", false, {}},
              {"space",
               text(),
               "the configuration's name of linear light with the primaries of Rec.709, where it has no usual one",
               false,
               {}},
              {"looks", text(), "separated by commas", false, {}}}),
       "a view of an OpenColorIO configuration in place of `tone`",
       false,
       {}},
      {"panel", text(), "only this panel of a drawing", false, {}},
      {"width", page_length().positive().at_most(5000), "of a drawing; the page's by default", false, {}}};
}

std::vector<Field> attribute_fields() {
  using namespace geometry;
  std::vector<Field> fields{
      {"of",
       references({Category::curve, Category::surface, Category::body, Category::mesh, Category::shape}),
       "names of things, of faces and edges of bodies (part, part.top, part.edge.3), or faces and edges by conditions "
       "({ of: part, extreme: z }); what is said of a face stands above what is said of its body",
       true,
       {}}};
  for (const UsualAttribute& usual : usual_attributes())
    fields.push_back({usual.name,
                      number().at_least(usual.least).at_most(usual.most),
                      usual.description + (usual.unit.empty() ? "" : ", in " + usual.unit),
                      false,
                      {}});
  fields.push_back({"material",
                    reference({Category::material}),
                    "of what it is made: it is shown so; that of a body where its object has none, that of a face "
                    "whatever the object says",
                    false,
                    {}});
  return fields;
}

}  // namespace

const std::vector<SectionDeclaration>& sections() {
  static const std::vector<SectionDeclaration> all = {
      {"lekalo", "version of the scene language: 1; the first key of every scene file", Shape::free, {}, {}},
      {"info", "title, figure number and source of the scene", Shape::fields, info_fields(), {}},
      {"include",
       "files read before this one: a name, or { file, as: prefix, set: { parameter: value } }",
       Shape::free,
       {},
       {}},
      {"parameters",
       "named numbers and angles that every formula may use: numbers, formulas, or what is measured of the geometry",
       Shape::numbers,
       {},
       {Category::quantity}},
      {"constraints",
       "points, numbers and poses that are found so that conditions hold, before anything else is made",
       Shape::fields,
       constraint_fields(),
       {}},
      {"geometry",
       "named points (coordinates, or a place { of: curve, t: ... }), curves, surfaces, bodies and meshes, in any "
       "order",
       Shape::named,
       {},
       {geometry_categories().begin(), geometry_categories().end()}},
      {"attributes",
       "physical data of things and of faces and edges of bodies; any other name is a number of your own. Faces "
       "inherit "
       "from their body, edges from faces that agree; later entries change earlier ones",
       Shape::list,
       attribute_fields(),
       {}},
      {"materials", "named materials", Shape::named, {}, {Category::material}},
      {"lights", "named lights; {} means none; a studio by default", Shape::named, {}, {Category::light}},
      {"camera", "from where the scene is seen; everything, framed, by default", Shape::one_of, {}, {Category::camera}},
      {"image", "size and sampling of the picture", Shape::fields, image_fields(), {}},
      {"integrator", "how light is computed", Shape::one_of, {}, {Category::integrator}},
      {"objects",
       "what is shown and how; every entity that nothing else uses by default",
       Shape::things,
       {},
       {Category::object}},
      {"styles",
       "named styles of lines, markers and text of drawings; built-in: thick thin hairline hidden axis construction "
       "dimension label ray",
       Shape::named,
       {},
       {Category::style}},
      {"drawing", "page-wide choices of drawings", Shape::fields, drawing_fields(), {}},
      {"panels", "several views on one page", Shape::named, {}, {Category::panel}},
      {"layout",
       "arrangement of the panels; by default one row, in the order of the scene",
       Shape::fields,
       layout_fields(),
       {}},
      {"outputs", "files to write", Shape::list, output_fields(), {}}};
  return all;
}

const SectionDeclaration& section_declaration(std::string_view name) {
  for (const SectionDeclaration& section : sections())
    if (section.name == name) return section;
  throw std::logic_error("there is no section '" + std::string(name) + "'");
}

}  // namespace lekalo::render
