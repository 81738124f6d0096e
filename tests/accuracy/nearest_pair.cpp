#include "nearest_pair.hpp"

#include "pair_field.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <vector>

namespace hauberk::brute {
namespace {

using std::numbers::pi;
using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// Samples start here, so that no symmetric pair has a stationary point on one.
constexpr double turn_u = 0.1374, turn_v = 0.2911;

using Places = std::vector<Place<double>>;

void sort(Places& places)
{
  std::sort(places.begin(), places.end(), [](const auto& x, const auto& y) { return x.value < y.value; });
}

/// A sample, and how far its neighbours lie above it: about how far the minimum may lie below it.
struct LowSample {
  Place<double> place;
  double rise;
};

/// Samples no higher than their neighbours, lowest first; first every `stride`-th angle around, then those
/// where something closer may lie.
std::vector<LowSample> low_samples(const PairField<double>& f, int nu, int nv, int stride)
{
  std::vector<double> value(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv));
  const auto u_at = [&](int i) { return turn_u + 2.0 * pi * i / nu; };
  const auto v_at = [&](int j) { return turn_v + 2.0 * pi * j / nv; };
  double best = 1e300;
  const double margin = 2.0 * pi / nu * f.around();
  const auto row = [&](int i) {
    const double least = f.least(u_at(i));
    for (int j = 0; j < nv; ++j) {
      const int k = i * nv + j;
      double& here = value[k];
      here = least - margin > best ? least : f.value(u_at(i), v_at(j));
      best = std::min(best, here);
    }
  };
  for (int i = 0; i < nu; i += stride) row(i);
  for (int i = 0; i < nu; ++i) {
    if (i % stride != 0) row(i);
  }
  const auto at = [&](int i, int j) {
    const int k = (i + nu) % nu * nv + (j + nv) % nv;
    return value[k];
  };
  std::vector<LowSample> out;
  const int side = nv > 1 ? 1 : 0;
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const double here = at(i, j);
      double least = here, most = here;
      for (int a = -1; a <= 1; ++a) {
        for (int b = -side; b <= side; ++b) {
          least = std::min(least, at(i + a, j + b));
          most = std::max(most, at(i + a, j + b));
        }
      }
      if (least >= here) out.push_back({{u_at(i), v_at(j), here}, most - here});
    }
  }
  std::sort(out.begin(), out.end(),
            [](const auto& x, const auto& y) { return x.place.value < y.place.value; });
  return out;
}

/// Local minima from the samples that may hide the lowest, lowest first.
Places search(const PairField<double>& f, const Torus& P, const Torus& F, int density)
{
  const double ratio = std::clamp(P.R / F.R, 1.0, 128.0);
  const int nu = static_cast<int>((f.core() ? 64 : 40) * ratio) * density, nv = f.core() ? 1 : 12 * density;
  const std::size_t most = 6 * static_cast<std::size_t>(density);
  constexpr double arrived = 1e-7;
  Places places;
  double best = 1e300;
  for (const LowSample& s : low_samples(f, nu, nv, 4 * static_cast<int>(ratio))) {
    if (places.size() == most) break;
    if (s.place.value - s.rise > best) continue;
    places.push_back(descend(f, s.place.u, s.place.v, arrived));
    best = std::min(best, places.back().value);
  }
  sort(places);
  return places;
}

bool probe_a(const Torus& a, const Torus& b) { return a.round() != b.round() ? b.round() : a.R >= b.R; }

}  // namespace

NearestPlace nearest_place(const Torus& a, const Torus& b)
{
  NearestPlace out;
  out.probes_a = probe_a(a, b);
  const Torus &P = out.probes_a ? a : b, &F = out.probes_a ? b : a;
  const bool core = P.round();
  const Place<double> best = search(PairField<double>(P, F, core), P, F, 1).front();
  out.distance = best.value;
  // One tube wholly inside the other's: probes from inside see the surface from its other side.
  if (!core)
    out.distance = std::min(out.distance, foot(P, F.round() ? F.core(0.0) : F.surface(0.0, 0.0)).distance);
  const Vec3 normal = foot(F, core ? P.core(best.u) : P.surface(best.u, best.v)).normal;
  out.normal = out.probes_a ? Vec3(-normal) : normal;
  return out;
}

double dense_distance(const Torus& a, const Torus& b)
{
  constexpr int density = 4;
  return std::min(search(PairField<double>(a, b, a.round()), a, b, density).front().value,
                  search(PairField<double>(b, a, b.round()), b, a, density).front().value);
}

PreciseSlack precise_slack(const Torus& a, const Torus& b, double bound)
{
  constexpr int density = 3;
  constexpr std::size_t most = 3;
  constexpr double as_good = 1e-7, arrived = 1e-24;
  Digits50 least = 1e300;
  for (const bool swap : {false, true}) {
    const Torus &P = swap ? b : a, &F = swap ? a : b;
    const bool core = P.round();
    const Places places = search(PairField<double>(P, F, core), P, F, density);
    const PairField<Digits50> f(P, F, core);
    for (std::size_t k = 0; k < std::min(most, places.size()); ++k) {
      const Place<double>& p = places[k];
      if (p.value > places.front().value + as_good) break;
      least = std::min<Digits50>(least, descend<Digits50>(f, Digits50(p.u), Digits50(p.v), arrived).value);
    }
  }
  return {least.convert_to<double>(), Digits50(least - Digits50(bound)).convert_to<double>()};
}

}  // namespace hauberk::brute
