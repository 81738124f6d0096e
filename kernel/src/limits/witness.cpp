#include "limit_report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hauberk {
namespace {

WitnessState reported(const Model& m, const State& s)
{
  WitnessState out;
  for (int k = 0; k < m.macro_count; ++k) {
    const MacroInfo& info = m.load->macros()[static_cast<std::size_t>(k)];
    out.macro.emplace_back(info.name, s.macro[k] * std::pow(m.length, info.length_power));
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
  for (const State& s : l.path) {
    if (last == nullptr || step_norm(m, difference(m, *last, s)) > 0.0) r.witness.push_back(reported(m, s));
    last = &s;
  }
  const auto [lo, hi] =
      m.load->stretch_range({l.state.macro.data(), static_cast<std::size_t>(m.macro_count)});
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
