#include "mesh/stacks/finest_surface.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/parallel.h"

namespace plumb::mesh::stacks {

// A cell reaches half a voxel beyond its node, below the field two.
constexpr double kReachVoxels = 2.0;

Surroundings among_equals() {
  Surroundings around{};
  around.fill(Beside::Same);
  return around;
}

std::vector<Corners> triangles_of(const NodeMesh& mesh, const StackDensities& densities) {
  std::vector<glm::dvec3> places;
  for (const glm::dvec3& position : mesh.position) places.push_back(densities.metres(position));
  std::vector<Corners> triangles;
  for (const Face& face : mesh.faces) {
    triangles.push_back({places[face[0]], places[face[1]], places[face[2]]});
    if (face[3] != kNoCorner)
      triangles.push_back({places[face[0]], places[face[2]], places[face[3]]});
  }
  return triangles;
}

class FinestSurface::Around final : public Surface {
 public:
  Around(const FinestSurface& surface, std::vector<const Place*> places)
      : surface_(surface), places_(std::move(places)) {}
  void look_for(const glm::dvec3& point, NearestTriangle& nearest) const override {
    for (const Place* place : places_) surface_.look_for(*place, point, nearest);
  }

 private:
  const FinestSurface& surface_;
  std::vector<const Place*> places_;
};

FinestSurface::FinestSurface(const StackDensities& densities, NodeCache& cache)
    : densities_(densities), cache_(cache), octree_(densities.size()) {
  set(root_, octree_.root());
}

void FinestSurface::set(Place& place, const Node& node) const {
  place.node = node;
  if (!octree_.is_inside(node)) return;
  const terrain::StackField& field = densities_.field();
  const glm::dvec3 reach = kReachVoxels * glm::dvec3(field.dx_m, field.dy_m, field.voxel_m);
  place.reach = densities_.box(node);
  place.reach.low -= reach;
  place.reach.high += reach;
}

const FinestSurface::Place* FinestSurface::children(const Place& place) const {
  std::call_once(place.divided, [&] {
    place.children = std::make_unique<Place[]>(8);
    for (int k = 0; k < 8; ++k)
      set(place.children[static_cast<std::size_t>(k)], place.node.child(k));
  });
  return place.children.get();
}

// Two threads that need it at once both make it, and one throws the same away: a thread that waited
// might wait for itself, as loops within loops take up each other's work.
const TriangleTree& FinestSurface::tree(const Place& place) const {
  const TriangleTree* known = place.tree.load();
  if (known != nullptr) return *known;
  auto made = std::make_unique<const TriangleTree>(
      triangles_of(*cache_.mesh(place.node, among_equals()), densities_));
  if (place.tree.compare_exchange_strong(known, made.get())) known = made.release();
  return *known;
}

const FinestSurface::Place& FinestSurface::find(const Node& node) const {
  const Place* place = &root_;
  while (place->node.level > node.level) {
    const int below = place->node.level - 1 - node.level;
    const glm::ivec3 at(node.at.x >> below & 1, node.at.y >> below & 1, node.at.z >> below & 1);
    place = &children(*place)[at.x | at.y << 1 | at.z << 2];
  }
  return *place;
}

void FinestSurface::collect(const Place& place, std::vector<const Place*>& places) const {
  if (place.reach.empty()) return;
  if (place.node.level == 0) {
    places.push_back(&place);
    return;
  }
  for (int k = 0; k < 8; ++k) collect(children(place)[k], places);
}

void FinestSurface::make(std::span<const Node> nodes) const {
  std::vector<const Place*> places;
  for (const Node& node : nodes) collect(find(node), places);
  parallel_for(static_cast<std::int64_t>(places.size()), 1,
               [&](std::int64_t k) { tree(*places[static_cast<std::size_t>(k)]); });
}

std::vector<const TriangleTree*> FinestSurface::within(const Node& node) const {
  std::vector<const Place*> places;
  if (octree_.is_inside(node)) collect(find(node), places);
  std::vector<const TriangleTree*> trees;
  for (const Place* place : places) {
    if (!tree(*place).triangles().empty()) trees.push_back(&tree(*place));
  }
  return trees;
}

std::unique_ptr<Surface> FinestSurface::around(const Node& node) const {
  std::vector<const Place*> places;
  for_each_around(node, [&](const Node& beside) {
    if (octree_.is_inside(beside)) places.push_back(&find(beside));
  });
  return std::make_unique<Around>(*this, std::move(places));
}

// The nearest children first; what is farther than the best so far stays closed.
void FinestSurface::look_for(const Place& place, const glm::dvec3& point,
                             NearestTriangle& nearest) const {
  if (!(squared_distance(point, place.reach) < nearest.squared)) return;
  if (place.node.level == 0) {
    tree(place).look_for(point, nearest);
    return;
  }
  const Place* children = this->children(place);
  std::array<std::pair<double, std::size_t>, 8> order;
  for (std::size_t k = 0; k < 8; ++k) order[k] = {squared_distance(point, children[k].reach), k};
  std::sort(order.begin(), order.end());
  for (const auto& [squared, k] : order) {
    if (!(squared < nearest.squared)) return;
    look_for(children[k], point, nearest);
  }
}

}  // namespace plumb::mesh::stacks
