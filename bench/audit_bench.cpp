// What an audit costs beside the truth that it is held against: both again and again in one run.
//
//   audit_bench [SIZE [RUNS]]   samples along the terrain's side (4097), runs (15)
#include <algorithm>
#include <cstdio>
#include <vector>

#include "audit/audit.h"
#include "audit/method.h"
#include "bench_support.h"

namespace plumb::bench {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void audit_again_and_again(int size, int runs) {
  const std::string name = "generate:alpine?size=" + std::to_string(size);
  const terrain::Heightfield field = terrain::load_terrain(name);
  const Camera camera = make_camera(terrain::preset_camera(field, "oblique", 1920, 1080, 50.0));
  const audit::MethodTable table = audit::built_in_methods();
  const audit::Method& method = audit::find_method(table, "restricted-quadtree");
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const Tolerance tolerance{1.0, Unit::Pixel};
  const auto prepared = audit::prepare_method(method, field, {}, tolerance);
  const DrawnSurface surface = prepared->draw(camera, tolerance);
  std::vector<double> truth_s, measure_s, ratios;
  for (int run = 0; run < runs; ++run) {
    const audit::AuditResult result = audit::audit_surface(truth, surface, camera);
    truth_s.push_back(result.times.truth_s);
    measure_s.push_back(result.times.measure_s);
    ratios.push_back(measure_s.back() / truth_s.back());
    std::printf("truth %.3f s, measures %.3f s, %.2f times the truth's\n", truth_s.back(),
                measure_s.back(), ratios.back());
    std::fflush(stdout);
  }
  std::printf("median: truth %.3f s, measures %.3f s, %.2f times; least: %.3f s and %.3f s\n",
              median(truth_s), median(measure_s), median(ratios),
              *std::min_element(truth_s.begin(), truth_s.end()),
              *std::min_element(measure_s.begin(), measure_s.end()));
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  plumb::bench::audit_again_and_again(argc > 1 ? std::atoi(argv[1]) : 4097,
                                      argc > 2 ? std::max(1, std::atoi(argv[2])) : 15);
  return 0;
}
