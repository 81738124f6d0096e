#include "strut_frame.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

namespace hauberk {
namespace {

constexpr std::uintmax_t largest_file = 1 << 20;
constexpr std::size_t most_struts = 10000;

/// Reads the lines of one file.
class LineReader {
 public:
  explicit LineReader(std::string path) : path_(std::move(path)) {}

  Graph read()
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path_, error))
      throw InputError(path_ + ": there is no such file; paths are relative to the experiment's folder");
    if (std::filesystem::file_size(path_, error) > largest_file)
      throw InputError(path_ + ": cannot be read: it is larger than 1 MB");
    std::ifstream file(path_);
    if (!file) throw InputError(path_ + ": cannot be opened");
    std::string text;
    while (std::getline(file, text)) {
      ++line_;
      std::istringstream words(text);
      std::string key;
      words >> key;
      if (key == "v") read_node(words);
      if (key == "l" || key == "f") read_edges(words, key == "f");
      if (graph_.struts.size() > most_struts) refuse(fmt::format("more than {} struts", most_struts));
    }
    if (graph_.struts.empty()) throw InputError(path_ + ": there is no line (l) and no face (f) in it");
    return std::move(graph_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const
  {
    throw InputError(fmt::format("{}:{}: {}", path_, line_, what));
  }

  void read_node(std::istringstream& words)
  {
    Vec3 x;
    if (!(words >> x[0] >> x[1] >> x[2]) || !x.allFinite()) refuse("three numbers expected after v");
    graph_.nodes.push_back(x);
  }

  int read_index(const std::string& word) const
  {
    int number = 0;
    const char *first = word.data(), *last = first + std::min(word.find('/'), word.size());
    const auto [end, error] = std::from_chars(first, last, number);
    if (error != std::errc() || end != last || number == 0)
      refuse("the number of a node expected, found " + word);
    const int count = static_cast<int>(graph_.nodes.size());
    const int index = number < 0 ? count + number : number - 1;
    if (index < 0 || index >= count)
      refuse(fmt::format("node {} is not among the {} that stand above", number, count));
    return index;
  }

  void read_edges(std::istringstream& words, bool closed)
  {
    std::vector<int> nodes;
    for (std::string word; words >> word;) nodes.push_back(read_index(word));
    if (nodes.size() < 2) refuse("at least two nodes expected");
    if (closed) nodes.push_back(nodes.front());
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const std::pair<int, int> edge = std::minmax(nodes[k], nodes[k + 1]);
      if (known_.insert(edge).second) graph_.struts.push_back({edge.first, edge.second});
    }
  }

  std::string path_;
  int line_ = 0;
  Graph graph_;
  std::set<std::pair<int, int>> known_;
};

}  // namespace

Graph read_obj_lines(const std::string& path) { return LineReader(path).read(); }

}  // namespace hauberk
