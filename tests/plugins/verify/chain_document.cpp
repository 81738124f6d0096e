#include "chain_document.hpp"

#include <hauberk/verify/verify.hpp>

#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <numbers>

namespace hauberk::test {
namespace {

namespace json = boost::json;
using Eigen::Quaterniond;
using Eigen::Vector3d;

json::array vector(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

json::array quaternion(Quaterniond q)
{
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return {q.w(), q.x(), q.y(), q.z()};
}

json::object pose(const Vector3d& x, const Quaterniond& q)
{
  return {{"position", vector(x)}, {"quaternion", quaternion(q)}};
}

json::object ring(double R, double r0, double r1)
{
  return {{"name", "ring"},
          {"kind", r0 == r1 ? "circle_tube" : "revolved_ellipse"},
          {"parameters", {{"R", R}, {"r0", r0}, {"r1", r1}}},
          {"position", {0, 0, 0}},
          {"quaternion", {1, 0, 0, 0}}};
}

json::object contact(int image, const Vector3d& a, const Vector3d& b, const Vector3d& normal, double gap)
{
  return {{"elements", {0, 1}},        {"primitives", {0, 0}},
          {"image", {image, 0}},       {"points", {vector(a), vector(b)}},
          {"normal", vector(normal)},  {"gap", gap},
          {"force", 1.0 / rest_period}};
}

}  // namespace

json::object torus_element(double R, double r0, double r1)
{
  return {{"shape", "torus_union"},
          {"tori", json::array{json::object{{"name", "ring"}}}},
          {"parameters", {{"ring.R", R}, {"ring.r0", r0}, {"ring.r1", r1}}}};
}

json::object placed_element(const std::string& type, const json::object& rest)
{
  return {{"element", type},
          {"position", rest.at("position")},
          {"rotation", {{"quaternion", rest.at("quaternion")}}}};
}

json::value chain_document(const Chain& chain)
{
  const double theta = chain.turned_deg * std::numbers::pi / 180.0;
  const Quaterniond turn(Eigen::AngleAxisd(theta, Vector3d::UnitZ()));
  const Quaterniond upright =
      turn * Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2.0, Vector3d::UnitX()));
  const Vector3d n = turn * Vector3d::UnitX();
  const double apart = chain.gap + chain.clearance;
  const double half = chain.R_a + chain.R_b - chain.r_a - chain.r_b - apart;  // centre to centre
  const double strain = 2.0 * half / rest_period - 1.0;
  const auto r1 = [&](double r0) { return chain.axial > 0.0 ? chain.axial : r0; };

  const double inner = chain.R_a - chain.r_a;
  const json::object macro{
      {"exx", strain * n.x() * n.x()}, {"eyy", strain * n.y() * n.y()}, {"exy", strain * n.x() * n.y()}};
  const double value = strain;  // of n n^T, by either measure

  json::object limit{
      {"load_case", "in_plane_periodic"},
      {"direction_deg", chain.turned_deg},
      {"sense", "stretch"},
      {"measure", chain.measure},
      {"value", value},
      {"line_stretch", strain},
      {"macro", macro},
      {"status", "locked"},
      {"min_gap", chain.gap},
      {"links_kept", true},
      {"contact", "nearest"},
      {"sensitivity", {{"clearance", -2.0 / rest_period}, {"parameters", json::object()}}},
      {"starts", {{{"value", value}, {"macro", macro}, {"z_range", 0}, {"seed", 1}, {"count", 1}}}},
      {"poses", {pose(Vector3d::Zero(), turn), pose(half * n, upright)}},
      {"contacts",
       {contact(0, inner * n, (inner - apart) * n, -n, chain.gap),
        contact(-1, -inner * n, -(inner - apart) * n, n, chain.gap)}},
      {"force_balance", 0.0}};

  const Vector3d v1 = rest_period * n, v2 = turn * Vector3d(0.0, 100.0, 0.0);
  json::object scene{{"cell_vectors", {{v1.x(), v1.y()}, {v2.x(), v2.y()}}},
                     {"length", std::max(chain.R_a, chain.R_b)},
                     {"elements",
                      {{{"type", "a"},
                        {"parameters", {{"ring.R", chain.R_a}}},
                        {"rest", pose(Vector3d::Zero(), turn)},
                        {"primitives", json::array{ring(chain.R_a, chain.r_a, r1(chain.r_a))}}},
                       {{"type", "b"},
                        {"parameters", {{"ring.R", chain.R_b}}},
                        {"rest", pose(0.5 * v1, upright)},
                        {"primitives", json::array{ring(chain.R_b, chain.r_b, r1(chain.r_b))}}}}}};

  return {{"format", "hauberk-results/2"},
          {"experiment",
           {{"elements",
             {{"a", torus_element(chain.R_a, chain.r_a, r1(chain.r_a))},
              {"b", torus_element(chain.R_b, chain.r_b, r1(chain.r_b))}}},
            {"cell",
             {{"vectors", scene.at("cell_vectors")},
              {"place",
               {placed_element("a", pose(Vector3d::Zero(), turn)),
                placed_element("b", pose(0.5 * v1, upright))}}}},
            {"solver", {{"clearance", chain.clearance}}},
            {"load_case",
             {{"plugin", "in_plane_periodic"},
              {"out_of_plane", 0},
              {"directions_deg", json::array{chain.turned_deg}},
              {"senses", json::array{"stretch"}},
              {"measure", chain.measure}}}}},
          {"scene", scene},
          {"limits", json::array{std::move(limit)}},
          {"profiles",
           json::array{json::object{
               {"direction_deg", chain.turned_deg}, {"e_s", value}, {"e_c", nullptr}, {"eta", nullptr}}}},
          {"design", nullptr}};
}

std::string limit_line(const json::value& document)
{
  const VerifyReport report = verify(document);
  return report.lines.empty() ? std::string("no line") : report.text().substr(0, report.text().find('\n'));
}

}  // namespace hauberk::test
