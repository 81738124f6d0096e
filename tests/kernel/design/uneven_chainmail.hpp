#pragma once
/// A design that takes milliseconds.

#include "design/design_problem.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {

/// One cell of chainmail whose two rings differ, so that contact forces are unique.
inline SceneSpec uneven_chainmail()
{
  SceneSpec s = chainmail(1, 1);
  s.elements[0].parameters = {4.85, 1.10, 1.10};
  s.elements[1].parameters = {4.80, 1.14, 1.14};
  s.length = 4.9;
  return s;
}

inline DesignSpec spec()
{
  DesignSpec d;
  for (int k = 0; k < 2; ++k) {
    d.variables.push_back({std::to_string(k) + "/R", {{k, 0}}, 4.0, 6.0});
    d.variables.push_back({std::to_string(k) + "/r", {{k, 1}, {k, 2}}, 0.6, 1.4});
  }
  d.targets = {{20.0, 0.1, 1.0}, {70.0, 0.3, 2.0}};
  d.hole_clearance = 0.3;
  d.rest_clearance = 0.05;
  d.schedule.first = 0.1;
  d.schedule.last = 1e-2;
  d.schedule.tolerance = d.schedule.last_tolerance = 1e-13;
  return d;
}

/// That design at its start, evaluated and accepted.
struct AtStart {
  SceneSpec scene = uneven_chainmail();
  Sheet load{2};
  DesignSpec design;
  DesignProblem problem;
  std::vector<double> x;

  explicit AtStart(DesignSpec d = spec(), unsigned threads = 1)
      : design(std::move(d)),
        problem({scene, load, 0.0, LimitSettings{}, design, threads, [] { return true; }}),
        x(problem.scene_variables())
  {
    EXPECT_TRUE(problem.evaluate(x, true).ok);
    problem.accept(x);
  }
};

}  // namespace hauberk::test
