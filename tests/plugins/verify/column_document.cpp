#include "column_document.hpp"

#include "chain_document.hpp"

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

namespace hauberk::test {
namespace {

namespace json = boost::json;

constexpr double R = 5.0, r = 0.7, apart = 2.0 * (R + r), gap = 1e-11;

json::object flat(double x) { return {{"position", {x, 0, 0}}, {"quaternion", {1, 0, 0, 0}}}; }

json::object element(double x)
{
  return {{"type", "ring"},
          {"parameters", {{"ring.R", R}}},
          {"rest", flat(x)},
          {"primitives", json::array{json::object{{"name", "ring"},
                                                  {"kind", "circle_tube"},
                                                  {"parameters", {{"R", R}, {"r0", r}, {"r1", r}}},
                                                  {"position", {0, 0, 0}},
                                                  {"quaternion", {1, 0, 0, 0}}}}}};
}

/// Between A and the image (image, 0) of B, which lies on the side `side` of A.
json::object contact(int image, double side)
{
  return {{"elements", {0, 1}},
          {"primitives", {0, 0}},
          {"image", {image, 0}},
          {"points", {{side * (R + r), 0, 0}, {side * (R + r + gap), 0, 0}}},
          {"normal", {side, 0, 0}},
          {"gap", gap},
          {"force", 1.0 / column_rest_period}};
}

}  // namespace

json::value column_document()
{
  const double strain = 2.0 * (apart + gap) / column_rest_period - 1.0;
  const json::object macro{{"exx", strain}, {"eyy", 0.0}, {"exy", 0.0}};
  json::object limit{
      {"load_case", "in_plane_periodic"},
      {"direction_deg", 0},
      {"sense", "compress"},
      {"measure", "tensor"},
      {"value", strain},
      {"line_stretch", strain},
      {"macro", macro},
      {"status", "locked"},
      {"min_gap", gap},
      {"links_kept", true},
      {"contact", "nearest"},
      {"sensitivity", {{"clearance", 2.0 / column_rest_period}, {"parameters", json::object()}}},
      {"starts", {{{"value", strain}, {"macro", macro}, {"z_range", 0}, {"seed", 1}, {"count", 1}}}},
      {"poses", {flat(0.0), flat(apart + gap)}},
      {"contacts", {contact(0, 1.0), contact(-1, -1.0)}},
      {"force_balance", 0.0}};
  json::object scene{{"cell_vectors", {{column_rest_period, 0}, {0, 40}}},
                     {"length", R},
                     {"elements", {element(0.0), element(0.5 * column_rest_period)}}};
  return {{"format", "hauberk-results/2"},
          {"experiment",
           {{"elements", {{"ring", torus_element(R, r, r)}}},
            {"cell",
             {{"vectors", scene.at("cell_vectors")},
              {"place",
               {placed_element("ring", flat(0.0)), placed_element("ring", flat(0.5 * column_rest_period))}}}},
            {"solver", {{"clearance", 0}}},
            {"load_case",
             {{"plugin", "in_plane_periodic"},
              {"out_of_plane", 0},
              {"directions_deg", json::array{0}},
              {"senses", json::array{"compress"}},
              {"measure", "tensor"}}}}},
          {"scene", scene},
          {"limits", json::array{std::move(limit)}},
          {"profiles", json::array{json::object{
                           {"direction_deg", 0}, {"e_s", nullptr}, {"e_c", strain}, {"eta", nullptr}}}},
          {"design", nullptr}};
}

}  // namespace hauberk::test
