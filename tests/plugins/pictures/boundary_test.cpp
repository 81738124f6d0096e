/// The boundary on the disk: PLY, read back; picture; table; JSON.

#include "pictures/boundary.hpp"

#include "document/json_text.hpp"
#include "occurrences.hpp"
#include "results/csv.hpp"
#include "results/direction_json.hpp"
#include "results/document.hpp"
#include "sample_run.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace hauberk {
namespace {

using test::occurrences;

const std::vector<std::string> names{"exx", "eyy", "exy"};

LimitResult limit(std::array<double, 3> direction, std::array<double, 3> macro)
{
  LimitResult out;
  out.load_case = "in_plane_periodic";
  out.direction = Direction::along(direction);
  out.sense = "along";
  out.measure = "metric";
  out.status = LimitStatus::locked;
  out.value = 1.0 / 3.0;
  for (std::size_t k = 0; k < 3; ++k) out.macro.emplace_back(names[k], macro[k]);
  return out;
}

/// An octahedron of limits; one has no state, another stalled.
RunResult octahedron()
{
  RunResult run = test::sample_run();
  run.profiles.clear();
  run.limits = {limit({1, 0, 0}, {0.1, 0, 0}),  limit({-1, 0, 0}, {-0.2, 0.01, 0}),
                limit({0, 1, 0}, {0, 0.3, 0}),  limit({0, -1, 0}, {0, -1.0 / 7.0, 0}),
                limit({0, 0, 1}, {0, 0, 0.05}), limit({0, 0, -1}, {0, 0, -0.06})};
  BoundarySurface surface;
  for (const int x : {0, 1}) {
    for (const int y : {2, 3}) {
      for (const int z : {4, 5}) {
        const bool even = (x + y + z) % 2 == 0;
        surface.triangles.push_back(even ? Triangle{x, y, z} : Triangle{x, z, y});
      }
    }
  }
  surface.margin = 1e-8;
  surface.shortfalls = {{0, 2, 0.125}};
  run.boundary = surface;
  return run;
}

struct Ply {
  std::vector<std::vector<double>> vertices;
  std::vector<std::array<int, 3>> faces;
};

/// What another program would read, by the header alone.
Ply read_ply(const std::string& text)
{
  std::istringstream in(text);
  std::string line, word, element;
  std::getline(in, line);
  EXPECT_EQ(line, "ply");
  std::getline(in, line);
  EXPECT_EQ(line, "format ascii 1.0");
  std::size_t vertices = 0, faces = 0, properties = 0;
  while (std::getline(in, line) && line != "end_header") {
    std::istringstream words(line);
    words >> word;
    if (word == "element") {
      words >> element;
      words >> (element == "vertex" ? vertices : faces);
    } else if (word == "property" && element == "vertex") {
      ++properties;
    } else if (word == "property") {
      EXPECT_EQ(line, "property list uchar int vertex_indices");
    } else {
      EXPECT_EQ(word, "comment");
    }
  }
  Ply out;
  for (std::size_t k = 0; k < vertices; ++k) {
    std::getline(in, line);
    std::istringstream numbers(line);
    out.vertices.emplace_back();
    for (double x = 0.0; numbers >> x;) out.vertices.back().push_back(x);
    EXPECT_EQ(out.vertices.back().size(), properties);
  }
  for (std::size_t k = 0; k < faces; ++k) {
    int n = 0, a = 0, b = 0, c = 0;
    in >> n >> a >> b >> c;
    EXPECT_EQ(n, 3);
    out.faces.push_back({a, b, c});
  }
  EXPECT_TRUE(static_cast<bool>(in));
  in >> word;
  EXPECT_TRUE(in.eof());
  return out;
}

TEST(BoundaryPly, HasEveryLimitAndTriangle)
{
  const RunResult run = octahedron();
  const Ply ply = read_ply(boundary_ply(run, "strain", names));
  ASSERT_EQ(ply.vertices.size(), 6U);
  ASSERT_EQ(ply.faces.size(), 8U);
  EXPECT_EQ(ply.vertices[3], (std::vector<double>{0, -1.0 / 7.0, 0, 1.0 / 3.0, 0, 0, -1, 0, 3}));
  double volume = 0.0;
  for (const auto& f : ply.faces) {
    const auto at = [&](int k) {
      const auto& v = ply.vertices[k];
      return Vec3(v[0], v[1], v[2]);
    };
    volume += at(f[0]).dot(at(f[1]).cross(at(f[2]))) / 6.0;
  }
  // Of an octahedron: a sixth of the product of its diagonals, less what one tip is off its axis.
  EXPECT_NEAR(volume, 0.3 * (0.3 + 1.0 / 7.0) * 0.11 / 6.0, 1e-4);
}

TEST(BoundaryPly, LeavesOutWhatIsNotLocked)
{
  RunResult run = octahedron();
  run.limits[1].status = LimitStatus::unbounded;
  run.limits[1].value.reset();
  run.limits[1].macro.clear();
  run.limits[4].status = LimitStatus::stalled;
  const Ply ply = read_ply(boundary_ply(run, "strain", names));
  ASSERT_EQ(ply.vertices.size(), 5U) << "a state that is no limit is still a point";
  EXPECT_EQ(ply.vertices[3][4], 3.0) << "status stalled";
  EXPECT_EQ(ply.vertices[3][8], 4.0) << "index among the limits";
  ASSERT_EQ(ply.faces.size(), 2U);
  for (const auto& face : ply.faces) {
    for (const int k : face) EXPECT_EQ(ply.vertices[k][4], 0.0);
  }
}

TEST(BoundarySvg, ShowsEveryTriangleInFourViews)
{
  RunResult run = octahedron();
  PlotLabels labels{"a <b>", "metric", "stretch", "compress", "strain"};
  std::string svg = boundary_svg(run, labels, names);
  EXPECT_EQ(occurrences(svg, "<polygon "), 32);
  EXPECT_EQ(occurrences(svg, "a &lt;b&gt;"), 1);
  EXPECT_EQ(occurrences(svg, "6 directions, 0 of them without a locked limit"), 1);
  EXPECT_EQ(svg, boundary_svg(run, labels, names));
  run.boundary->triangles.clear();
  svg = boundary_svg(run, labels, names);
  EXPECT_EQ(occurrences(svg, "<polygon "), 0);
  EXPECT_EQ(occurrences(svg, "<circle "), 24) << "a list is shown as dots";
  for (LimitResult& l : run.limits) l.value.reset();
  EXPECT_EQ(occurrences(boundary_svg(run, labels, names), "No direction has a limit to show."), 1);
}

TEST(BoundaryDocument, HoldsTheSurface)
{
  const RunResult run = octahedron();
  const auto document = results_document(run, test::sample_experiment(), names);
  const boost::json::object& first = document.at("limits").as_array()[0].as_object();
  EXPECT_TRUE(first.at("direction_deg").is_null());
  EXPECT_EQ(entered_direction(first), run.limits[0].direction);
  EXPECT_EQ(boost::json::value(document).at_pointer("/boundary/shortfalls/0/by").as_double(), 0.125);
  EXPECT_EQ(boost::json::value(document).at_pointer("/boundary/triangles").as_array().size(), 8U);
}

TEST(BoundaryCsv, HasTheComponentsInColumns)
{
  RunResult run = octahedron();
  run.limits.resize(1);
  run.limits.push_back(run.limits[0]);
  run.limits[1].direction = Direction::at_degrees(30.0);
  std::istringstream lines(limits_csv(run.limits, names));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(
      line.substr(0, 104),
      "load_case,direction_deg,direction_exx,direction_eyy,direction_exy,sense,measure,value,exx,eyy,exy,"
      "status");
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 45), "in_plane_periodic,,1,0,0,along,metric,0.33333");
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 28), "in_plane_periodic,30,,,,alon");
}

}  // namespace
}  // namespace hauberk
