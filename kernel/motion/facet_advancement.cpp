#include "motion/facet_advancement.hpp"

#include "geometry/facets.hpp"
#include "numerics/interrupted.hpp"

#include <algorithm>
#include <limits>

namespace hauberk {
namespace {

/// Part of the time until the target could be reached that one advance takes, as long as that is a finite
/// part of it.
constexpr double share = 0.9;
/// Features this near to their target, as part of the way there from the start, have arrived.
constexpr double arrived = 0.05;
constexpr int most_advances = 1000;

/// Poses and motions of both bodies at a time.
struct Instant {
  Pose a, b;
  Vec3 va, vb;
};

/// Two features to be followed over a part of the step.
struct Followed {
  FeaturePair pair;
  double distance = 0.0;  ///< at the beginning
};

class FacetAdvance {
 public:
  FacetAdvance(const Body& A, const Track& ta, const Body& B, const Track& tb, SafeStep& count,
               const std::function<bool()>* keep_going)
      : A_(A), B_(B), ta_(ta), tb_(tb), count_(count), keep_going_(keep_going)
  {
    bend_ = ta.acceleration + tb.acceleration + ta.w.squaredNorm() * A.reach + tb.w.squaredNorm() * B.reach;
  }

  double run(double limit, double clearance, double keep)
  {
    double s = 0.0, target = -1.0;
    while (s < limit) {
      ask();
      const Instant now = at(s);
      const double rest = limit - s, speed = fastest(now, rest);
      // Parts in which bodies move by an edge at most: of longer ones nearly all features would be
      // candidates.
      const double edge = std::max(A_.facets->mean_edge(), B_.facets->mean_edge());
      const double part = speed * rest <= edge ? rest : edge / speed;
      // What is farther than this stays above the target without being followed.
      const double travel = speed * part;
      const double range = target < 0.0 ? travel / (1.0 - keep) : travel + (target - clearance);
      std::vector<Followed> near;
      find(now, clearance + range, near);
      double smallest = range;
      for (const Followed& f : near) smallest = std::min(smallest, f.distance - clearance);
      if (smallest <= 0.0 && speed > 0.0) return s;
      if (target < 0.0) target = clearance + keep * smallest;
      double safe = part;
      for (const Followed& f : near) {
        if (f.distance <= target) return s;
        poll(keep_going_, ++followed_);
        safe = advance(f, s, safe, now, target);
        if (safe <= 0.0) return s;
      }
      if (safe < part) return s + safe;
      s = part == rest ? limit : s + part;
    }
    return limit;
  }

 private:
  /// Looking for features takes a while even where none is near.
  void ask() const
  {
    if (keep_going_ != nullptr && !(*keep_going_)()) throw Interrupted();
  }

  Instant at(double s) const
  {
    Instant out;
    ta_.at(s, out.a, out.va);
    tb_.at(s, out.b, out.vb);
    return out;
  }

  /// Bound of the relative speed of any two of their points until `rest` later.
  double fastest(const Instant& now, double rest) const
  {
    return (now.va - now.vb).norm() + ta_.w.norm() * A_.reach + tb_.w.norm() * B_.reach + bend_ * rest;
  }

  void find(const Instant& now, double range, std::vector<Followed>& near)
  {
    const PairFrame frame(A_, now.a, B_, now.b);
    near_features(frame, range,
                  [&](const FeaturePair& pair, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& f) {
                    poll(keep_going_, ++count_.evaluations);
                    const double distance = nearest_features(pair, p, f).distance;
                    if (distance < range) near.push_back({pair, distance});
                  });
    if (!near.empty()) ++count_.tight_pairs;
  }

  /// Corners of a feature in the world, relative to `origin`, and their velocities.
  struct Corners {
    std::array<Vec3, 3> at, velocity;
    int count = 0;

    Vec3 mean_velocity() const
    {
      Vec3 sum = Vec3::Zero();
      for (int k = 0; k < count; ++k) sum += velocity[k];
      return sum / count;
    }
    /// How much faster than `mean` one of them is.
    double excess(const Vec3& mean) const
    {
      double most = 0.0;
      for (int k = 0; k < count; ++k) most = std::max(most, (velocity[k] - mean).norm());
      return most;
    }
  };

  static Corners corners(const Body& body, const Pose& pose, const Vec3& v, const Vec3& w,
                         const std::array<int, 3>& points, int count, const Vec3& origin)
  {
    Corners out;
    out.count = count;
    for (int k = 0; k < count; ++k) {
      const std::size_t i = k;
      const Vec3 local = body.center + body.axes * body.facets->points()[points[i]];
      const Vec3 arm = pose.rotation * local;
      out.at[i] = (pose.position - origin) + arm;
      out.velocity[i] = v + w.cross(arm);
    }
    return out;
  }

  /// How long two features stay farther apart than `target` from the time s, at most `most`. Points of a
  /// feature are means of its corners: no two are faster against each other than the mean velocities plus
  /// both excesses, and that grows by the accelerations. So distance/speed is no more than the time to
  /// contact, and is added up until little is left.
  double advance(const Followed& features, double s, double most, const Instant& first, double target)
  {
    double t = 0.0, distance = features.distance;
    const double near = target + arrived * (features.distance - target);
    Instant now = first;
    for (int k = 0; k < most_advances; ++k) {
      const FeaturePair& pair = features.pair;
      const Corners a = corners(A_, now.a, now.va, ta_.w, pair.p, pair.p_count, now.b.position);
      const Corners b = corners(B_, now.b, now.vb, tb_.w, pair.f, pair.f_count, now.b.position);
      if (k > 0) {
        ++count_.evaluations;
        distance = nearest_features(pair, a.at, b.at).distance;
        if (distance <= near) return t;
      }
      const Vec3 ma = a.mean_velocity(), mb = b.mean_velocity();
      const double speed = (ma - mb).norm() + a.excess(ma) + b.excess(mb) + bend_ * (most - t);
      const double left = most - t;
      if (speed * left <= distance - target) return most;
      t += share * (distance - target) / speed;
      now = at(s + t);
    }
    return t;
  }

  const Body& A_;
  const Body& B_;
  const Track& ta_;
  const Track& tb_;
  SafeStep& count_;
  const std::function<bool()>* keep_going_;
  long followed_ = 0;
  double bend_ = 0.0;  ///< bound of the relative acceleration of two points
};

}  // namespace

double advance_facets(const Body& A, const Track& ta, const Body& B, const Track& tb, double clearance,
                      double limit, double keep, SafeStep& count, const std::function<bool()>* keep_going)
{
  return FacetAdvance(A, ta, B, tb, count, keep_going).run(limit, clearance, keep);
}

}  // namespace hauberk
