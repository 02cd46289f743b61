// Outlines of scene files against what rays meet at 16 times the picture's resolution: each silhouette, border and
// sharp edge, seen or hidden, lies where the list of all faces that a ray meets changes, and each such change lies on
// one of them; what is seen of them lies wherever the depth of what is seen jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "render/drawing/picture_places.h"
#include "render/drawing/visibility/hidden_lines.h"
#include "render/scene/build/load.h"
#include "render/trace/world.h"
#include "support/tier.h"
#include "support/worst.h"

namespace lekalo::render::register_scenes_test {
namespace {

using namespace geometry;

constexpr int kFiner = 16, kWidth = 48;  // pixels of the picture
constexpr double kRegister = 1.6;        // fine pixels
constexpr double kGap = 0.02;            // of the scene's radius
constexpr double kCrease = 0.1;          // of unit normals
constexpr double kInPlane = 1e-9;        // of unit normals, and of the scene's radius

// Those of surfaces, bodies, solids and tubes; the first few are quick.
const std::vector<std::string> kScenes = {"figures/torus_outline",
                                          "figures/plate_csg",
                                          "gallery/trefoil",
                                          "drawing/csg_leaves",
                                          "figures/solids_with_dimensions",
                                          "figures/plate_bodies",
                                          "figures/plate_quadrics",
                                          "figures/plate_intersections",
                                          "figures/machined_part",
                                          "figures/vase",
                                          "figures/plate_fills",
                                          "figures/plate_projections",
                                          "figures/two_eyes",
                                          "figures/light_through_glass",
                                          "figures/nurbs_surface",
                                          "figures/boxes_about_cells",
                                          "figures/plate_sections",
                                          "figures/plate_formulas",
                                          "gallery/flange",
                                          "gallery/klein_bottle",
                                          "gallery/enneper",
                                          "gallery/dini",
                                          "primer/teapot",
                                          "figures/viviani"};
constexpr int kQuick = 4;

// What a ray meets.
struct Interaction {
  struct Sheet {
    int64_t instance;
    int face;
    Vec3 place, normal;
  };
  std::vector<Sheet> sheets;  // by distance
  // Objects and faces of them, sorted: where one thing goes through another is no outline.
  std::vector<std::pair<int64_t, int>> faces;
};

Interaction seen_by(const World& world, const Ray& ray) {
  Interaction seen;
  for (const Hit& hit : world.all_hits(ray)) {
    const SurfacePoint met = world.surface_point(ray, hit);
    seen.sheets.push_back({hit.instance, hit.face, met.position, met.geometric_normal});
    seen.faces.emplace_back(hit.instance, hit.face);
  }
  std::sort(seen.faces.begin(), seen.faces.end());
  return seen;
}

// Whether some outline lies between two rays. Plane faces of parts that were united have none between them where they
// lie in one plane.
bool is_border(const Interaction& a, const Interaction& b, double size) {
  if (a.faces == b.faces) return false;
  if (a.sheets.size() != b.sheets.size()) return true;
  for (size_t k = 0; k < a.sheets.size(); ++k) {
    const Interaction::Sheet &one = a.sheets[k], &other = b.sheets[k];
    if (one.instance == other.instance && one.face == other.face) continue;
    const bool in_plane = glm::length(one.normal - other.normal) < kInPlane &&
                          std::abs(glm::dot(one.normal, other.place - one.place)) < kInPlane * size;
    if (one.instance != other.instance || !in_plane) return true;
  }
  return false;
}

// Neither place lies about on the other's tangent plane, nor near.
bool is_gap(const Interaction& a, const Interaction& b, double size) {
  if (a.sheets.empty() || b.sheets.empty()) return a.sheets.empty() != b.sheets.empty();
  const Interaction::Sheet &one = a.sheets.front(), &other = b.sheets.front();
  const Vec3 way = other.place - one.place;
  const double length = glm::length(way);
  return length > kGap * size && std::abs(glm::dot(one.normal, way)) > 0.5 * length &&
         std::abs(glm::dot(other.normal, way)) > 0.5 * length;
}

void show_all(std::vector<Object>& objects) {
  for (Object& object : objects) {
    Look look;
    look.lines.emplace();
    for (const char* kind : {"boundary", "sharp", "smooth", "silhouette"}) look.lines->styles[kind] = Style();
    object.look = std::make_shared<const Look>(look);
    if (const auto* group = std::get_if<GroupPtr>(&object.shape)) {
      auto shown = std::make_shared<Group>(**group);
      show_all(shown->objects);
      object.shape = GroupPtr(shown);
    }
  }
}

struct Found {
  int pictures = 0, borders = 0, gaps = 0, places = 0, narrow = 0, incomplete = 0;
  double border = 0, gap = 0, place = 0;  // the worst distances
};

class Picture {
 public:
  Picture(Model model, const std::string& name, Found& found) : name_(name), found_(found) {
    const int height = std::max(1, kWidth * model.film.height / model.film.width);
    if (model.make_camera) model.camera = model.make_camera(kWidth, height);
    show_all(model.objects);
    model.drawing.ground = Ground::none;
    world_ = std::make_shared<World>(std::make_shared<Model>(std::move(model)));
    camera_ = world_->model().camera.get();
    finer_ = static_cast<double>(kWidth * kFiner) / camera_->width();
    columns_ = kWidth * kFiner, rows_ = static_cast<int>(finer_ * camera_->height());
    const VisibleLines drawing = visible_lines(*world_, drawing_work(*world_));
    found_.incomplete += drawing.incomplete;
    ++found_.pictures;
    find_borders();
    add_lines(drawing);
    compare();
  }

 private:
  Ray ray(const Vec2& fine) const { return camera_->ray(fine.x / finer_, fine.y / finer_); }

  void find_borders() {
    std::vector<Interaction> above(columns_), row(columns_);
    for (int j = 0; j < rows_; ++j, std::swap(above, row))
      for (int i = 0; i < columns_; ++i) {
        row[i] = seen_by(*world_, ray({i + 0.5, j + 0.5}));
        if (i > 0) add_border({i, j + 0.5}, row[i - 1], row[i]);
        if (j > 0) add_border({i + 0.5, j}, above[i], row[i]);
      }
  }
  void add_border(const Vec2& at, const Interaction& a, const Interaction& b) {
    if (is_border(a, b, world_->radius())) borders_.push_back(at), on_borders_.add(at);
    if (is_gap(a, b, world_->radius())) gaps_.push_back(at);
    if (!a.sheets.empty() && !b.sheets.empty() &&
        glm::length(a.sheets.front().normal - b.sheets.front().normal) > kCrease)
      on_creases_.add(at);
  }

  void add_lines(const VisibleLines& drawing) {
    for (const VisibleLine& line : drawing.lines) {
      if (!line.stroke.outlines && line.stroke.kind != "smooth") continue;
      for (const VisiblePiece& piece : line.pieces) {
        const auto at = [&](double t) { return finer_ * line.curve->place(t).p; };
        constexpr int kChords = 64;
        for (int n = 0; n < kChords; ++n) {
          const double from = piece.t.lo + piece.t.width() * n / kChords,
                       to = piece.t.lo + piece.t.width() * (n + 1) / kChords;
          const int steps = 2 + static_cast<int>(6 * glm::length(at(to) - at(from)));
          for (int k = 0; k <= steps; ++k) {
            const double t = from + (to - from) * k / steps;
            const Vec2 p = at(t);
            on_lines_.add(p);
            if (piece.layers == 0) on_seen_.add(p);
            if (line.stroke.kind == "smooth" || !is_inside(p)) continue;
            const Vec2 along = line.curve->place(t).tangent;
            // Edges at which one face meets itself are creases, of which only those that are seen are known.
            const bool is_crease = line.stroke.kind == "sharp" && line.stroke.supporting_surfaces.empty();
            if (!is_crease || piece.layers == 0)
              places_.push_back({p, glm::length(along) > 0 ? glm::normalize(along) : Vec2(0), is_crease});
          }
        }
      }
    }
  }
  bool is_inside(const Vec2& p) const { return p.x > 3 && p.y > 3 && p.x < columns_ - 3 && p.y < rows_ - 3; }

  // Whether the areas on both sides of an outline are as wide as a fine pixel there, so that there must be a border.
  bool has_room(const Vec2& p, const Vec2& along) const {
    const Vec2 across(-along.y, along.x);
    const auto at = [&](double off) { return seen_by(*world_, ray(p + off * across)).faces; };
    const auto left = at(-0.7), right = at(0.7);
    return left != right && at(-0.2) == left && at(-1.4) == left && at(0.2) == right && at(1.4) == right;
  }

  void compare() {
    const auto note = [&](double distance, double& worst, const char* what, const Vec2& p) {
      worst = tests::worse(worst, distance);
      if (!(distance > kRegister) || ++failures_ > 3) return;
      ADD_FAILURE() << name_ << ": " << what << " at " << p.x << ", " << p.y << " of " << columns_ << " x " << rows_
                    << " is " << distance << " off";
    };
    for (const Vec2& p : borders_) note(on_lines_.distance(p), found_.border, "border", p);
    for (const Vec2& p : gaps_) note(on_seen_.distance(p), found_.gap, "gap", p);
    for (const Place& place : places_) {
      double distance = on_borders_.distance(place.p);
      if (place.is_crease) distance = std::min(distance, on_creases_.distance(place.p));
      if (distance > kRegister && !has_room(place.p, place.along)) {
        ++found_.narrow;
        continue;
      }
      note(distance, found_.place, "outline", place.p);
    }
    found_.borders += static_cast<int>(borders_.size());
    found_.gaps += static_cast<int>(gaps_.size());
    found_.places += static_cast<int>(places_.size());
  }

  struct Place {
    Vec2 p, along;
    bool is_crease;
  };
  std::string name_;
  Found& found_;
  std::shared_ptr<const World> world_;
  const Camera* camera_ = nullptr;
  double finer_ = 1;
  int columns_ = 0, rows_ = 0, failures_ = 0;
  std::vector<Vec2> borders_, gaps_;
  std::vector<Place> places_;
  Places on_borders_, on_creases_, on_lines_, on_seen_;
};

TEST(Register, OutlinesOfSceneFilesLieOnBorders) {
  Found all;
  const size_t scenes = tests::tier_count(static_cast<int>(kScenes.size()), tests::min_of_slow(kQuick));
  for (size_t k = 0; k < scenes; ++k) {
    Found found;
    const auto loaded = load_scene(std::filesystem::path(LEKALO_SOURCE_DIR) / "scenes" / (kScenes[k] + ".yaml"));
    const Model& model = *loaded.model;
    if (model.panels.empty()) Picture(model, kScenes[k], found);
    for (const Panel& panel : model.panels) {
      Model one = model;
      one.panels.clear();
      one.camera = panel.camera, one.make_camera = panel.make_camera;
      if (panel.objects) one.objects = *panel.objects;
      Picture(one, kScenes[k] + " " + panel.name, found);
    }
    std::printf("%-34s %d pictures, %d incomplete, borders %d (%.2f) gaps %d (%.2f) places %d (%.2f), narrow %d\n",
                kScenes[k].c_str(), found.pictures, found.incomplete, found.borders, found.border, found.gaps,
                found.gap, found.places, found.place, found.narrow);
    std::fflush(stdout);
    EXPECT_EQ(found.incomplete, 0) << kScenes[k];
    EXPECT_GT(found.borders, 100) << kScenes[k];
    EXPECT_LE(found.narrow, 1 + found.places / 20) << kScenes[k];
    all.pictures += found.pictures, all.borders += found.borders, all.gaps += found.gaps, all.places += found.places;
    all.narrow += found.narrow;
    all.border = tests::worse(all.border, found.border), all.gap = tests::worse(all.gap, found.gap);
    all.place = tests::worse(all.place, found.place);
  }
  tests::report_figure("scenes", static_cast<double>(scenes));
  tests::report_figure("pictures", all.pictures);
  tests::report_figure("borders", all.borders);
  tests::report_figure("jumps_of_depth", all.gaps);
  tests::report_figure("places_of_outlines", all.places);
  tests::report_figure("places_without_room_for_a_border", all.narrow);
  tests::report_figure("farthest_border_from_a_line", all.border);
  tests::report_figure("farthest_jump_from_a_seen_line", all.gap);
  tests::report_figure("farthest_outline_from_a_border", all.place);
}

}  // namespace
}  // namespace lekalo::render::register_scenes_test
