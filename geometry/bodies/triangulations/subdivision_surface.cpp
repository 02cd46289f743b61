// Limit surfaces of subdivision; here those of Catmull and Clark (Catmull, Clark 1978; Stam 1998). A face whose corners
// all have four faces is a bicubic B-spline patch. Of others the children are, all but the one at the corner that is
// not like that: its children again, and so on. After `levels` steps the last child is a bicubic patch that goes on
// from those beside it and holds the limit of the corner (catmull_clark.cpp).
#include <fmt/format.h>

#include <algorithm>

#include "geometry/bodies/topology/sew.h"
#include "geometry/bodies/triangulations/catmull_clark.h"
#include "geometry/bodies/triangulations/control_mesh.h"
#include "geometry/bodies/triangulations/loop_surface.h"
#include "geometry/spatial/box_tree.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

namespace {

// What is left of a triangle is a millionth of its sides then; before that sewing may take it for one place.
constexpr int kMaxLoopLevels = 20;

// Patches that fill the unit square, each over its own rectangle.
class SubdivisionFace final : public Surface {
 public:
  explicit SubdivisionFace(std::vector<NurbsSurface> patches) : patches_(std::move(patches)) {
    std::vector<Box3> boxes;
    for (const NurbsSurface& patch : patches_) {
      const Rectangle r = patch.domain();
      boxes.push_back({{r.u.lo, r.v.lo, 0}, {r.u.hi, r.v.hi, 0}});
    }
    tree_ = BoxTree(boxes);
  }

  Rectangle domain() const override { return {{0, 1}, {0, 1}}; }
  int enclosure_order() const override { return kMaxSurfaceOrder; }

  SurfaceJet evaluate(double u, double v, int order) const override {
    const double a = std::clamp(u, 0.0, 1.0), b = std::clamp(v, 0.0, 1.0);
    if (a == u && b == v) return patch_at(a, b).evaluate(a, b, order);
    // Beyond, linearly in each direction.
    SurfaceJet jet = patch_at(a, b).evaluate(a, b, std::min(order + 1, kMaxSurfaceOrder));
    jet.values[0] += (u - a) * jet.du() + (v - b) * jet.dv();
    for (int k = 3; k <= SurfaceJet::index(0, order); ++k) jet.values[static_cast<size_t>(k)] = Vec3(0);
    jet.order = order;
    return jet;
  }

  SurfaceEnclosure enclose(const Rectangle& box, int order) const override {
    SurfaceEnclosure result;
    tree_.around({{box.u.lo, box.v.lo, 0}, {box.u.hi, box.v.hi, 0}}, [&](int k) {
      const NurbsSurface& patch = patches_[static_cast<size_t>(k)];
      const Rectangle there = patch.domain();
      const SurfaceEnclosure one = patch.enclose({intersect(box.u, there.u), intersect(box.v, there.v)}, order);
      for (int i = 0; i <= SurfaceJet::index(0, order); ++i)
        result.values[static_cast<size_t>(i)].include(one.values[static_cast<size_t>(i)]);
    });
    return result;
  }

  std::vector<SurfacePiece> pieces() const override {
    std::vector<SurfacePiece> result;
    for (const NurbsSurface& patch : patches_)
      for (SurfacePiece& piece : patch.pieces()) result.push_back(std::move(piece));
    return result;
  }

 private:
  const NurbsSurface& patch_at(double u, double v) const {
    int found = -1;
    const auto begin = [&](int k) { return patches_[static_cast<size_t>(k)].domain(); };
    // At a border the next one, as other surfaces do.
    tree_.around({{u, v, 0}, {u, v, 0}}, [&](int k) {
      if (found < 0 || begin(k).u.lo > begin(found).u.lo ||
          (begin(k).u.lo == begin(found).u.lo && begin(k).v.lo > begin(found).v.lo))
        found = k;
    });
    return patches_[static_cast<size_t>(found)];
  }

  std::vector<NurbsSurface> patches_;
  BoxTree tree_;
};

using BezierNet = std::array<Vec3, 16>;

// Bezier points of the inner span of a uniform cubic B-spline, `step` apart.
void to_bezier(Vec3* p, int step) {
  const Vec3 a = p[0], b = p[step], c = p[2 * step], d = p[3 * step];
  p[0] = (a + 4.0 * b + c) / 6.0;
  p[step] = (2.0 * b + c) / 3.0;
  p[2 * step] = (b + 2.0 * c) / 3.0;
  p[3 * step] = (b + 4.0 * c + d) / 6.0;
}

// Of the last child: the sides at the corner go on to its limit, as parabolas.
void end_in(BezierNet& net, int corner, const Vec3& limit) {
  constexpr int kCorner[4] = {0, 12, 15, 3}, kAlongU[4] = {4, -4, -4, 4}, kAlongV[4] = {1, 1, -1, -1};
  const int at = kCorner[corner];
  const auto point = [&](int i) -> Vec3& { return net[static_cast<size_t>(i)]; };
  point(at) = limit;
  for (const int step : {kAlongU[corner], kAlongV[corner]}) {
    const Vec3 middle = 1.5 * point(at + 2 * step) - 0.5 * point(at + 3 * step);
    point(at + step) = (limit + 2.0 * middle) / 3.0;
  }
}

NurbsSurface patch_over(const BezierNet& net, const Rectangle& r) {
  const auto axis = [](const Interval& t) {
    return SplineAxis(3, {t.lo, t.lo, t.lo, t.lo, t.hi, t.hi, t.hi, t.hi}, Extension::tangent);
  };
  return NurbsSurface(axis(r.u), axis(r.v), net);
}

// The patches of face 0 of a mesh over a rectangle.
void add_patches(const ConnectedMesh& mesh, const Rectangle& r, int levels, std::vector<NurbsSurface>& patches) {
  const PatchNet net = patch_net(mesh, 0);
  if (net.irregular.empty() || levels == 0) {
    BezierNet points = net.points;
    for (size_t i = 0; i < 4; ++i) to_bezier(points.data() + 4 * i, 1);
    for (size_t j = 0; j < 4; ++j) to_bezier(points.data() + j, 4);
    for (const int corner : net.irregular) end_in(points, corner, catmull_clark_limit(mesh, mesh.corner(0, corner)));
    patches.push_back(patch_over(points, r));
    return;
  }
  const RefinedMesh fine = refined_by_catmull_clark(mesh);
  const ConnectedMesh all(fine.mesh);
  const double u = r.u.middle(), v = r.v.middle();
  const Rectangle quarters[4] = {
      {{r.u.lo, u}, {r.v.lo, v}}, {{u, r.u.hi}, {r.v.lo, v}}, {{u, r.u.hi}, {v, r.v.hi}}, {{r.u.lo, u}, {v, r.v.hi}}};
  for (int k = 0; k < 4; ++k)
    add_patches(ConnectedMesh(all.around(fine.first_child[0] + k)), quarters[k], levels - 1, patches);
}

std::vector<SurfacePtr> catmull_clark_faces(const PolygonMesh& mesh, int levels) {
  const bool is_quads =
      std::all_of(mesh.faces.begin(), mesh.faces.end(), [](const auto& face) { return face.size() == 4; });
  const ConnectedMesh whole(is_quads ? mesh : refined_by_catmull_clark(ConnectedMesh(mesh)).mesh);
  std::vector<SurfacePtr> faces;
  for (int k = 0; k < static_cast<int>(whole.mesh().faces.size()); ++k) {
    std::vector<NurbsSurface> patches;
    add_patches(ConnectedMesh(whole.around(k)), {{0, 1}, {0, 1}}, levels, patches);
    faces.push_back(std::make_shared<SubdivisionFace>(std::move(patches)));
  }
  return faces;
}

std::vector<SurfacePtr> loop_faces(const PolygonMesh& mesh, int levels) {
  for (size_t k = 0; k < mesh.faces.size(); ++k)
    if (mesh.faces[k].size() != 3)
      throw FieldError("faces",
                       fmt::format("face {} has {} corners: Loop's rules take triangles", k, mesh.faces[k].size()),
                       "cut it into triangles, or scheme: catmull_clark");
  if (levels > kMaxLoopLevels)
    throw FieldError("levels", fmt::format("{} is above {}, the most for scheme: loop", levels, kMaxLoopLevels),
                     "what is left of a triangle is a millionth of its sides then");
  return loop_surface(ConnectedMesh(mesh), levels);
}

// Whether every edge has two faces.
bool is_closed(const ConnectedMesh& mesh) {
  for (int f = 0; f < static_cast<int>(mesh.mesh().faces.size()); ++f)
    for (int k = 0; k < static_cast<int>(mesh.face(f).size()); ++k)
      if (mesh.across(f, k).face < 0) return false;
  return true;
}

BodyPtr build(const Fields& f) {
  const PolygonMesh mesh = control_mesh(f);
  const bool by_loop = f.text("scheme") == "loop";
  const int levels = f.integer("levels");
  Body body = sew(by_loop ? loop_faces(mesh, levels) : catmull_clark_faces(mesh, levels));
  if (!body.is_closed() && is_closed(ConnectedMesh(mesh)))
    throw FieldError("levels",
                     fmt::format("with {} steps what is left of the faces at the corners is too small to sew", levels),
                     "fewer levels");
  return std::make_shared<Body>(std::move(body));
}

}  // namespace

TypeDeclaration subdivision_surface_type() {
  return declare(
             Category::body, "subdivision_surface",
             "Limit of the subdivision of a mesh of polygons by the rules of Catmull and Clark, or of a mesh of "
             "triangles by those of Loop: polynomial patches, ever smaller ones towards corners with another number "
             "of faces than four (six triangles), where curvatures may be unbounded.")
      .field("points", points().count(4), "corners of the mesh")
      .field("faces", indices(), "the numbers of the corners of each, counterclockwise seen from outside")
      .field("scheme", choice({"catmull_clark", "loop"}),
             "catmull_clark: one face for each quadrangle (of each corner where there are others); loop: one for each "
             "triangle, more beside corners with less or more than six; 'lekalo evaluate --uv 2t+a,b' finds the "
             "barycentric coordinates a, b in triangle t",
             "catmull_clark")
      .optional("creases", indices(), "chains of points: the edges between them stay sharp; edges of one face are")
      .optional("corners", numbers(),
                "numbers of points that stay where they are; ends of three creases and corners of a border do")
      .field("levels", integer().between(1, 30),
             "steps towards a corner with another number of faces: what is left of a face there is 2^-levels of its "
             "sides; for loop 20 at most, and no more than lets the faces be sewn",
             "10")
      .example(
          "points: [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 2]], faces: [[3, 2, 1, 0], [0, 1, 4], [1, 2, "
          "4], [2, 3, 4], [3, 0, 4]]")
      .built_by(build);
}

}  // namespace lekalo::geometry
