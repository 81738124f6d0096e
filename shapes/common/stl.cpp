#include "common/mesh_file.hpp"

#include "common/text_file.hpp"

#include <hauberk/error.hpp>
#include <hauberk/triangle_surface.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace hauberk {
namespace {

constexpr std::size_t header = 80;  ///< bytes of anything
constexpr std::size_t record = 50;  ///< normal and corners, twelve floats, and two bytes of anything
/// Corners nearer than this part of the box' diagonal are one, where files were written with too few digits.
constexpr double near = 1e-6;

std::uint32_t little_endian(const char* bytes)
{
  std::uint32_t value = 0;
  for (int k = 4; k-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes[k]);
  return value;
}

double float_at(const char* bytes)
{
  const std::uint32_t bits = little_endian(bytes);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void check_count(std::size_t triangles, const MeshLimits& limits, const std::string& name)
{
  if (triangles > limits.triangles)
    throw InputError(
        fmt::format("{}: has more than {} triangles; make the mesh coarser", name, limits.triangles));
}

/// Every corner is a point of its own at first.
void add_corner(MeshFile& mesh, const Vec3& x)
{
  const auto k = static_cast<int>(mesh.points.size());
  mesh.points.push_back(x);
  if (k % 3 == 2) mesh.triangles.push_back({k - 2, k - 1, k});
}

MeshFile read_binary(std::string_view bytes, const MeshLimits& limits, const std::string& name)
{
  const std::uint32_t count = little_endian(bytes.data() + header);
  check_count(count, limits, name);
  MeshFile out;
  out.points.reserve(3 * static_cast<std::size_t>(count));
  out.triangles.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const char* at = bytes.data() + header + 4 + record * t + 12;
    for (int k = 0; k < 3; ++k, at += 12) {
      const Vec3 x(float_at(at), float_at(at + 4), float_at(at + 8));
      if (!x.allFinite())
        throw InputError(fmt::format("{}: triangle {} has a corner that is not finite", name, t + 1));
      add_corner(out, x);
    }
  }
  return out;
}

/// Reads the words of an STL text; blanks and ends of lines are the same.
class TextReader {
 public:
  TextReader(std::string_view text, const MeshLimits& limits, const std::string& name)
      : text_(text), limits_(limits), name_(name)
  {
  }

  MeshFile read()
  {
    expect("solid");
    line_ = {};  // its name
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (word == "endsolid") {
        line_ = {};
        const std::string_view again = next();
        if (again.empty()) return std::move(out_);
        if (again != "solid") refuse("expected 'solid' or the end of the file", again);
        line_ = {};
      } else if (word == "facet") {
        read_facet();
      } else {
        refuse("expected 'facet' or 'endsolid'", word);
      }
    }
    refuse("expected 'endsolid'", {});
  }

 private:
  [[noreturn]] void refuse(const std::string& what, std::string_view found) const
  {
    throw InputError(
        fmt::format("{}:{}: {}, found {}", name_, number_, what,
                    found.empty() ? "the end of the file; is it cut short?" : detail::quoted(found)));
  }

  /// The next word; empty at the end of the text.
  std::string_view next()
  {
    std::string_view word = detail::next_word(line_);
    while (word.empty() && !text_.empty()) {
      line_ = detail::next_line(text_);
      ++number_;
      word = detail::next_word(line_);
    }
    return word;
  }

  void expect(const char* wanted)
  {
    const std::string_view word = next();
    if (word != wanted) refuse(fmt::format("expected '{}'", wanted), word);
  }

  double number()
  {
    const std::string_view word = next();
    double value = 0.0;
    if (!detail::read_number(word, value)) refuse("expected a finite number", word);
    return value;
  }

  /// Normals are read as words: some programs write ones that are no numbers.
  void read_facet()
  {
    expect("normal");
    for (int k = 0; k < 3; ++k) {
      if (next().empty()) refuse("expected a number", {});
    }
    expect("outer");
    expect("loop");
    for (int k = 0; k < 3; ++k) {
      expect("vertex");
      const double x = number(), y = number(), z = number();
      add_corner(out_, Vec3(x, y, z));
    }
    expect("endloop");
    expect("endfacet");
    check_count(out_.triangles.size(), limits_, name_);
  }

  std::string_view text_, line_;
  const MeshLimits& limits_;
  const std::string& name_;
  int number_ = 0;
  MeshFile out_;
};

double diagonal(const std::vector<Vec3>& points)
{
  Vec3 low = points.front(), high = low;
  for (const Vec3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).norm();
}

}  // namespace

MeshFile read_stl(std::string_view bytes, const std::string& name, const MeshLimits& limits)
{
  // The header of a binary file may begin with "solid" as well, so its size decides.
  const bool long_enough = bytes.size() >= header + 4;
  const std::size_t count = long_enough ? little_endian(bytes.data() + header) : 0;
  const bool binary = long_enough && bytes.size() == header + 4 + record * count;
  if (!binary && !bytes.starts_with("solid")) {
    throw InputError(
        long_enough
            ? fmt::format("{}: has {} bytes, and its {} triangles take {}; is it cut short, or no STL file?",
                          name, bytes.size(), count, header + 4 + record * count)
            : fmt::format(
                  "{}: has {} bytes; expected an STL file, which begins with 'solid' or has 84 and more",
                  name, bytes.size()));
  }
  MeshFile out = binary ? read_binary(bytes, limits, name) : TextReader(bytes, limits, name).read();
  if (out.triangles.empty()) throw InputError(fmt::format("{}: has no triangles", name));
  detail::join_equal_points(out);
  if (!detail::has_pairs_of_edges(out)) detail::join_near_points(out, near * diagonal(out.points));
  return out;
}

}  // namespace hauberk
