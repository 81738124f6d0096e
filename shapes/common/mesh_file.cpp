#include "common/mesh_file.hpp"

#include "common/text_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace hauberk {
namespace {

/// Replaces points by those that `number` says, and leaves out triangles that have one twice.
void renumber(MeshFile& mesh, const std::vector<int>& number)
{
  for (auto& t : mesh.triangles) {
    for (int& k : t) k = number[k];
  }
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

}  // namespace

namespace detail {

void join_equal_points(MeshFile& mesh)
{
  const auto same = [&mesh](int i, int j) {
    const Vec3 &a = mesh.points[i], &b = mesh.points[j];
    return a == b;
  };
  std::vector<int> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&mesh](int i, int j) {
    const Vec3 &a = mesh.points[i], &b = mesh.points[j];
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (a[k] != b[k]) return a[k] < b[k];
    }
    return i < j;
  });
  // Of equal ones the first stands for all.
  std::vector<int> first(mesh.points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && same(order[k - 1], order[k]);
    first[order[k]] = again ? first[order[k - 1]] : order[k];
  }
  std::vector<int> number(mesh.points.size());
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < first.size(); ++k) {
    if (first[k] == static_cast<int>(k)) {
      number[k] = static_cast<int>(points.size());
      points.push_back(mesh.points[k]);
    } else {
      number[k] = number[first[k]];
    }
  }
  mesh.points = std::move(points);
  renumber(mesh, number);
}

void join_near_points(MeshFile& mesh, double distance)
{
  if (!(distance > 0.0) || mesh.points.empty()) return;
  Vec3 low = mesh.points.front();
  for (const Vec3& x : mesh.points) low = low.cwiseMin(x);
  using Cell = std::array<long, 3>;
  const auto cell_of = [&](const Vec3& x) {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      cell[k] = static_cast<long>(std::floor((x[i] - low[i]) / distance));
    }
    return cell;
  };
  std::map<Cell, std::vector<int>> kept;
  const auto near = [&](const Vec3& x, const Cell& at, const std::vector<Vec3>& points) {
    for (int k = 0; k < 27; ++k) {
      const auto found = kept.find({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
      if (found == kept.end()) continue;
      for (const int i : found->second) {
        if ((points[i] - x).norm() < distance) return i;
      }
    }
    return -1;
  };
  std::vector<int> number;
  number.reserve(mesh.points.size());
  std::vector<Vec3> points;
  for (const Vec3& x : mesh.points) {
    const Cell cell = cell_of(x);
    int same = near(x, cell, points);
    if (same < 0) {
      same = static_cast<int>(points.size());
      points.push_back(x);
      kept[cell].push_back(same);
    }
    number.push_back(same);
  }
  mesh.points = std::move(points);
  renumber(mesh, number);
}

bool has_pairs_of_edges(const MeshFile& mesh)
{
  std::vector<std::pair<int, int>> edges, back;
  edges.reserve(3 * mesh.triangles.size());
  back.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace_back(t[k], t[(k + 1) % 3]);
      back.emplace_back(t[(k + 1) % 3], t[k]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(back.begin(), back.end());
  return edges == back;
}

}  // namespace detail

MeshFile read_mesh_file(const std::string& path, const MeshLimits& limits)
{
  const std::string extension = detail::ending_of(path);
  if (extension != ".obj" && extension != ".stl")
    throw InputError(fmt::format("{}: expected a file .obj or .stl", path));
  const std::string bytes = detail::read_bytes(path, limits.megabytes);
  if (bytes.empty()) throw InputError(fmt::format("{}: is empty", path));
  return extension == ".obj" ? read_obj(bytes, path, limits) : read_stl(bytes, path, limits);
}

}  // namespace hauberk
