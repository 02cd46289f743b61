#include "render/step/step_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "geometry/bodies/topology/sew.h"
#include "geometry/queries/closest/position.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/transformed.h"
#include "render/model/length_unit.h"
#include "render/step/step_geometry.h"

namespace lekalo::render {

namespace {

using namespace geometry;

// Enough to tell a shell that encloses material from one that encloses a void.
constexpr double kSign = 1e-3;

std::string length_unit(StepWriter& w, const std::string& unit) {
  const auto metre = [&](const char* prefix) {
    return w.add(fmt::format("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({},.METRE.))", prefix));
  };
  const double millimetres = millimetres_of(unit).value_or(1);
  static const std::map<double, const char*> prefixes = {{1e-3, ".MICRO."}, {1, ".MILLI."}, {10, ".CENTI."},
                                                         {100, ".DECI."},   {1000, "$"},    {1e6, ".KILO."}};
  const auto prefix = prefixes.find(millimetres);
  if (prefix != prefixes.end()) return metre(prefix->second);
  const std::string dimensions = w.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
  const std::string measure =
      w.add(fmt::format("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{})", millimetres, metre(".MILLI.")));
  const char* name = unit == "ft" ? "FOOT" : unit == "yd" ? "YARD" : "INCH";
  return w.add(fmt::format("(CONVERSION_BASED_UNIT('{}',{})LENGTH_UNIT()NAMED_UNIT({}))", name, measure, dimensions));
}

// One shell as a body of its own.
Body shell_of(const Body& body, int shell) {
  Body result;
  std::map<int, int> vertices, edges;
  const auto vertex = [&](int v) {
    const auto [at, is_new] = vertices.try_emplace(v, 0);
    if (is_new) at->second = result.add_vertex(body.vertices[v].point, body.vertices[v].origin);
    return at->second;
  };
  const auto edge = [&](int e) {
    const auto [at, is_new] = edges.try_emplace(e, 0);
    const Edge& old = body.edges[e];
    if (is_new) at->second = result.add_edge(old.curve, vertex(old.start), vertex(old.end), old.origin, old.kind);
    return at->second;
  };
  for (const int f : body.shells[shell].faces) {
    const Face& face = body.faces[f];
    const int copy = result.add_face(face.surface, face.forward, face.origin, face.trimmed);
    for (const int loop : face.loops) {
      std::vector<Body::Use> uses;
      for (const int c : body.loops[loop].coedges)
        uses.push_back({edge(body.coedges[c].edge), body.coedges[c].forward, body.coedges[c].image});
      result.add_loop(copy, uses);
    }
  }
  result.close_shell(body.shells[shell].closed);
  return result;
}

class Exporting {
 public:
  Exporting(const std::string& unit, double tolerance)
      : unit_(unit), geometry_(writer_, tolerance, [this](double deviation) { note_fit(deviation); }) {
    const std::string context =
        writer_.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
    writer_.add(
        fmt::format("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{})", context));
    product_context_ = writer_.add(fmt::format("PRODUCT_CONTEXT('',{},'mechanical')", context));
    definition_context_ =
        writer_.add(fmt::format("PRODUCT_DEFINITION_CONTEXT('part definition',{},'design')", context));
    const std::string length = length_unit(writer_, unit);
    const std::string angle = writer_.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    const std::string solid_angle = writer_.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    const std::string uncertainty = writer_.add(
        fmt::format("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),{},'distance_accuracy_value','')", length));
    units_ =
        writer_.add(fmt::format("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({}))"
                                "GLOBAL_UNIT_ASSIGNED_CONTEXT(({},{},{}))REPRESENTATION_CONTEXT('',''))",
                                uncertainty, length, angle, solid_angle));
  }

  void add(const StepShape& shape) {
    name_ = shape.name;
    try {
      add_entity(shape);
    } catch (const std::invalid_argument& error) {
      notes_.push_back(fmt::format("'{}' is left out: {}", name_, error.what()));
    }
  }

  StepFile finish(const std::string& title) {
    if (products_ == 0)
      throw std::invalid_argument(notes_.empty() ? "no body, surface, curve or point is shown" : notes_.front());
    if (!styled_.empty())
      writer_.add(
          fmt::format("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{},{})", step_list(styled_), units_));
    if (!unit_.empty() && !millimetres_of(unit_))
      notes_.push_back(fmt::format("info.unit '{}' is not known: lengths are written as millimetres", unit_));
    for (const auto& [name, fit] : fits_)
      notes_.push_back(fmt::format("'{}': {} of its curves and surfaces {} fitted, {:.2g} away at most", name,
                                   fit.count, fit.count == 1 ? "is" : "are", fit.largest));
    // Without a date: the same scene makes the same file.
    std::string text = fmt::format(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
        "FILE_NAME({},'1970-01-01T00:00:00',(''),(''),'lekalo','lekalo','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n",
        step_string(title));
    text += writer_.lines() + "ENDSEC;\nEND-ISO-10303-21;\n";
    return {std::move(text), std::move(notes_), products_};
  }

 private:
  struct Fit {
    int count = 0;
    double largest = 0;
  };
  void note_fit(double deviation) {
    Fit& fit = fits_[name_];
    ++fit.count;
    fit.largest = std::max(fit.largest, deviation);
  }

  void add_entity(const StepShape& shape) {
    face_colors_ = shape.face_colors;
    colored_faces_.clear();
    const auto colored = [&](std::string item) {
      if (!shape.color) return item;
      styled_.push_back(writer_.add(fmt::format("STYLED_ITEM('color',({}),{})", style(*shape.color), item)));
      const std::string whole = styled_.back();
      for (const auto& [face, color] : colored_faces_)
        styled_.push_back(
            writer_.add(fmt::format("OVER_RIDING_STYLED_ITEM('color',({}),{},{})", style(color), face, whole)));
      colored_faces_.clear();
      return item;
    };
    if (const auto* body = std::get_if<BodyPtr>(&shape.entity)) {
      add_body(transformed(**body, shape.to_world), colored);
    } else if (const auto* surface = std::get_if<SurfacePtr>(&shape.entity)) {
      const SurfacePtr moved = transformed(*surface, shape.to_world);
      add_body(sew(std::span(&moved, 1)), colored);
    } else if (const auto* set = std::get_if<SurfaceSet>(&shape.entity)) {
      std::vector<SurfacePtr> moved;
      for (const SurfacePtr& one : *set) moved.push_back(transformed(one, shape.to_world));
      add_body(sew(moved), colored);
    } else if (const auto* curve = std::get_if<CurvePtr>(&shape.entity)) {
      const CurvePtr moved = transformed(*curve, shape.to_world);
      if (!(moved->domain().width() < kInfinity)) throw std::invalid_argument("it has no ends");
      add_wire(trimmed(*moved));
    } else if (const auto* point = std::get_if<Vec3>(&shape.entity)) {
      add_wire(writer_.point(shape.to_world.point(*point)));
    } else if (std::holds_alternative<MeshPtr>(shape.entity)) {
      throw std::invalid_argument("it is a mesh; STEP files hold exact shapes, OBJ, PLY and STL files meshes");
    } else {
      throw std::invalid_argument(shape.no_boundary.empty()
                                      ? "it is met by rays only and has no boundary representation"
                                      : "its boundary is not made: " + shape.no_boundary);
    }
  }

  // A part of a basis curve between its ends: the basis may be longer, or have no ends at all.
  std::string trimmed(const Curve& curve) {
    if (curve.is_closed()) return geometry_.curve(curve);
    const Interval domain = curve.domain();
    const std::string basis = geometry_.curve(curve), from = writer_.point(curve.point(domain.lo)),
                      to = writer_.point(curve.point(domain.hi));
    return writer_.add(fmt::format("TRIMMED_CURVE('',{},({}),({}),.T.,.CARTESIAN.)", basis, from, to));
  }

  void add_wire(const std::string& item) {
    const std::string set = writer_.add(fmt::format("GEOMETRIC_CURVE_SET({},({}))", step_string(name_), item));
    represent("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION", {set});
  }

  template <class Colored>
  void add_body(const Body& body, Colored colored) {
    std::vector<int> outer, voids, open;
    for (int i = 0; i < static_cast<int>(body.shells.size()); ++i) {
      if (!body.shells[i].closed)
        open.push_back(i);
      else if (body.shells.size() == 1 || signed_volume(body, i, kSign) > 0)
        outer.push_back(i);
      else
        voids.push_back(i);
    }
    const Topology topology(*this, body);
    std::vector<std::string> solids, sheets;
    for (const int shell : outer) {
      std::vector<std::string> inner;
      for (const int v : voids)
        if (outer.size() == 1 || lies_in(body, v, shell))
          inner.push_back(writer_.add(fmt::format("ORIENTED_CLOSED_SHELL('',*,{},.T.)", topology.shell(v, true))));
      const std::string outside = topology.shell(shell, true);
      solids.push_back(colored(writer_.add(
          inner.empty() ? fmt::format("MANIFOLD_SOLID_BREP({},{})", step_string(name_), outside)
                        : fmt::format("BREP_WITH_VOIDS({},{},{})", step_string(name_), outside, step_list(inner)))));
    }
    for (const int shell : open) sheets.push_back(topology.shell(shell, false));
    if (!sheets.empty()) {
      std::string model =
          writer_.add(fmt::format("SHELL_BASED_SURFACE_MODEL({},{})", step_string(name_), step_list(sheets)));
      sheets = {colored(std::move(model))};
    }
    if (!solids.empty()) represent("ADVANCED_BREP_SHAPE_REPRESENTATION", solids);
    if (!sheets.empty()) represent("MANIFOLD_SURFACE_SHAPE_REPRESENTATION", sheets);
  }

  static bool lies_in(const Body& body, int inner, int outer) {
    const Face& face = body.faces[body.shells[inner].faces[0]];
    const Edge& edge = body.edges[body.coedges[body.loops[face.loops[0]].coedges[0]].edge];
    return position(body.vertices[edge.start].point, shell_of(body, outer)).where != Containment::outside;
  }

  // The entities of a body's vertices and edges, shared by its faces.
  class Topology {
   public:
    Topology(Exporting& file, const Body& body) : file_(file), body_(body) {
      for (const Vertex& vertex : body.vertices)
        vertices_.push_back(file.writer_.add(fmt::format("VERTEX_POINT('',{})", file.writer_.point(vertex.point))));
      for (const Edge& edge : body.edges) {
        edges_.emplace_back();
        if (edge.kind == EdgeKind::pole) continue;
        edges_.back() = file.writer_.add(fmt::format("EDGE_CURVE({},{},{},{},.T.)", step_string(edge.origin.text()),
                                                     vertices_[edge.start], vertices_[edge.end],
                                                     file.geometry_.curve(*edge.curve)));
      }
    }

    std::string shell(int shell, bool closed) const {
      std::vector<std::string> faces;
      for (const int f : body_.shells[shell].faces) faces.push_back(face(f));
      return file_.writer_.add(fmt::format("{}('',{})", closed ? "CLOSED_SHELL" : "OPEN_SHELL", step_list(faces)));
    }

   private:
    std::string face(int f) const {
      StepWriter& w = file_.writer_;
      const Face& face = body_.faces[f];
      const StepGeometry::SurfaceEntity surface = file_.geometry_.surface(face.surface);
      std::vector<std::string> bounds;
      for (const int l : face.loops) {
        std::vector<std::string> uses;
        for (const int c : body_.loops[l].coedges) {
          const Coedge& coedge = body_.coedges[c];
          if (!edges_[coedge.edge].empty())
            uses.push_back(
                w.add(fmt::format("ORIENTED_EDGE('',*,*,{},{})", edges_[coedge.edge], coedge.forward ? ".T." : ".F.")));
        }
        const std::string loop = w.add(fmt::format("EDGE_LOOP('',{})", step_list(uses)));
        bounds.push_back(w.add(fmt::format("{}('',{},.T.)", bounds.empty() ? "FACE_OUTER_BOUND" : "FACE_BOUND", loop)));
      }
      // The face looks along r_u x r_v, or against it.
      const bool along = face.forward == (face.surface->normal_sign() > 0);
      std::string item = w.add(fmt::format("ADVANCED_FACE({},{},{},{})", step_string(face.origin.text()),
                                           step_list(bounds), surface.name, along == surface.forward ? ".T." : ".F."));
      if (const auto color = file_.face_colors_.find(f); color != file_.face_colors_.end())
        file_.colored_faces_.emplace_back(item, color->second);
      return item;
    }

    Exporting& file_;
    const Body& body_;
    std::vector<std::string> vertices_, edges_;
  };

  // A product with one representation.
  void represent(const std::string& kind, std::vector<std::string> items) {
    const std::string name = step_string(name_);
    items.insert(items.begin(), writer_.placement(Vec3(0), {0, 0, 1}, {1, 0, 0}));
    const std::string representation = writer_.add(fmt::format("{}({},{},{})", kind, name, step_list(items), units_));
    const std::string product = writer_.add(fmt::format("PRODUCT({},{},'',({}))", name, name, product_context_));
    writer_.add(fmt::format("PRODUCT_RELATED_PRODUCT_CATEGORY('part','',({}))", product));
    const std::string formation = writer_.add(fmt::format("PRODUCT_DEFINITION_FORMATION('','',{})", product));
    const std::string definition =
        writer_.add(fmt::format("PRODUCT_DEFINITION('design','',{},{})", formation, definition_context_));
    const std::string shape = writer_.add(fmt::format("PRODUCT_DEFINITION_SHAPE('','',{})", definition));
    writer_.add(fmt::format("SHAPE_DEFINITION_REPRESENTATION({},{})", shape, representation));
    ++products_;
  }

  std::string style(const Vec3& color) {
    // More digits than a screen has shades.
    const auto part = [](double x) { return step_real(std::round(x * 1e6) / 1e6); };
    const std::string rgb =
        writer_.shared(fmt::format("COLOUR_RGB('',{},{},{})", part(color.x), part(color.y), part(color.z)));
    const std::string fill_color = writer_.shared(fmt::format("FILL_AREA_STYLE_COLOUR('',{})", rgb));
    const std::string fill = writer_.shared(fmt::format("FILL_AREA_STYLE('',({}))", fill_color));
    const std::string area = writer_.shared(fmt::format("SURFACE_STYLE_FILL_AREA({})", fill));
    const std::string side = writer_.shared(fmt::format("SURFACE_SIDE_STYLE('',({}))", area));
    const std::string usage = writer_.shared(fmt::format("SURFACE_STYLE_USAGE(.BOTH.,{})", side));
    return writer_.shared(fmt::format("PRESENTATION_STYLE_ASSIGNMENT(({}))", usage));
  }

  std::string unit_;
  StepWriter writer_;
  StepGeometry geometry_;
  std::string product_context_, definition_context_, units_;
  std::string name_;
  std::vector<std::string> styled_;
  std::map<int, Vec3> face_colors_;                          // of the shape that is written
  std::vector<std::pair<std::string, Vec3>> colored_faces_;  // its faces that are written
  std::map<std::string, Fit> fits_;
  std::vector<std::string> notes_;
  int products_ = 0;
};

}  // namespace

StepFile step_file(const std::vector<StepShape>& shapes, const std::string& title, const std::string& unit,
                   double tolerance) {
  Exporting file(unit, tolerance);
  for (const StepShape& shape : shapes) file.add(shape);
  return file.finish(title);
}

}  // namespace lekalo::render
