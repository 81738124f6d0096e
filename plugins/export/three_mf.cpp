#include "export/formats.hpp"

#include "archive/archive.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <iterator>
#include <limits>

namespace hauberk::exporting {
namespace {

/// Text between tags; what a document of XML cannot hold becomes "?".
std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return out;
}

const char* unit_name(const std::string& unit)
{
  return unit == "m" ? "meter" : unit == "um" ? "micron" : "millimeter";
}

std::string vertices_xml(const Mesh& mesh)
{
  std::string out = "<mesh><vertices>\n";
  for (const Vec3& x : mesh.points)
    fmt::format_to(std::back_inserter(out), "<vertex x=\"{:.9g}\" y=\"{:.9g}\" z=\"{:.9g}\"/>\n", x.x(),
                   x.y(), x.z());
  return out + "</vertices><triangles>\n";
}

/// The mesh of one kind of element in its own frame.
std::string object_xml(const Assembly& assembly, std::size_t k)
{
  const Mesh& mesh = assembly.meshes[k];
  std::string out = fmt::format("<object id=\"{}\" name=\"{}\" type=\"model\" pid=\"1\" pindex=\"{}\">",
                                k + 2, escaped(assembly.mesh_names[k]), k) +
                    vertices_xml(mesh);
  for (const auto& t : mesh.triangles)
    fmt::format_to(std::back_inserter(out), "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", t[0], t[1], t[2]);
  return out + "</triangles></mesh></object>\n";
}

/// 3MF multiplies rows by matrices: the rows of the transform are the columns of the rotation, then the
/// place.
std::string item_xml(const Assembly::Copy& copy)
{
  std::string transform;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) transform += fmt::format("{:.12g} ", copy.pose.rotation(row, column));
  const Vec3& x = copy.pose.position;
  transform += fmt::format("{:.9g} {:.9g} {:.9g}", x.x(), x.y(), x.z());
  return fmt::format("<item objectid=\"{}\" partnumber=\"{}\" transform=\"{}\"/>\n", copy.mesh + 2,
                     escaped(copy.name), transform);
}

/// All copies as one mesh, triangles coloured by their kind, and its item, whose transform moves the lowest
/// coordinates to 0: the format puts what is to be printed there.
std::string one_object_xml(const Assembly& assembly)
{
  Mesh all;
  std::vector<std::size_t> ends;  // of the triangles of each copy
  for (const auto& copy : assembly.copies) {
    append(all, assembly.meshes[copy.mesh], copy.pose.rotation, copy.pose.position);
    ends.push_back(all.triangles.size());
  }
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::infinity());
  for (const Vec3& x : all.points) lowest = lowest.cwiseMin(x);
  std::string out = fmt::format("<object id=\"2\" name=\"{}\" type=\"model\" pid=\"1\" pindex=\"0\">",
                                escaped(assembly.name)) +
                    vertices_xml(all);
  std::size_t k = 0;
  for (std::size_t c = 0; c < ends.size(); ++c) {
    const int colour = assembly.copies[c].mesh;
    // Corners 2 and 3 have the property of the first where they name none.
    const std::string property = colour == 0 ? "" : fmt::format(" pid=\"1\" p1=\"{}\"", colour);
    for (; k < ends[c]; ++k) {
      const auto& t = all.triangles[k];
      fmt::format_to(std::back_inserter(out), "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"{}/>\n", t[0], t[1],
                     t[2], property);
    }
  }
  return out + fmt::format(
                   "</triangles></mesh></object>\n</resources>\n<build>\n<item objectid=\"2\" "
                   "transform=\"1 0 0 0 1 0 0 0 1 {:.9g} {:.9g} {:.9g}\"/>\n",
                   -lowest.x(), -lowest.y(), -lowest.z());
}

std::string separate_objects_xml(const Assembly& assembly)
{
  std::string out;
  for (std::size_t k = 0; k < assembly.meshes.size(); ++k) out += object_xml(assembly, k);
  out += "</resources>\n<build>\n";
  for (const auto& copy : assembly.copies) out += item_xml(copy);
  return out;
}

std::string model_xml(const Assembly& assembly, Objects objects)
{
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{}\" xml:lang=\"en\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
      "<metadata name=\"Title\">{}, {}</metadata>\n<resources>\n<basematerials id=\"1\">\n",
      unit_name(assembly.unit), escaped(assembly.name), escaped(assembly.state));
  for (std::size_t k = 0; k < assembly.meshes.size(); ++k) {
    const auto c = colour_of(static_cast<int>(k));
    out += fmt::format("<base name=\"{}\" displaycolor=\"#{:02X}{:02X}{:02X}\"/>\n",
                       escaped(assembly.mesh_names[k]), c[0], c[1], c[2]);
  }
  out += "</basematerials>\n";
  out += objects == Objects::one ? one_object_xml(assembly) : separate_objects_xml(assembly);
  return out + "</build>\n</model>\n";
}

constexpr const char* content_types =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types "
    "xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
constexpr const char* relationships =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships "
    "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Target=\"/3D/3dmodel.model\" "
    "Id=\"rel0\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

}  // namespace

std::string three_mf(const Assembly& assembly, Objects objects)
{
  if (!archives::available())
    throw InputError(
        "this program was built without libzip, which 3MF needs; install libzip-dev and build again, or export STL, "
        "OBJ or GLB");
  return archives::pack({{"[Content_Types].xml", content_types},
                         {"_rels/.rels", relationships},
                         {"3D/3dmodel.model", model_xml(assembly, objects)}});
}

}  // namespace hauberk::exporting
