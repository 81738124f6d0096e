#pragma once
/// A sheet with so much room that few searches come to the way in which it folds furthest.

#include "limits/limit_report.hpp"
#include "loadcases/in_plane_periodic/in_plane_periodic.hpp"
#include "scenes.hpp"

namespace hauberk::test {

inline const KeepGoing uninterrupted = [] { return true; };

/// European 4-in-1 of thin wire (share/weaves, inner diameter 8, wire 0.8): the loosest sheet that hangs
/// together.
struct ThinSheet {
  InPlanePeriodic load{StrainMeasure::tensor, {}, InPlanePeriodic::Hold{true, false}};
  SceneSpec scene = chainmail(1, 1, 34.115, 0.4);
  LimitTask task{Direction::at_degrees(0.0), Sense::negative};
  LimitSettings settings;
  Model model;

  ThinSheet()
  {
    const Vec3 cell(11.0105246064, 5.486713848, 0.0);
    scene.lattice = {Vec3(cell.x(), 0.0, 0.0), Vec3(0.0, cell.y(), 0.0)};
    for (PlacedElement& e : scene.elements) {
      e.parameters = {4.4, 0.4, 0.4};
      if (e.rest.position.norm() > 0.0) e.rest.position = 0.5 * cell;
    }
    model = make_model(scene, load, 0.0);
    settings.schedule.last = 1e-4;
  }
  double pushed(const Locked& found) const { return reached(model, task, found.state); }
};

}  // namespace hauberk::test
