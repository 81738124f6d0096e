/// Readers of meshes: each form of each format, every error with its line, and bytes that are no mesh. The
/// shape's Jacobian.

#include "../mesh.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <unistd.h>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

namespace hauberk::test {
namespace {

const std::string tetrahedron = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\n";
const std::string faces = "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

MeshFile obj(const std::string& text) { return read_obj(text, "m.obj"); }

std::string obj_refusal(const std::string& text)
{
  try {
    obj(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

std::string stl_refusal(const std::string& bytes)
{
  try {
    read_stl(bytes, "m.stl");
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(Obj, AllFormsOfFaces)
{
  const MeshFile plain = obj(tetrahedron + faces);
  ASSERT_EQ(plain.points.size(), 4U);
  EXPECT_EQ(plain.points[1], Vec3(1, -1, -1));
  ASSERT_EQ(plain.triangles.size(), 4U);
  EXPECT_EQ(plain.triangles[1], (std::array<int, 3>{0, 3, 1}));
  for (const char* same :
       {"f 1/1 2/2 3/3\nf 1/1 4/2 2/3\nf 1/1 3/1 4/1\nf 2/1 4/1 3/1\n",
        "f 1//1 2//2 3//3\nf 1//1 4//2 2//3\nf 1//1 3//1 4//1\nf 2//1 4//1 3//1\n",
        "f 1/1/1 2/2/2 3/3/3\nf 1/-1/1 4/2/2 2/3/3\nf 1/1/1 3/1/1 4/1/1\nf 2/1/1 4/1/1 3/1/1\n",
        "f -4 -3 -2\nf -4 -1 -3\nf -4 -2 -1\nf -3 -1 -2\n"})
    EXPECT_EQ(obj(tetrahedron + same).triangles, plain.triangles) << same;
  // What is passed over, ends of lines, continued lines, faces before their points, numbers in other forms.
  EXPECT_EQ(
      obj("# c\r\nmtllib a.mtl\r\no x\r\nvn 0 0 1\r\nvt 0 0\r\ns off\r\n" + tetrahedron + faces).triangles,
      plain.triangles);
  EXPECT_EQ(obj(tetrahedron + "f 1 \\\n2 \\\r\n3 # first\nf 1 4 2\nf 1 3 4\nf 2 4 3").triangles,
            plain.triangles);
  EXPECT_EQ(obj(faces + tetrahedron).triangles, plain.triangles);
  EXPECT_EQ(obj("v +1.0e0 1 1 1.0\nv 1. -1 -1 0.5 0.5 0.5\n v\t-1 1 -1\nv -1 -1 1\n" + faces).points,
            plain.points);
  // Polygons are cut from their first corner on.
  EXPECT_EQ(obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 2 0\nv 0 1 0\nf 1 2 3 4 5\n").triangles,
            (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  // Points at one place are one, and what has them twice goes.
  EXPECT_EQ(obj("v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nf 2 3 4\nf 4 3 1\n").triangles,
            (std::vector<std::array<int, 3>>{{0, 1, 2}, {2, 1, 0}}));
}

TEST(Obj, ErrorsNameTheLine)
{
  EXPECT_EQ(obj_refusal("v 1 2\n"), "m.obj:1: expected three numbers after 'v'");
  EXPECT_EQ(obj_refusal("\n\nv 1 2 x\n"), "m.obj:3: expected a finite number, found 'x'");
  EXPECT_EQ(obj_refusal("v 1 2 nan\n"), "m.obj:1: expected a finite number, found 'nan'");
  EXPECT_EQ(obj_refusal("v 1 2 1e999\n"), "m.obj:1: expected a finite number, found '1e999'");
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 2\n"),
            "m.obj:5: expected a face of at least three corners, found 2");
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 2 \\\n 5\nf 1 2 3\n"),
            "m.obj:5: the face has point 5, and there are 4");
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 2 -5\n"), "m.obj:5: found point -5 after 4 points");
  const std::string number = "expected the number of a point, counted from 1 or from -1 backwards, found ";
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 0 3\n"), "m.obj:5: " + number + "'0'");
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 2.5 3\n"), "m.obj:5: " + number + "'2.5'");
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 99999999999 3\n"), "m.obj:5: " + number + "'99999999999'");
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 \x01/ 3\n"), "m.obj:5: " + number + "'?/'");
  EXPECT_EQ(obj_refusal(tetrahedron + "f 1 2/a 3\n"),
            "m.obj:5: expected a corner such as 3, 3/1, 3//1 or 3/1/1, found '2/a'");
  EXPECT_EQ(obj_refusal(tetrahedron), "m.obj: has no faces; expected lines 'v x y z' and 'f 1 2 3'");
  EXPECT_EQ(obj_refusal(""), "m.obj: has no faces; expected lines 'v x y z' and 'f 1 2 3'");
  std::string many = "v 0 0 0\nf";
  for (int k = 0; k < 100003; ++k) many += " 1";
  EXPECT_EQ(obj_refusal(many), "m.obj:2: more than 100000 triangles; make the mesh coarser");
}

std::string bytes_of(std::uint32_t value)
{
  std::string out;
  for (int k = 0; k < 4; ++k) out += static_cast<char>((value >> (8 * k)) & 0xFFU);
  return out;
}

std::string bytes_of(double value)
{
  const auto single = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof bits);
  return bytes_of(bits);
}

std::string binary(const MeshFile& mesh, const std::string& begin = "binary")
{
  std::string out = begin;
  out.resize(80, ' ');
  out += bytes_of(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) out += bytes_of(0.0);
    for (const int k : t) {
      for (const double x : mesh.points[k]) out += bytes_of(x);
    }
    out += std::string(2, '\0');
  }
  return out;
}

std::string text(const MeshFile& mesh, double noise = 0.0)
{
  std::string out = "solid some name\n";
  int k = 0;
  for (const auto& t : mesh.triangles) {
    out += "  facet normal nan 0 1\n    outer loop\n";
    for (const int i : t) {
      const Vec3& x = mesh.points[i];
      out += "      vertex " + std::to_string(x.x() + noise * (k++ % 3)) + " " + std::to_string(x.y()) + " " +
             std::to_string(x.z()) + "\n";
    }
    out += "    endloop\n  endfacet\n";
  }
  return out + "endsolid some name\n";
}

/// The same surface, whatever its points are numbered.
void expect_same(const MeshFile& found, const MeshFile& mesh)
{
  ASSERT_EQ(found.points.size(), mesh.points.size());
  ASSERT_EQ(found.triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT((found.points[found.triangles[t][k]] - mesh.points[mesh.triangles[t][k]]).norm(), 1e-5);
  }
}

TEST(Stl, BinaryAndText)
{
  const MeshFile mesh = obj(tetrahedron + faces);
  expect_same(read_stl(binary(mesh), "m.stl"), mesh);
  expect_same(read_stl(binary(mesh, "solid it is not"), "m.stl"), mesh);
  expect_same(read_stl(text(mesh), "m.stl"), mesh);
  // Corners that differ by rounding of the file's digits.
  expect_same(read_stl(text(mesh, 1e-6), "m.stl"), mesh);
  EXPECT_EQ(read_stl(text(mesh, 1e-3), "m.stl").points.size(), 8U) << "these are holes";
  // Two solids in a file.
  EXPECT_EQ(read_stl(text(mesh) + text(mesh), "m.stl").triangles.size(), 8U);
}

TEST(Stl, ErrorsNameTheLine)
{
  const MeshFile mesh = obj(tetrahedron + faces);
  const std::string good = text(mesh);
  EXPECT_EQ(stl_refusal(good.substr(0, good.find("endsolid"))),
            "m.stl:29: expected 'endsolid', found the end of the file; is it cut short?");
  EXPECT_EQ(stl_refusal(good.substr(0, good.find("endloop"))),
            "m.stl:7: expected 'endloop', found the end of the file; is it cut short?");
  std::string bad = good;
  bad.replace(bad.find("outer"), 5, "inner");
  EXPECT_EQ(stl_refusal(bad), "m.stl:3: expected 'outer', found 'inner'");
  bad = good;
  bad.replace(bad.find("1.000000"), 8, "infinity");
  EXPECT_EQ(stl_refusal(bad), "m.stl:4: expected a finite number, found 'infinity'");
  EXPECT_EQ(stl_refusal("solid x\nend\n"), "m.stl:2: expected 'facet' or 'endsolid', found 'end'");
  EXPECT_EQ(stl_refusal("solid x\nendsolid x\n"), "m.stl: has no triangles");
  EXPECT_EQ(stl_refusal("abc"),
            "m.stl: has 3 bytes; expected an STL file, which begins with 'solid' or has 84 and more");
  const std::string whole = binary(mesh);
  EXPECT_EQ(stl_refusal(whole.substr(0, 200)),
            "m.stl: has 200 bytes, and its 4 triangles take 284; is it cut short, or no STL file?");
  std::string huge = whole;
  huge.replace(80, 4, bytes_of(std::uint32_t{0xFFFFFFFF}));
  EXPECT_NE(stl_refusal(huge).find("its 4294967295 triangles take 214748364834;"), std::string::npos);
  std::string infinite = whole;
  infinite.replace(84 + 50 + 12, 4, bytes_of(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(stl_refusal(infinite), "m.stl: triangle 2 has a corner that is not finite");
  EXPECT_EQ(stl_refusal(binary({})), "m.stl: has no triangles");
}

/// Whatever the bytes, a mesh or an InputError.
TEST(Readers, SurviveDamagedFiles)
{
  const MeshFile mesh = obj(tetrahedron + faces);
  std::mt19937 rng(1);
  for (const std::string& whole : {tetrahedron + faces, text(mesh), binary(mesh)}) {
    for (int trial = 0; trial < 3000; ++trial) {
      std::string bytes = whole.substr(0, rng() % (whole.size() + 1));
      for (int k = static_cast<int>(rng() % 4); k > 0 && !bytes.empty(); --k)
        bytes[rng() % bytes.size()] = static_cast<char>(rng());
      for (const bool as_obj : {true, false}) {
        try {
          MeshFile read = as_obj ? read_obj(bytes, "m") : read_stl(bytes, "m");
          const Mesh shape(std::move(read));
        } catch (const InputError&) {  // said what is wrong
        }
      }
    }
  }
}

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("hauberk-mesh-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string write(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return (path_ / name).string();
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string problem(const std::string& file)
{
  Node section, name;
  section.type = Node::Type::object;
  name.type = Node::Type::string;
  name.string = file;
  name.pointer = "/elements/link/file";
  section.members.emplace_back("file", name);
  Problems problems;
  const std::unique_ptr<Shape> shape = make_mesh(section, problems);
  EXPECT_EQ(shape == nullptr, !problems.empty());
  if (problems.empty()) return {};
  EXPECT_EQ(problems.list()[0].pointer, "/elements/link/file");
  return problems.list()[0].message;
}

TEST(Mesh, FilesThatCannotBeReadAreRefused)
{
  const Folder folder;
  EXPECT_EQ(problem(HAUBERK_FRAME), "");
  EXPECT_EQ(problem(folder.write("a.OBJ", tetrahedron + faces)), "");
  EXPECT_EQ(problem(folder.write("a.stl", text(obj(tetrahedron + faces)))), "");
  EXPECT_EQ(problem(folder.path("b.obj")),
            folder.path("b.obj") +
                ": cannot be read: there is no such file; paths are relative to the experiment's folder");
  EXPECT_EQ(problem("/dev/zero.obj/"), "/dev/zero.obj/: expected a file .obj or .stl");
  EXPECT_EQ(problem(folder.path("a.ply")), folder.path("a.ply") + ": expected a file .obj or .stl");
  std::filesystem::create_directories(folder.path("c.stl"));
  EXPECT_EQ(problem(folder.path("c.stl")),
            folder.path("c.stl") + ": cannot be read: it is not a regular file");
  EXPECT_EQ(problem(folder.write("d.obj", "")), folder.path("d.obj") + ": is empty");
  EXPECT_EQ(problem(folder.write("e.obj", tetrahedron + "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 3 4\n"))
                .find(folder.path("e.obj") + ": triangles 1 and 4 run along"),
            0U);
}

TEST(Mesh, ThePrimitiveIsTheFilesSurfaceTimesItsScale)
{
  MeshFile file = read_mesh_file(HAUBERK_FRAME);
  for (Vec3& x : file.points) x += Vec3(10.0, -20.0, 30.0);
  const std::vector<Vec3> given = file.points;
  const Mesh shape(std::move(file));
  const std::vector<double> p{2.5};
  const Primitive mesh = shape.primitives(p)[0];
  for (std::size_t k = 0; k < given.size(); ++k)
    EXPECT_LT((mesh.position + mesh.R() * mesh.surface->points()[k] - 2.5 * given[k]).norm(), 1e-12);
  EXPECT_EQ(mesh.position, Vec3(25.0, -50.0, 75.0));
  const PrimitiveJacobian J = shape.jacobians(p)[0];
  ASSERT_EQ(J.size(), 9U);
  EXPECT_NEAR(J[3], mesh.R() / 2.5, 1e-14);
  EXPECT_NEAR(J[1], -20.0, 1e-13);
  EXPECT_THROW(shape.primitives(std::vector<double>{0.0}), InputError);
}

}  // namespace
}  // namespace hauberk::test
