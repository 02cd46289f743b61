// A Model made ready for rays: shapes in a hierarchy over Embree, materials and lights by index.
//
// Embree proposes, double decides: Embree's float boxes only find candidate pieces; every hit is computed and compared
// in double. The world is centred on the scene, rays are advanced in double to its bounding sphere before they are
// rounded, and boxes are inflated so that no candidate is lost (docs/internals/rays.md).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/model/model.h"
#include "render/ray.h"
#include "render/trace/obstacles.h"

namespace lekalo::render {

struct WorldStatistics {
  size_t pieces = 0;
  size_t triangles = 0;
  size_t instances = 0;
  size_t bytes = 0;         // of pieces, shapes, the vertices of meshes and instances
  size_t object_bytes = 0;  // of the model's objects, and what the World knows of each
  // That Embree took in this process while the World was built, vertices of meshes included.
  size_t hierarchy_bytes = 0;
  // How lines meet the surfaces and shapes, by name: those of one method together.
  struct Method {
    std::string name;
    size_t count = 0;  // of surfaces and shapes
    size_t pieces = 0;
    size_t bytes = 0;
  };
  std::vector<Method> methods;
  double build_seconds = 0;
};

// What a hit is on: the surface (of a mesh that stands for surfaces the one behind its facet), or else the shape; in
// their own space. Neither of a mesh of mere triangles.
struct HitTarget {
  const geometry::Surface* surface = nullptr;
  const geometry::Shape* shape = nullptr;
  geometry::Affine to_world;
};

class World final : public CurvatureSource {
 public:
  // Compiles the model's objects. Meshes for pixel tolerances are made for the model's camera. Without `parameters` the
  // points of nearest hits may have none (u, v, du and dv zero) where neither a material nor the integrator asks for
  // them.
  explicit World(std::shared_ptr<const Model> model, bool parameters = true);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // The nearest hit with t in [ray.t_min, ray.t_max]; ties by (object, face, piece). `among`: for rays that end in the
  // box that obstacles() was asked for.
  bool nearest(const Ray& ray, Hit& hit, const Obstacles& among = {}) const;
  // The same for as many rays as hits; a hit's instance is -1 where its ray meets nothing. Triangles of meshes, and
  // pieces of surfaces, are found faster so if neighbours in the list go the same way. Between triangles that float
  // cannot tell apart the choice may be another than for the ray alone.
  void nearest(std::span<const Ray> rays, std::span<Hit> hits) const;
  // True if anything that shadow rays see lies between t_min and t_max.
  bool occluded(const Ray& ray) const;
  // What may stand between the origin of shadow rays and the places of a box, and whether one of it occludes a ray that
  // ends in the box. Pays for several rays.
  Obstacles obstacles(const Ray& from, const geometry::Box3& to) const;
  bool occluded(const Ray& ray, const Obstacles& among) const;
  // The same for as many rays as answers, faster as above.
  void occluded(std::span<const Ray> rays, const Obstacles& among, std::span<bool> occluded) const;
  // True if lists of rays are found faster than their rays one by one.
  bool gains_by_lists() const;
  // All hits in order of t, one for each crossing; the second form puts them in place of what `hits` held.
  std::vector<Hit> all_hits(const Ray& ray) const;
  void all_hits(const Ray& ray, std::vector<Hit>& hits) const;

  // Position, normals and derivatives at a hit; `ray` is the one that found it.
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;
  HitTarget target(const Hit& hit) const;
  geometry::SurfaceCurvature curvature(const SurfacePoint& point) const override;
  // Lets the ray begin at the point, on the given side of it, clear of the point's error bound: at `clearance`.
  void leave(const SurfacePoint& point, const Vec3& side, Ray& ray) const;
  static double clearance(const SurfacePoint& point) { return 4 * point.error; }

  // The object that a point belongs to, which may stand in a group.
  const Object& object(const SurfacePoint& point) const;
  // All objects by the number that points carry, those without surfaces too: groups before their members.
  const std::vector<const Object*>& objects() const;
  const Material& material(const SurfacePoint& point, bool front) const;
  // True if some material lets light through, so that what occludes may only tint.
  bool has_transmitting_materials() const { return transmits_; }
  // True if shadow rays see other things than reflected ones.
  bool shadows_differ() const { return shadows_differ_; }
  // False if nothing else can be at the place of a point of a body of some substance; only asked of these.
  bool may_be_in_contact(const SurfacePoint& point) const {
    return contacts_.empty() || contacts_[point.instance].contains(point.position);
  }
  // False if the place is in no body of some substance.
  bool may_be_in_medium(const Vec3& place) const;
  const Model& model() const { return *model_; }
  // The lights that are somewhere, and the sum I_a of the ambient ones.
  const std::vector<LightPtr>& lamps() const { return lamps_; }
  const Spectrum& ambient() const { return ambient_; }
  // Numbers of the lamps that a ray can meet, and of those among them that show themselves in place of the background.
  const std::vector<size_t>& lamps_with_size() const { return lamps_with_size_; }
  const std::vector<size_t>& backdrops() const { return backdrops_; }
  // Numbers of groups (LightParts): of each lamp, and the ambient light of each group from 0 on.
  const std::vector<int>& lamp_groups() const { return lamp_groups_; }
  const std::vector<Spectrum>& ambient_by_group() const { return ambient_by_group_; }
  // What glows by itself: a copy of an object, a ball that holds it, and about how bright it is. None at all if there
  // are too many to look for.
  struct Glow {
    int64_t instance;
    Vec3 center;
    double radius;
    float brightness;
  };
  const std::vector<Glow>& glows() const { return glows_; }
  WorldStatistics statistics() const;
  // Centre and radius of the bounding sphere of all bounded shapes.
  Vec3 center() const;
  double radius() const;

 private:
  void list_contacts();
  void list_glows();

  struct Compiled;
  std::shared_ptr<const Model> model_;
  std::vector<LightPtr> lamps_;
  std::vector<size_t> lamps_with_size_, backdrops_;
  Spectrum ambient_;
  std::vector<int> lamp_groups_;
  std::vector<Spectrum> ambient_by_group_;
  bool transmits_ = false, shadows_differ_ = false;
  std::vector<geometry::Box3>
      contacts_;                       // by instance: where its box meets others'; none at all where that is not known
  std::vector<geometry::Box3> media_;  // hold all bodies of some substance
  std::unique_ptr<Compiled> compiled_;
  std::vector<Glow> glows_;
};

}  // namespace lekalo::render
