#include "sample_run.hpp"

#include <cmath>

namespace hauberk::test {
namespace {

class Ring final : public Shape {
  std::vector<ParameterInfo> infos_{{"ring.R", "length", 5.0, 0.1, 100.0, "ring radius"},
                                    {"ring.r", "length", 0.7, 0.01, 10.0, "tube radius"}};
  const std::vector<ParameterInfo>& do_parameters() const override { return infos_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    Primitive ring;
    ring.name = "ring";
    ring.size = {p[0], p[1], p[1]};
    out.push_back(ring);
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    out.emplace_back(primitive_dofs * 2, 0.0);
  }
};

SceneSpec scene()
{
  SceneSpec out;
  out.types.push_back({"link", std::make_shared<Ring>()});
  Pose turned;
  turned.position = {6.0, 0.0, 0.0};
  turned.rotation = rotation_exp({90.0 * degree, 0.0, 0.0});
  out.elements = {{0, {5.0, 0.7}, {}}, {0, {4.0, 0.6}, turned}};
  out.lattice = {{12.0, 0.0, 0.0}, {0.0, 100.0, 0.0}};
  out.length = 4.5;
  return out;
}

LimitResult limit(double degrees, const char* sense, double value)
{
  LimitResult out;
  out.load_case = "in_plane_periodic";
  out.direction = Direction::at_degrees(degrees);
  out.sense = sense;
  out.measure = "tensor";
  out.status = LimitStatus::locked;
  out.value = value;
  out.companions = {{"line_stretch", value}};
  out.macro = {{"exx", value}, {"eyy", 0.1}, {"exy", -0.0}};
  out.links_kept = true;
  out.min_gap = 1e-9;
  out.starts = {{value, {value, 0.1, 0.0}, 0.0, 12345678901234567890ULL, "start", 2}};
  out.poses = {Pose{}, scene().elements[1].rest};
  ContactForce contact;
  contact.elements = {0, 1};
  contact.normal = {1.0, 0.0, 0.0};
  contact.force = 1.0 / 3.0;
  out.contacts = {contact};
  return out;
}

std::vector<LimitResult> limits(double scale)
{
  std::vector<LimitResult> out;
  for (int k = 0; k < 12; ++k) {
    const double theta = 15.0 * k;
    out.push_back(limit(theta, "stretch", scale * (0.1 + 0.06 * std::cos(2.0 * theta * degree))));
    out.push_back(limit(theta, "compress", -scale * (0.08 - 0.05 * std::cos(2.0 * (theta - 20.0) * degree))));
  }
  return out;
}

std::vector<ProfilePoint> profile(const std::vector<LimitResult>& limits)
{
  std::vector<ProfilePoint> out;
  for (std::size_t i = 0; i < limits.size(); i += 2) {
    const double s = *limits[i].value, c = *limits[i + 1].value;
    out.push_back({limits[i].direction.degrees(), s, c, (s - c) / (1.0 + c)});
  }
  return out;
}

}  // namespace

RunResult sample_run()
{
  RunResult run;
  run.scene = scene();
  run.limits = limits(1.0);
  run.profiles = profile(run.limits);
  return run;
}

RunResult sample_design()
{
  RunResult run = sample_run();
  DesignResult design;
  design.quantity = "eta";
  design.status = "converged";
  design.variables = {{"0/ring.R", 5.0, 5.25, 4.0, 6.5, {0}}};
  for (int k = 0; k < 6; ++k) {
    DesignTargetResult target;
    target.direction_deg = 30.0 * k;
    target.target = *run.profiles[2 * static_cast<std::size_t>(k)].eta + (k == 3 ? 0.03 : 0.002);
    design.targets.push_back(target);
  }
  design.initial_scene = scene();
  design.initial_limits = limits(0.5);
  run.design = design;
  return run;
}

std::string sample_experiment()
{
  return R"({
    "name": "chain", "task": "design", "length_unit": "mm", "seed": 7,
    "elements": {"link": {"shape": "torus_union", "tori": [{"name": "ring"}], "parameters": {"ring.R": 5}}},
    "cell": {"vectors": [[6, 0], [0, 100]], "repeat": [2, 1], "place": []},
    "load_case": {"plugin": "in_plane_periodic", "directions_deg": [0], "step": 12.323883579598581},
    "design": {"quantity": "eta"},
    "expect": [{"pointer": "/limits/0/value", "value": 1}]})";
}

}  // namespace hauberk::test
