#include "mesh/stacks/node_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>

#include "mesh/stacks/stacks.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::mesh::stacks {
namespace {

// What is known of a mesh is kept by its address. Rounds, since threads seldom meet.
TEST(NodeCache, GivesEveryThreadTheSameMesh) {
  const terrain::StackField field = terrain::generate_stacks("generate:caves?size=33");
  for (int round = 0; round < 20; ++round) {
    const Prepared prepared = prepare(field);
    Octree octree(prepared.densities->size());
    octree.divide([](const Node&) { return true; });
    const std::vector<Node> nodes = octree.drawn();
    constexpr int kThreads = 8;
    std::vector<std::vector<std::shared_ptr<const NodeMesh>>> given(kThreads);
    std::atomic<int> waiting{kThreads};
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        for (--waiting; waiting > 0;) {
        }
        given[static_cast<std::size_t>(t)] = prepared.cache->meshes(octree, nodes);
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      std::set<const NodeMesh*> meshes;
      for (const auto& of_thread : given) meshes.insert(of_thread.at(k).get());
      EXPECT_EQ(meshes.size(), 1u) << "node " << k << ", round " << round;
    }
  }
}

}  // namespace
}  // namespace plumb::mesh::stacks
