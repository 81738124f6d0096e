#include "common/mesh_file.hpp"

#include "common/obj_text.hpp"

#include <hauberk/error.hpp>
#include <hauberk/triangle_surface.hpp>

#include <fmt/format.h>

namespace hauberk {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, const MeshLimits& limits, const std::string& name)
      : text_(text, name), limits_(limits), name_(name)
  {
  }

  MeshFile read()
  {
    while (text_.next()) {
      if (text_.key() == "v") out_.points.push_back(text_.point());
      if (text_.key() == "f") read_face();
    }
    if (out_.triangles.empty())
      throw InputError(fmt::format("{}: has no faces; expected lines 'v x y z' and 'f 1 2 3'", name_));
    check_indices();
    detail::join_equal_points(out_);
    return std::move(out_);
  }

 private:
  void read_face()
  {
    std::array<int, 3> t{-1, -1, -1};  // the first corner and the last two
    int corners = 0;
    for (std::string_view word = text_.next_word(); !word.empty(); word = text_.next_word()) {
      const int corner = text_.index(word, out_.points.size());
      t[1] = t[2];
      t[2] = corner;
      if (corners++ == 0) t[0] = corner;
      if (corners >= 3) add(t);
    }
    if (corners < 3)
      text_.refuse(fmt::format("expected a face of at least three corners, found {}", corners));
  }

  void add(const std::array<int, 3>& t)
  {
    if (out_.triangles.size() >= limits_.triangles)
      text_.refuse(fmt::format("more than {} triangles; make the mesh coarser", limits_.triangles));
    out_.triangles.push_back(t);
    lines_.push_back(text_.line());
  }

  /// Points may follow the faces that have them.
  void check_indices() const
  {
    for (std::size_t t = 0; t < out_.triangles.size(); ++t) {
      for (const int k : out_.triangles[t]) {
        if (static_cast<std::size_t>(k) < out_.points.size()) continue;
        text_.refuse(fmt::format("the face has point {}, and there are {}", k + 1, out_.points.size()),
                     lines_[t]);
      }
    }
  }

  detail::ObjText text_;
  const MeshLimits& limits_;
  const std::string& name_;
  MeshFile out_;
  std::vector<int> lines_;  ///< of the triangles
};

}  // namespace

MeshFile read_obj(std::string_view text, const std::string& name, const MeshLimits& limits)
{
  return ObjReader(text, limits, name).read();
}

}  // namespace hauberk
