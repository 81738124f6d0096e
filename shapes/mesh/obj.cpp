#include "mesh_file.hpp"

#include <hauberk/error.hpp>
#include <hauberk/triangle_surface.hpp>

#include <fmt/format.h>

#include <charconv>

namespace hauberk {
namespace {

using detail::next_word;
using detail::quoted;

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  MeshFile read()
  {
    while (!text_.empty()) {
      std::string_view line = whole_line();
      line = line.substr(0, line.find('#'));
      const std::string_view key = next_word(line);
      if (key == "v") read_point(line);
      if (key == "f") read_face(line);
    }
    if (out_.triangles.empty())
      throw InputError(fmt::format("{}: has no faces; expected lines 'v x y z' and 'f 1 2 3'", name_));
    check_indices();
    detail::join_equal_points(out_);
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const
  {
    throw InputError(fmt::format("{}:{}: {}", name_, first_, what));
  }

  /// A line, together with those that a backslash at its end continues.
  std::string_view whole_line()
  {
    first_ = ++number_;
    std::string_view line = detail::next_line(text_);
    if (!continued(line)) return line;
    joined_.clear();
    while (continued(line)) {
      joined_.append(line.substr(0, line.rfind('\\'))).append(" ");
      line = detail::next_line(text_);
      ++number_;
    }
    joined_.append(line);
    return joined_;
  }

  bool continued(std::string_view line) const
  {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line.ends_with('\\') && !text_.empty();
  }

  void read_point(std::string_view line)
  {
    Vec3 x;
    for (double& coordinate : x) {
      const std::string_view word = next_word(line);
      if (word.empty()) refuse("expected three numbers after 'v'");
      if (!detail::read_number(word, coordinate)) refuse("expected a finite number, found " + quoted(word));
    }
    out_.points.push_back(x);
  }

  /// The index of a point: what is before a slash, from 1, or from the last one backwards.
  int read_corner(std::string_view word) const
  {
    const std::string_view digits = word.substr(0, word.find('/'));
    int index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || end != digits.data() + digits.size() || index == 0)
      refuse("expected the number of a point, counted from 1 or from -1 backwards, found " + quoted(word));
    const std::string_view rest = word.substr(digits.size());
    if (rest.find_first_not_of("/-0123456789") != std::string_view::npos)
      refuse("expected a corner such as 3, 3/1, 3//1 or 3/1/1, found " + quoted(word));
    const long count = static_cast<long>(out_.points.size());
    if (index < 0 && count + index < 0) refuse(fmt::format("found point {} after {} points", index, count));
    return static_cast<int>(index < 0 ? count + index : index - 1L);
  }

  void read_face(std::string_view line)
  {
    std::array<int, 3> t{-1, -1, -1};  // the first corner and the last two
    int corners = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      const int corner = read_corner(word);
      t[1] = t[2];
      t[2] = corner;
      if (corners++ == 0) t[0] = corner;
      if (corners >= 3) add(t);
    }
    if (corners < 3) refuse(fmt::format("expected a face of at least three corners, found {}", corners));
  }

  void add(const std::array<int, 3>& t)
  {
    if (out_.triangles.size() >= TriangleSurface::most_triangles)
      refuse(fmt::format("more than {} triangles; make the mesh coarser", TriangleSurface::most_triangles));
    out_.triangles.push_back(t);
    lines_.push_back(first_);
  }

  /// Points may follow the faces that have them.
  void check_indices()
  {
    for (std::size_t t = 0; t < out_.triangles.size(); ++t) {
      for (const int k : out_.triangles[t]) {
        if (static_cast<std::size_t>(k) < out_.points.size()) continue;
        first_ = lines_[t];
        refuse(fmt::format("the face has point {}, and there are {}", k + 1, out_.points.size()));
      }
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::string joined_;
  int number_ = 0, first_ = 0;  ///< lines that were read, and where the present one began
  MeshFile out_;
  std::vector<int> lines_;  ///< of the triangles
};

}  // namespace

MeshFile read_obj(std::string_view text, const std::string& name) { return ObjReader(text, name).read(); }

}  // namespace hauberk
