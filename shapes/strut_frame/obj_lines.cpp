#include "strut_frame.hpp"

#include "common/obj_text.hpp"
#include "common/text_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace hauberk {
namespace {

constexpr int largest_file = 1;  // MB
constexpr std::size_t most_struts = 10000;

class LineReader {
 public:
  LineReader(std::string_view text, const std::string& name) : text_(text, name), name_(name) {}

  Graph read()
  {
    while (text_.next()) {
      if (text_.key() == "v") graph_.nodes.push_back(text_.point());
      if (text_.key() == "l") read_edges(false);
      if (text_.key() == "f") read_edges(true);
    }
    if (graph_.struts.empty())
      throw InputError(fmt::format("{}: has no struts; expected lines 'v x y z' and 'l 1 2'", name_));
    check_indices();
    return std::move(graph_);
  }

 private:
  void read_edges(bool closed)
  {
    std::vector<int> nodes;
    for (std::string_view word = text_.next_word(); !word.empty(); word = text_.next_word())
      nodes.push_back(text_.index(word, graph_.nodes.size()));
    if (nodes.size() < 2) text_.refuse(fmt::format("expected at least two points, found {}", nodes.size()));
    if (closed) nodes.push_back(nodes.front());
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const std::pair<int, int> edge = std::minmax(nodes[k], nodes[k + 1]);
      if (!known_.insert(edge).second) continue;
      if (graph_.struts.size() == most_struts) text_.refuse(fmt::format("more than {} struts", most_struts));
      graph_.struts.push_back({edge.first, edge.second});
      lines_.push_back(text_.line());
    }
  }

  /// Points may follow the lines that have them.
  void check_indices() const
  {
    for (std::size_t k = 0; k < graph_.struts.size(); ++k)
      for (const int node : graph_.struts[k])
        if (static_cast<std::size_t>(node) >= graph_.nodes.size())
          text_.refuse(fmt::format("the line has point {}, and there are {}", node + 1, graph_.nodes.size()),
                       lines_[k]);
  }

  detail::ObjText text_;
  const std::string& name_;
  Graph graph_;
  std::vector<int> lines_;  ///< of the struts
  std::set<std::pair<int, int>> known_;
};

}  // namespace

Graph read_obj_lines(const std::string& path)
{
  const std::string text = detail::read_bytes(path, largest_file);
  return LineReader(text, path).read();
}

}  // namespace hauberk
