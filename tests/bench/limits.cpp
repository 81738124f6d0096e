#include "limits/limits.hpp"

#include "benchmarks.hpp"
#include "measure.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace hauberk::bench {
namespace {

/// Throws unless it is locked.
LimitResult only_limit(const Scene& scene)
{
  const Prepared& p = scene.prepared();
  std::vector<LimitResult> limits =
      compute_limits(p.model, p.scene, scene.job.task->limit_tasks(), p.settings, 1);
  if (limits.size() != 1) throw ComputationError("a benchmark is of one limit");
  if (limits[0].status != LimitStatus::locked)
    throw ComputationError("the limit is " + to_string(limits[0].status) + ": " + limits[0].message);
  return std::move(limits[0]);
}

/// One limit. The label is what `hauberk run` is given to find the same one.
void add(Scenes& scenes, const std::string& name, const Source& source, std::optional<double> exact = {})
{
  enter("limit/" + name, [&scenes, source, exact](benchmark::State& state) {
    LimitResult limit;
    measure(state, [&] { return [&limit, &scene = scenes.at(source)] { limit = only_limit(scene); }; });
    if (!limit.value) return;
    state.SetLabel(source.arguments());
    state.counters[counter::evaluations] = static_cast<double>(limit.evaluations);
    state.counters[counter::newton] = limit.iterations;
    state.counters[counter::value] = *limit.value;
    if (exact) state.counters[counter::error] = std::abs((*limit.value - *exact) / (1.0 + *exact));
  });
}

/// What makes one limit at 0 degrees, and nothing beside it, out of an experiment of many.
std::vector<std::string> one_limit(const char* sense, std::vector<std::string> more = {})
{
  std::vector<std::string> set{"/load_case/directions_deg=[0]",
                               fmt::format("/load_case/senses=[\"{}\"]", sense), "/solver/lessons=false",
                               "/solver/starts=1"};
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

}  // namespace

void register_limits(Scenes& scenes)
{
  for (const int rings : {2, 4, 8, 16, 32, 64}) {
    add(scenes, fmt::format("chain/{}", rings),
        {"share/experiments/chain.json",
         one_limit("stretch", {fmt::format("/cell/repeat=[{},1]", rings / 2)})},
        17.2 / 12.0 - 1.0);
  }
  for (const char* material : materials) {
    add(scenes, fmt::format("{}/accurate", material),
        published_limits(material, one_limit("stretch", {"/solver/preset=accurate"})));
  }
  add(scenes, "bending/7_threefold", {"loadcases/paraboloid_bending/example.json", one_limit("up")});
}

}  // namespace hauberk::bench
