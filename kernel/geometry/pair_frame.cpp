#include "geometry/pair_frame.hpp"

namespace hauberk {

PairFrame::PairFrame(const Body& p, const Pose& pose_p, const Body& f, const Pose& pose_f)
    : P(&p), F(&f), F_facets(f.facets.get())
{
  const Frame wp = world_frame(p, pose_p);
  const Frame wf = world_frame(f, pose_f);
  M = wf.axes;
  a = M.transpose() * (wp.center - wf.center);
  o = M.transpose() * (pose_p.position - wf.center);
  const Mat3 axes = M.transpose() * wp.axes;
  e1 = axes.col(0);
  e2 = axes.col(1);
  e3 = axes.col(2);
  if (p.curve && f.curve) {
    difference = f.curve.get();
    F = f.point.get();
  }
}

}  // namespace hauberk
