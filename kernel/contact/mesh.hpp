#pragma once
/// Contact of triangle meshes, as Incremental Potential Contact has it (Li et al. 2020). Both bodies of a
/// frame must have facets.

#include "contact/formulation.hpp"

#include <vector>

namespace hauberk {

/// The barrier of every pair of a point and a triangle and of every two edges with gap < g_hat; those of
/// nearly parallel edges are mollified.
void add_mesh(const PairFrame& frame, const ContactSettings& settings, const Request& request,
              SideTerms& out);

/// Smallest distance of two meshes if it is below `range`, else infinity.
double smallest_feature_distance(const PairFrame& frame, double range);

/// Gap of two features, and its derivatives as terms of weight 1, to first order.
struct FeatureGap {
  double gap = 0.0;
  SideTerms terms;
};

/// All pairs of features with gap below `range`, in a fixed order.
std::vector<FeatureGap> feature_gaps(const PairFrame& frame, double range, double clearance);

}  // namespace hauberk
