#pragma once
/// The rest state on the way from one design to another.

#include "design/design_point.hpp"
#include "design/design_scene.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace hauberk {

/// Gaps within this of the required clearance respond together when parameters change (L).
inline constexpr double response_range = 0.03;

/// Follows rest states without a collision. Remembers the last way, as a step that is found safe is then
/// tried. Not thread safe.
class RestPath {
 public:
  explicit RestPath(std::shared_ptr<const DesignScene> scene) : scene_(std::move(scene)) {}

  /// How far the rest state can be followed, and where it is there.
  struct End {
    double share = 0.0;  ///< of the way; 1: all of it
    State rest;
  };
  const End& follow(const std::shared_ptr<DesignPoint>& from, const DesignPoint& to);

 private:
  End end_of_way(const DesignPoint& from, const DesignPoint& to) const;

  std::shared_ptr<const DesignScene> scene_;
  End end_;
  std::shared_ptr<DesignPoint> from_;
  std::vector<double> to_;
};

}  // namespace hauberk
