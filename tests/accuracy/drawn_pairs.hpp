#pragma once
/// Random pairs of tori by the million: one kind at a time, families that are hard for bounds.

#include "nearest_pair.hpp"

#include <random>
#include <string>

namespace hauberk::brute {

/// Kinds of pairs that the certified bound distinguishes.
enum class PairKind { round_round, round_elliptical, elliptical_elliptical };
std::string name(PairKind kind);

enum class DrawFamily {
  generic,        ///< random distance and turn, R_b/R_a in 0.2 .. 5
  linked,         ///< linked rings of like size
  near_touching,  ///< pushed together until 1e-12 .. 1e-2 apart
  aligned,        ///< axes parallel exactly or nearly; coaxial, nested, or side by side
  thin,           ///< tubes of 0.3 to 3 % of the ring, linked or close
  flat,  ///< tubes 3 to 30 times as wide as high or as high as wide; round ones 50 to 90 % of the ring
  extreme_ratio  ///< one ring 10 to 300 times the other
};
inline constexpr int draw_family_count = 7;
std::string name(DrawFamily family);

struct DrawnPair {
  Torus a, b;
  DrawFamily family = DrawFamily::generic;
  double distance = 0.0;  ///< by `nearest_place`; not positive where thirty draws all overlapped
};

/// Pair number k of a kind: deterministic, independent of how many are drawn. The larger ring of an extreme
/// pair, else that of a, has R = 1. Families take turns.
DrawnPair drawn_pair(PairKind kind, long k);

}  // namespace hauberk::brute
