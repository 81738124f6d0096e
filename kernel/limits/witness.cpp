#include "limits/limit_report.hpp"
#include "model/links.hpp"
#include "motion/advancement.hpp"

#include <fmt/format.h>

namespace hauberk {
namespace {

/// Pieces that become one at most, while stretches grow by no more than this: longer ones take many images to
/// certify.
constexpr std::size_t most_joined = 32;
constexpr double most_growth = 1.5;

/// The same way in fewer pieces: from each state straight to a far one that it certainly reaches.
std::vector<State> in_fewer_pieces(const Model& m, const std::vector<State>& path)
{
  const auto largest = [&m](const State& s) { return m.load->stretch_range(s.macro_values()).second; };
  std::vector<State> out{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t span = std::min(most_joined, path.size() - 1 - at);
    while (span > 1 &&
           (largest(path[at + span]) > most_growth * largest(path[at]) ||
            largest_safe_step(m, path[at], difference(m, path[at], path[at + span]), keep_gap).alpha < 1.0))
      span /= 2;
    at += span;
    out.push_back(path[at]);
  }
  return out;
}

WitnessState reported(const Model& m, const State& s)
{
  WitnessState out;
  for (int k = 0; k < m.macro_count; ++k) {
    out.macro.emplace_back(m.load->macros()[k].name, s.macro[k] * m.macro_unit(k));
  }
  out.poses = poses(m, s);
  for (Pose& p : out.poses) p.position *= m.length;
  return out;
}

}  // namespace

void add_witness(LimitResult& r, const Model& m, const LimitTask& task, const Locked& l)
{
  r.iterations = l.iterations;
  r.evaluations = l.evaluations;
  r.links_kept = links_kept(m, l.path.back());
  const Boundedness links = bounded_by_links(m, task);
  if (links == Boundedness::attained || !r.links_kept) {
    r.status = LimitStatus::failed;
    r.message = "the strain left every bound although links bound this direction";
    return;
  }
  const State* last = nullptr;
  const std::vector<State> path = in_fewer_pieces(m, l.path);
  for (const State& s : path) {
    if (last == nullptr || step_norm(m, difference(m, *last, s)) > 0.0) r.witness.push_back(reported(m, s));
    last = &s;
  }
  const auto [lo, hi] = m.load->stretch_range(l.state.macro_values());
  r.certificate =
      fmt::format("a motion of {} pieces without intersection, to singular values of F of {:.3g} and {:.3g}",
                  r.witness.size() - 1, lo, hi);
  if (links == Boundedness::unbounded) {
    r.status = LimitStatus::unbounded;
    r.message = "no chain of links holds this direction, and a motion from rest goes past every bound";
  } else {
    r.status = LimitStatus::not_attained;
    r.message = "approached only as another strain grows without bound: a motion from rest is the evidence";
  }
}

}  // namespace hauberk
