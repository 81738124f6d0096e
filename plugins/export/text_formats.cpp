#include "document/json_text.hpp"
#include "export/formats.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <iterator>

namespace hauberk::exporting {
namespace {

void put(std::string& out, const void* bytes, std::size_t count)
{
  out.append(static_cast<const char*>(bytes), count);
}

void put_vector(std::string& out, const Vec3& x)
{
  for (const double component : x) {
    const auto single = static_cast<float>(component);
    put(out, &single, sizeof single);
  }
}

/// A name as one word of a line: what is no letter, digit or one of "-_.,[]" becomes "_".
std::string word(const std::string& name)
{
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    out += plain || std::strchr("-_.,[]", c) != nullptr ? c : '_';
  }
  return out;
}

}  // namespace

std::array<int, 3> colour_of(int mesh)
{
  constexpr std::array<std::array<int, 3>, 8> colours{{{176, 182, 190},
                                                       {214, 138, 60},
                                                       {86, 142, 190},
                                                       {110, 170, 110},
                                                       {190, 96, 110},
                                                       {150, 120, 180},
                                                       {200, 180, 90},
                                                       {96, 170, 170}}};
  return colours[static_cast<std::size_t>(mesh) % colours.size()];
}

std::string stl(const Assembly& assembly)
{
  std::string out = "Hauberk, binary STL";  // must not begin with "solid", which text files do
  out.resize(80, '\0');
  std::uint32_t count = 0;
  for (const auto& copy : assembly.copies)
    count += static_cast<std::uint32_t>(assembly.meshes[copy.mesh].triangles.size());
  put(out, &count, sizeof count);
  for (const auto& copy : assembly.copies) {
    Mesh placed;
    append(placed, assembly.meshes[copy.mesh], copy.pose.rotation, copy.pose.position);
    for (const auto& t : placed.triangles) {
      const Vec3 &a = placed.points[t[0]], &b = placed.points[t[1]], &c = placed.points[t[2]];
      const Vec3 n = (b - a).cross(c - a);
      put_vector(out, n.norm() > 0.0 ? Vec3(n.normalized()) : Vec3::Zero());
      for (const Vec3* x : {&a, &b, &c}) put_vector(out, *x);
      const std::uint16_t none = 0;
      put(out, &none, sizeof none);
    }
  }
  return out;
}

std::string obj(const Assembly& assembly)
{
  std::string out =
      fmt::format("# {}, {}; unit {}\n", word(assembly.name), word(assembly.state), assembly.unit);
  std::size_t first = 1;
  for (const auto& copy : assembly.copies) {
    const Mesh& mesh = assembly.meshes[copy.mesh];
    out += fmt::format("g {}\n", word(copy.name));
    for (const Vec3& local : mesh.points) {
      const Vec3 x = copy.pose.position + copy.pose.rotation * local;
      fmt::format_to(std::back_inserter(out), "v {:.9g} {:.9g} {:.9g}\n", x.x(), x.y(), x.z());
    }
    for (const auto& t : mesh.triangles)
      fmt::format_to(std::back_inserter(out), "f {} {} {}\n", first + t[0], first + t[1], first + t[2]);
    first += mesh.points.size();
  }
  return out;
}

std::string vtu(const Assembly& assembly, const std::vector<ShownContact>& contacts)
{
  std::string points, triangles, offsets, types, copies, kinds, forces, gaps;
  std::size_t first = 0, cells = 0, corners = 0;
  for (std::size_t k = 0; k < assembly.copies.size(); ++k) {
    const auto& copy = assembly.copies[k];
    const Mesh& mesh = assembly.meshes[copy.mesh];
    for (const Vec3& local : mesh.points) {
      const Vec3 x = copy.pose.position + copy.pose.rotation * local;
      fmt::format_to(std::back_inserter(points), "{:.9g} {:.9g} {:.9g}\n", x.x(), x.y(), x.z());
    }
    for (const auto& t : mesh.triangles) {
      fmt::format_to(std::back_inserter(triangles), "{} {} {}\n", first + t[0], first + t[1], first + t[2]);
      fmt::format_to(std::back_inserter(offsets), "{}\n", corners += 3);
      ++cells;
      types += "5\n";
      fmt::format_to(std::back_inserter(copies), "{}\n", k);
      fmt::format_to(std::back_inserter(kinds), "{}\n", copy.mesh);
    }
    first += mesh.points.size();
  }
  if (!contacts.empty()) {
    for (std::size_t k = 0; k < first; ++k) {
      forces += "0 0 0\n";
      gaps += "0\n";
    }
  }
  for (const ShownContact& contact : contacts) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3& x = contact.at[k];
      const Vec3 f = k == 0 ? Vec3(-contact.force) : contact.force;
      fmt::format_to(std::back_inserter(points), "{} {} {}\n", x.x(), x.y(), x.z());
      fmt::format_to(std::back_inserter(forces), "{} {} {}\n", f.x(), f.y(), f.z());
      fmt::format_to(std::back_inserter(gaps), "{}\n", contact.gap);
      fmt::format_to(std::back_inserter(triangles), "{}\n", first++);
      fmt::format_to(std::back_inserter(offsets), "{}\n", ++corners);
      fmt::format_to(std::back_inserter(copies), "{}\n", contact.elements[k]);
      types += "1\n";
      kinds += "-1\n";
      ++cells;
    }
  }
  const auto array = [](const char* type, const char* name, int components, const std::string& values) {
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}</DataArray>\n",
        type, name, components, values);
  };
  return fmt::format(
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" "
             "NumberOfCells=\"{}\">\n",
             first, cells) +
         "<Points>\n" + array("Float64", "points", 3, points) + "</Points>\n<Cells>\n" +
         array("Int64", "connectivity", 1, triangles) + array("Int64", "offsets", 1, offsets) +
         array("UInt8", "types", 1, types) + "</Cells>\n<CellData>\n" + array("Int64", "element", 1, copies) +
         array("Int64", "kind", 1, kinds) + "</CellData>\n" +
         (contacts.empty() ? ""
                           : "<PointData>\n" + array("Float64", "force", 3, forces) +
                                 array("Float64", "gap", 1, gaps) + "</PointData>\n") +
         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace hauberk::exporting
